#include "solid.h"

#include <assert.h>
#include <libqhull_r/qhull_ra.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BOX_CORNERS = 8, BOX_INDICES = 36, QUAD_CORNERS = 4, QUAD_INDICES = 6 };

fm_status solid_allocate(fm_solid *solid, uint32_t vertices, uint32_t indices, fm_error *err)
{
    *solid = (fm_solid){ .vertex_count = vertices, .index_count = indices };
    solid->vertices = calloc(vertices, sizeof solid->vertices[0]);
    solid->indices = calloc(indices, sizeof solid->indices[0]);
    if (solid->vertices != NULL && solid->indices != NULL)
        return FM_OK;
    solid_free(solid);
    return fm_fail(err, FM_NO_MEMORY, "a solid of %u vertices", vertices);
}

void solid_free(fm_solid *solid)
{
    free(solid->vertices);
    free(solid->indices);
    *solid = (fm_solid){ 0 };
}

/* As layers_vertex.glsl evaluates it. */
static float depth_at(const fm_layer *layer, const float ndc[2])
{
    return layer->depth + layer->slope_x * ndc[0] + layer->slope_y * ndc[1];
}

static void corner_ndc(float ndc[2], const fm_scene *scene, uint32_t corner)
{
    const fm_rect *rect = &scene->rect;
    const uint32_t x = (corner & 1u) != 0 ? rect->x1 : rect->x0;
    const uint32_t y = (corner & 2u) != 0 ? rect->y1 : rect->y0;
    ndc[0] = (float)x * 2.0f / (float)scene->width_px - 1.0f;
    ndc[1] = (float)y * 2.0f / (float)scene->height_px - 1.0f;
}

static void put_corner(fm_solid *solid, const fm_scene *scene, uint32_t corner)
{
    float ndc[2], least = 1.0f, greatest = 0.0f;
    corner_ndc(ndc, scene, corner);
    for (uint32_t i = 0; i < scene->n; i++) {
        least = fminf(least, depth_at(&scene->layers[i], ndc));
        greatest = fmaxf(greatest, depth_at(&scene->layers[i], ndc));
    }
    solid->vertices[corner] = (fm_vertex){ .position = { ndc[0], ndc[1], least } };
    solid->vertices[QUAD_CORNERS + corner] =
        (fm_vertex){ .position = { ndc[0], ndc[1], greatest } };
}

/* Side faces are seen edge on and cover no pixel: two quads are all. */
static fm_status layers_solid(fm_solid *solid, const fm_scene *scene, fm_error *err)
{
    static const uint32_t corner[QUAD_INDICES] = { 0, 1, 2, 2, 1, 3 };
    const fm_status status = solid_allocate(solid, 2 * QUAD_CORNERS, 2 * QUAD_INDICES, err);
    if (status != FM_OK)
        return status;
    for (uint32_t i = 0; i < QUAD_CORNERS; i++)
        put_corner(solid, scene, i);
    for (uint32_t i = 0; i < 2 * QUAD_INDICES; i++)
        solid->indices[i] = QUAD_CORNERS * (i / QUAD_INDICES) + corner[i % QUAD_INDICES];
    return FM_OK;
}

static void make_parallel(fm_solid *solid)
{
    float least = INFINITY, greatest = -INFINITY;
    for (uint32_t i = 0; i < solid->vertex_count; i++) {
        least = fminf(least, solid->vertices[i].position[2]);
        greatest = fmaxf(greatest, solid->vertices[i].position[2]);
    }
    for (uint32_t i = 0; i < solid->vertex_count; i++)
        solid->vertices[i].position[2] = i < QUAD_CORNERS ? least : greatest;
}

/* Positions of a mesh's vertices, collected from its blocks. */
typedef struct cloud {
    double (*points)[3]; /* NULL: only the bounds are wanted */
    float low[3], high[3];
} cloud;

static fm_status take_vertices(void *user, uint32_t first, const fm_vertex *vertices,
                               uint32_t count, fm_error *err)
{
    (void)err;
    cloud *to = user;
    for (uint32_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++) {
            const float at = vertices[i].position[axis];
            to->low[axis] = fminf(to->low[axis], at);
            to->high[axis] = fmaxf(to->high[axis], at);
            if (to->points != NULL)
                to->points[first + i][axis] = (double)at;
        }
    return FM_OK;
}

static fm_status pass_indices(void *user, uint32_t first, const uint32_t *indices, uint32_t count,
                              fm_error *err)
{
    (void)user, (void)first, (void)indices, (void)count, (void)err;
    return FM_OK;
}

static fm_status fill_cloud(cloud *to, const fm_scene *scene, fm_error *err)
{
    const fm_mesh_sink sink = { to, take_vertices, pass_indices };
    for (int axis = 0; axis < 3; axis++) {
        to->low[axis] = INFINITY;
        to->high[axis] = -INFINITY;
    }
    return scene_mesh(scene, &sink, err);
}

