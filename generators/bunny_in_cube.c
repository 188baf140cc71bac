/* A mesh inside a cube, seen from straight ahead: the S-buffer paper's figure 3. The cube's front
 * is a square of the viewport, so that the part of pixels that are not empty is known. */
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "procedural.h"
#include "scene/mesh.h"
#include "scene/placement.h"
#include "turns.h"

/* The cube reaches from -1 to 1. */
enum { CUBE_VERTICES = 24, CUBE_INDICES = 36 };
static const double mesh_size = 1.7;  /* of the mesh's largest side */
static const double mesh_turns = 0.1; /* about y: no line of sight meets more than 12 layers */

static vec3 turned(vec3 v, double cosine, double sine)
{
    return (vec3){ cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x };
}

static void fit_mesh(fm_scene *scene, const fm_box *box)
{
    const double size = fmax(box->high[0] - box->low[0],
                             fmax(box->high[1] - box->low[1], box->high[2] - box->low[2]));
    const double cosine = turn_cos(mesh_turns), sine = turn_sin(mesh_turns);
    const vec3 middle = { 0.5 * (box->low[0] + box->high[0]), 0.5 * (box->low[1] + box->high[1]),
                          0.5 * (box->low[2] + box->high[2]) };
    for (uint32_t i = 0; i < scene->vertex_count; i++) {
        float *p = scene->vertices[i].position;
        const vec3 v = { (double)p[0], (double)p[1], (double)p[2] };
        const vec3 t = turned(minus(v, middle), cosine, sine);
        p[0] = (float)(t.x * mesh_size / size);
        p[1] = (float)(t.y * mesh_size / size);
        p[2] = (float)(t.z * mesh_size / size);
    }
}

static fm_status take_vertices(void *user, uint32_t first, const fm_vertex *vertices,
                               uint32_t count, fm_error *err)
{
    fm_scene *scene = user;
    (void)err;
    memcpy(scene->vertices + scene->vertex_count + first, vertices, count * sizeof *vertices);
    return FM_OK;
}

static fm_status take_indices(void *user, uint32_t first, const uint32_t *indices, uint32_t count,
                              fm_error *err)
{
    fm_scene *scene = user;
    (void)err;
    for (uint32_t i = 0; i < count; i++)
        scene->indices[scene->index_count + first + i] = scene->vertex_count + indices[i];
    return FM_OK;
}

static fm_status make_room(fm_scene *scene, fm_error *err)
{
    void *vertices = realloc(scene->vertices, ((size_t)scene->vertex_count + CUBE_VERTICES) *
                                                  sizeof *scene->vertices);
    if (vertices != NULL)
        scene->vertices = vertices;
    void *indices = realloc(scene->indices,
                            ((size_t)scene->index_count + CUBE_INDICES) * sizeof *scene->indices);
    if (indices != NULL)
        scene->indices = indices;
    if (vertices == NULL || indices == NULL)
        return fm_fail(err, FM_NO_MEMORY, "mesh of %" PRIu32 " vertices and %" PRIu32 " indices",
                       scene->vertex_count, scene->index_count);
    return FM_OK;
}

/* The cube is drawn after the mesh. */
static fm_status add_cube(fm_scene *scene, fm_error *err)
{
    const fm_mesh_sink sink = { scene, take_vertices, take_indices };
    fm_status status = make_room(scene, err);
    if (status != FM_OK)
        return status;
    fm_builder *b = malloc(sizeof *b);
    if (b == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%zu bytes to build a cube in", sizeof *b);
    builder_begin(b, &scene->settings, &sink, err);
    b->colour = 0xE0B080;
    build_box(b, (vec3){ -1, -1, -1 }, (vec3){ 1, 1, 1 });
    status = builder_end(b);
    scene->vertex_count += b->vertex_count;
    scene->index_count += b->index_count;
    free(b);
    return status;
}

/* How long the sides of the front are on the screen, in px. Cut by the viewport, it covers the
 * wanted part. Its borders keep away from the middles of pixels. */
static double front_px(const fm_settings *s)
{
    const double area = s->pixel_density * s->width_px * s->height_px;
    const double least = fmin(s->width_px, s->height_px);
    const double side = area <= least * least ? sqrt(area) : area / least;
    const double odd = 0.5 * (s->width_px % 2 + s->height_px % 2);
    if (s->pixel_density >= 1)
        return fmax(s->width_px, s->height_px) + 2;
    return fmax(1, 2 * rint(0.5 * (side - odd)) + odd);
}

fm_status bunny_in_cube_generate(fm_scene *scene, fm_error *err)
{
    const fm_box cube = { { -1, -1, -1 }, { 1, 1, 1 } };
    const double degree = 3.14159265358979323846 / 180.0;
    fm_settings camera = scene->settings;
    fm_box box;
    fm_status status = mesh_read(scene, &box, err);
    if (status != FM_OK)
        return status;
    fit_mesh(scene, &box);
    scene->space = (fm_space){ 0 }; /* the cube's */
    status = add_cube(scene, err);
    if (status != FM_OK)
        return status;
    /* As camera_matrix: a length y at distance d is 0.5 height y / (d tan(fov / 2)) px. */
    camera.eye[0] = camera.eye[1] = 0;
    camera.eye[2] =
        1 + scene->height_px / (front_px(&scene->settings) * tan(0.5 * camera.fov_deg * degree));
    return scene_place(scene, &camera, &cube, err);
}
