#include "mesh_build.h"

#include <assert.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "triangulate.h"
#include "weld.h"

static const size_t indices_max = (size_t)1 << 31;
/* Parts of a box: what spacing of coordinates is worth a word, and what is too coarse. */
static const double spacing_told = 0x1p-20, spacing_max = 0x1p-8;

/* What is made on the way. */
typedef struct mesh_work {
    fm_polygons *polygons;
    const char *path;
    fm_triangulator cutter;
    uint32_t *corners; /* [index_count]: corners of triangles, as numbers of polygons' corners */
    size_t index_count;
    uint32_t *place; /* [position_count]: the first position that equals this one */
    uint32_t *slope; /* [normal_count]: the same of normals */
    vec3 *smooth;    /* [position_count]: sum of the triangles' unit normals */
    fm_corner *keys; /* [index_count]: what makes two corners one vertex */
    fm_error *err;
} mesh_work;

static fm_status no_memory(const mesh_work *work)
{
    return fm_fail(work->err, FM_NO_MEMORY, "%s: a mesh of %zu corners", work->path,
                   work->polygons->corner_count);
}

static bool is_finite(const double triple[3])
{
    return isfinite(triple[0]) && isfinite(triple[1]) && isfinite(triple[2]);
}

/* "a.obj:7: a face: ..." or "a.stl: facet 3, from 0: ..." */
__attribute__((format(printf, 3, 4))) static fm_status fail_face(const mesh_work *work, size_t face,
                                                                 const char *format, ...)
{
    const fm_polygons *polygons = work->polygons;
    char reason[256];
    va_list values;
    va_start(values, format);
    vsnprintf(reason, sizeof reason, format, values);
    va_end(values);
    if (polygons->element == NULL)
        return fm_fail(work->err, FM_INVALID, "%s:%" PRIu64 ": a face: %s", work->path,
                       polygons->origins[face], reason);
    return fm_fail(work->err, FM_INVALID, "%s: %s %" PRIu64 ", from 0: %s", work->path,
                   polygons->element, polygons->origins[face], reason);
}

static fm_status check_corner(const mesh_work *work, size_t face, const fm_corner *corner)
{
    const fm_polygons *polygons = work->polygons;
    if (corner->position >= polygons->position_count)
        return fail_face(work, face, "vertex %" PRIu32 " of %zu", corner->position,
                         polygons->position_count);
    if (corner->normal != FM_NO_NORMAL && corner->normal >= polygons->normal_count)
        return fail_face(work, face, "normal %" PRIu32 " of %zu", corner->normal,
                         polygons->normal_count);
    if (!is_finite(polygons->positions[corner->position]))
        return fail_face(work, face, "a coordinate of vertex %" PRIu32 " is not finite",
                         corner->position);
    return FM_OK;
}

static fm_status fail_cut(const mesh_work *work, fm_cut cut, size_t face, size_t count)
{
    if (cut == FM_CUT_NO_MEMORY)
        return no_memory(work);
    if (cut == FM_CUT_TOO_LARGE)
        return fail_face(work, face,
                         "it has %zu corners and is not convex: such faces have %d at most", count,
                         POLYGON_CONCAVE_MAX);
    return fail_face(work, face, "of %zu corners, it crosses itself: what it covers is not said",
                     count);
}

static fm_status cut_face(mesh_work *work, size_t face, size_t first, size_t count)
{
    const fm_polygons *polygons = work->polygons;
    if (!triangulator_reserve(&work->cutter, count))
        return no_memory(work);
    for (size_t i = 0; i < count; i++) {
        const fm_corner *corner = &polygons->corners[first + i];
        const fm_status status = check_corner(work, face, corner);
        if (status != FM_OK)
            return status;
        work->cutter.corners[i] = vec3_of(polygons->positions[corner->position]);
    }
    const fm_cut cut = polygon_cut(&work->cutter, count);
    if (cut == FM_CUT_NO_AREA)
        work->polygons->facts.without_area++;
    else if (cut == FM_CUT_WARPED)
        work->polygons->facts.warped++;
    else if (cut != FM_CUT)
        return fail_cut(work, cut, face, count);
    for (size_t i = 0; i < 3 * work->cutter.triangle_count; i++)
        work->corners[work->index_count++] = (uint32_t)first + work->cutter.triangles[i];
    return FM_OK;
}

/* What the file holds instead may be why. */
static fm_status fail_empty(const mesh_work *work)
{
    fm_text rest = { 0 };
    mesh_facts_rest(&rest, &work->polygons->facts);
    fm_fail(work->err, FM_INVALID, "%s: no triangles%s", work->path,
            rest.bytes != NULL ? rest.bytes : "");
    text_free(&rest);
    return FM_INVALID;
}