static fm_status cloud_box(fm_solid *solid, const cloud *points, fm_error *err)
{
    static const uint32_t corner[BOX_INDICES] = { 0, 1, 2, 2, 1, 3, 4, 6, 5, 5, 6, 7,
                                                  0, 4, 1, 1, 4, 5, 2, 3, 6, 6, 3, 7,
                                                  0, 2, 4, 4, 2, 6, 1, 5, 3, 3, 5, 7 };
    const fm_status status = solid_allocate(solid, BOX_CORNERS, BOX_INDICES, err);
    if (status != FM_OK)
        return status;
    for (uint32_t i = 0; i < BOX_CORNERS; i++)
        for (int axis = 0; axis < 3; axis++)
            solid->vertices[i].position[axis] =
                (i >> axis & 1u) != 0 ? points->high[axis] : points->low[axis];
    memcpy(solid->indices, corner, sizeof corner);
    return FM_OK;
}

/* The triangles of a finished hull; vertices are numbered as they are met. numbers: as many as the
 * mesh has vertices. */
static fm_status take_facets(fm_solid *solid, qhT *qh, double (*points)[3], uint32_t count,
                             uint32_t *numbers, fm_error *err)
{
    facetT *facet;
    vertexT *vertex, **vertexp;
    uint32_t corners = 0, met = 0;
    FORALLfacets corners += 3;
    const fm_status status = solid_allocate(solid, corners < count ? corners : count, corners, err);
    if (status != FM_OK)
        return status;
    corners = 0;
    memset(numbers, 0xFF, count * sizeof numbers[0]);
    FORALLfacets
    {
        assert(qh_setsize(qh, facet->vertices) == 3); /* Qt */
        FOREACHvertex_(facet->vertices)
        {
            const int point = qh_pointid(qh, vertex->point);
            if (numbers[point] == UINT32_MAX) {
                for (int axis = 0; axis < 3; axis++) /* floats, kept as doubles */
                    solid->vertices[met].position[axis] = (float)points[point][axis];
                numbers[point] = met++;
            }
            solid->indices[corners++] = numbers[point];
        }
    }
    solid->vertex_count = met;
    return FM_OK;
}

/* *is_flat: there is no hull, but nothing went wrong either. */
static fm_status run_qhull(fm_solid *solid, bool *is_flat, double (*points)[3], uint32_t count,
                           uint32_t *numbers, fm_error *err)
{
    char command[] = "qhull Qt Pp"; /* triangles only; no warnings */
    char *words = NULL;
    size_t word_count = 0;
    int long_blocks, long_bytes;
    qhT state;
    fm_status status = FM_OK;
    FILE *log = open_memstream(&words, &word_count);
    if (log == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the hull's messages");
    qh_zero(&state, log);
    const int ended = qh_new_qhull(&state, 3, (int)count, points[0], False, command, NULL, log);
    *is_flat = ended != qh_ERRnone && ended != qh_ERRmem;
    if (ended == qh_ERRmem)
        status = fm_fail(err, FM_NO_MEMORY, "the hull of %u vertices", count);
    if (ended == qh_ERRnone)
        status = take_facets(solid, &state, points, count, numbers, err);
    qh_freeqhull(&state, !qh_ALL);
    qh_memfreeshort(&state, &long_blocks, &long_bytes);
    fclose(log);
    free(words);
    return status;
}

static fm_status mesh_hull(fm_solid *solid, const fm_scene *scene, fm_error *err)
{
    const uint32_t count = scene->vertex_count;
    bool is_flat = count < 4;
    uint32_t *numbers = NULL;
    cloud all = { .points = NULL };
    if (count > (uint32_t)INT_MAX / 3)
        return fm_refuse(err, FM_REASON_SUITE_LIMIT,
                         "the hull of %u vertices: qhull takes %d at most", count, INT_MAX / 3);
    fm_status status = FM_OK;
    all.points = malloc(((size_t)count + 1) * sizeof all.points[0]);
    numbers = malloc(((size_t)count + 1) * sizeof *numbers);
    if (all.points == NULL || numbers == NULL)
        status = fm_fail(err, FM_NO_MEMORY, "the hull of %u vertices", count);
    if (status == FM_OK)
        status = fill_cloud(&all, scene, err);
    if (status == FM_OK && !is_flat)
        status = run_qhull(solid, &is_flat, all.points, count, numbers, err);
    if (status == FM_OK && is_flat)
        status = cloud_box(solid, &all, err);
    free(all.points);
    free(numbers);
    return status;
}

static fm_status mesh_box(fm_solid *solid, const fm_scene *scene, fm_error *err)
{
    cloud all = { .points = NULL };
    const fm_status status = fill_cloud(&all, scene, err);
    return status == FM_OK ? cloud_box(solid, &all, err) : status;
}

fm_status solid_hull(fm_solid *solid, const fm_scene *scene, fm_error *err)
{
    *solid = (fm_solid){ 0 };
    return scene_is_layers(scene) ? layers_solid(solid, scene, err) : mesh_hull(solid, scene, err);
}

fm_status solid_box(fm_solid *solid, const fm_scene *scene, fm_error *err)
{
    *solid = (fm_solid){ 0 };
    if (!scene_is_layers(scene))
        return mesh_box(solid, scene, err);
    const fm_status status = layers_solid(solid, scene, err);
    if (status == FM_OK)
        make_parallel(solid);
    return status;
}