static fm_status cut_faces(mesh_work *work)
{
    const fm_polygons *polygons = work->polygons;
    fm_status status = FM_OK;
    size_t first = 0;
    if (polygons->face_count == 0)
        return fail_empty(work);
    work->corners =
        calloc(polygons->corner_count - 2 * polygons->face_count, 3 * sizeof *work->corners);
    if (work->corners == NULL)
        return no_memory(work);
    for (size_t i = 0; i < polygons->face_count && status == FM_OK; i++) {
        status = cut_face(work, i, first, polygons->ends[i] - first);
        first = polygons->ends[i];
    }
    if (status == FM_OK && work->index_count == 0)
        status = fm_fail(work->err, FM_INVALID, "%s: no triangle has an area", work->path);
    if (status == FM_OK && work->index_count > indices_max)
        status = fm_fail(work->err, FM_INVALID, "%s: %zu indices; at most %zu", work->path,
                         work->index_count, indices_max);
    return status;
}

/* The box of what triangles use: a stray vertex must not move the camera. */
static fm_box box_of(const mesh_work *work)
{
    fm_box box = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
    for (size_t i = 0; i < work->index_count; i++) {
        const uint32_t position = work->polygons->corners[work->corners[i]].position;
        for (int axis = 0; axis < 3; axis++) {
            const double at = work->polygons->positions[position][axis];
            box.low[axis] = fmin(box.low[axis], at);
            box.high[axis] = fmax(box.high[axis], at);
        }
    }
    return box;
}

/* How far apart floats are at the box, as a part of its largest side. */
static double float_spacing(const fm_box *box)
{
    double farthest = 0.0, side = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        farthest = fmax(farthest, fmax(fabs(box->low[axis]), fabs(box->high[axis])));
        side = fmax(side, box->high[axis] - box->low[axis]);
    }
    const float at = (float)farthest;
    return ((double)nextafterf(at, INFINITY) - (double)at) / side;
}

/* What a reader rounded to floats cannot be told apart again. */
static fm_status check_spacing(const mesh_work *work)
{
    fm_mesh_facts *facts = &work->polygons->facts;
    if (!work->polygons->is_single)
        return FM_OK;
    const double spacing = float_spacing(&facts->box);
    if (spacing > spacing_max)
        return fm_fail(work->err, FM_INVALID,
                       "%s: coordinates of %s files are read as floats, which here are %.2g of the "
                       "mesh's size apart: move it near the origin, or save it as OBJ or PLY",
                       work->path, facts->format, spacing);
    facts->spacing = spacing > spacing_told ? spacing : 0.0;
    return FM_OK;
}

static void move_into_space(fm_mesh *mesh, mesh_work *work)
{
    fm_polygons *polygons = work->polygons;
    mesh->space = space_of(&polygons->facts.box);
    mesh->box = space_box(&mesh->space, &polygons->facts.box);
    for (size_t i = 0; i < polygons->position_count; i++) {
        double moved[3];
        space_point(moved, &mesh->space, polygons->positions[i]);
        memcpy(polygons->positions[i], moved, sizeof moved);
    }
}

static const double *position_of(const mesh_work *work, size_t index)
{
    return work->polygons->positions[work->polygons->corners[work->corners[index]].position];
}

/* Its length is twice the triangle's area. */
static vec3 triangle_normal(const mesh_work *work, size_t first)
{
    const vec3 a = vec3_of(position_of(work, first));
    return cross(minus(vec3_of(position_of(work, first + 1)), a),
                 minus(vec3_of(position_of(work, first + 2)), a));
}

/* Replaces the file's normals by one for each triangle. */
static fm_status make_flat(mesh_work *work)
{
    fm_status status = FM_OK;
    work->polygons->normal_count = 0;
    for (size_t i = 0; i < work->index_count && status == FM_OK; i += 3) {
        const vec3 n = normalized(triangle_normal(work, i));
        status = polygons_normal(work->polygons, (double[3]){ n.x, n.y, n.z }, work->err);
    }
    return status;
}

static bool is_usable(const double normal[3])
{
    return is_finite(normal) &&
           (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]) > 0.0;
}

/* What makes the corner at `index` one vertex with others: its place and its normal. */
static fm_corner key_of(const mesh_work *work, size_t index)
{
    const fm_polygons *polygons = work->polygons;
    const fm_corner *corner = &polygons->corners[work->corners[index]];
    const uint32_t normal = polygons->is_flat ? (uint32_t)(index / 3) : corner->normal;
    const bool is_own = normal != FM_NO_NORMAL && is_usable(polygons->normals[normal]);
    return (fm_corner){ work->place[corner->position],
                        is_own ? work->slope[normal] : FM_NO_NORMAL };
}

static fm_status share(mesh_work *work)
{
    const fm_polygons *polygons = work->polygons;
    assert(work->index_count > 0); /* cut_faces refuses an empty mesh */
    work->place = calloc(polygons->position_count + 1, sizeof *work->place);
    work->slope = calloc(polygons->normal_count + 1, sizeof *work->slope);
    work->smooth = calloc(polygons->position_count + 1, sizeof *work->smooth);
    work->keys = calloc(work->index_count, sizeof *work->keys);
    if (work->place == NULL || work->slope == NULL || work->smooth == NULL || work->keys == NULL ||
        !weld(work->place, polygons->positions, sizeof polygons->positions[0],
              polygons->position_count) ||
        !weld(work->slope, polygons->normals, sizeof polygons->normals[0], polygons->normal_count))
        return no_memory(work);
    for (size_t i = 0; i < work->index_count; i++) {
        work->keys[i] = key_of(work, i);
        vec3 *sum = &work->smooth[work->keys[i].position];
        *sum = plus(*sum, normalized(triangle_normal(work, i - i % 3)));
    }
    return FM_OK;
}

static void add_vertex(fm_mesh *mesh, const mesh_work *work, const fm_corner *key)
{
    const uint32_t vertex = mesh->vertex_count++;
    for (int axis = 0; axis < 3; axis++)
        mesh->positions[vertex][axis] = (float)work->polygons->positions[key->position][axis];
    mesh->normals[vertex] = key->normal == FM_NO_NORMAL
                                ? work->smooth[key->position]
                                : vec3_of(work->polygons->normals[key->normal]);
}

/* Vertices in the order in which triangles first use them. */
static fm_status fill(fm_mesh *mesh, const mesh_work *work)
{
    const size_t count = work->index_count;
    uint32_t *first = calloc(count, sizeof *first);
    mesh->positions = calloc(count, sizeof *mesh->positions);
    mesh->normals = calloc(count, sizeof *mesh->normals);
    mesh->indices = calloc(count, sizeof *mesh->indices);
    if (first == NULL || mesh->positions == NULL || mesh->normals == NULL ||
        mesh->indices == NULL || !weld(first, work->keys, sizeof work->keys[0], count)) {
        free(first);
        return no_memory(work);
    }
    for (size_t i = 0; i < count; i++) {
        if (first[i] == i)
            add_vertex(mesh, work, &work->keys[i]);
        mesh->indices[i] = first[i] == i ? mesh->vertex_count - 1 : mesh->indices[first[i]];
    }
    mesh->index_count = (uint32_t)count;
    free(first);
    return FM_OK;
}

static vec3 float_point(const fm_mesh *mesh, size_t index)
{
    const float *p = mesh->positions[mesh->indices[index]];
    return (vec3){ (double)p[0], (double)p[1], (double)p[2] };
}

static fm_status fill_facts(fm_mesh *mesh, const mesh_work *work)
{
    mesh->facts = work->polygons->facts;
    mesh->facts.triangles = mesh->index_count / 3;
    mesh->facts.vertices = mesh->vertex_count;
    for (size_t i = 0; i < mesh->index_count; i += 3)
        mesh->facts.lost_area += !triangle_has_area(float_point(mesh, i), float_point(mesh, i + 1),
                                                    float_point(mesh, i + 2));
    if (mesh->facts.lost_area == mesh->facts.triangles)
        return fm_fail(work->err, FM_INVALID, "%s: no triangle has an area that a float holds",
                       work->path);
    return FM_OK;
}

fm_status mesh_build(fm_mesh *mesh, fm_polygons *polygons, const char *path, fm_error *err)
{
    mesh_work work = { .polygons = polygons, .path = path, .err = err };
    fm_status status = cut_faces(&work);
    if (status == FM_OK) {
        polygons->facts.box = box_of(&work);
        status = check_spacing(&work);
    }
    if (status == FM_OK) {
        move_into_space(mesh, &work);
        status = polygons->is_flat ? make_flat(&work) : FM_OK;
    }
    if (status == FM_OK)
        status = share(&work);
    if (status == FM_OK)
        status = fill(mesh, &work);
    if (status == FM_OK)
        status = fill_facts(mesh, &work);
    triangulator_free(&work.cutter);
    free(work.corners);
    free(work.place);
    free(work.slope);
    free(work.smooth);
    free(work.keys);
    return status;
}
