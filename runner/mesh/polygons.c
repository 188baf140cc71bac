#include "polygons.h"

#include <stdlib.h>

static const size_t count_max = (size_t)1 << 31;

/* Room for one more item of an array. */
static fm_status grow(void **items, size_t *room, size_t count, size_t item_bytes, fm_error *err)
{
    if (count < *room)
        return FM_OK;
    if (count >= count_max)
        return fm_fail(err, FM_INVALID, "more than 2^31 vertices or corners");
    const size_t wanted = *room > 0 ? 2 * *room : 256;
    void *grown = reallocarray(*items, wanted, item_bytes);
    if (grown == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu vertices or corners", wanted);
    *items = grown;
    *room = wanted;
    return FM_OK;
}

static fm_status add_triple(double (**items)[3], size_t *count, size_t *room,
                            const double triple[3], fm_error *err)
{
    void *grown = *items;
    const fm_status status = grow(&grown, room, *count, sizeof **items, err);
    *items = grown;
    if (status != FM_OK)
        return status;
    for (int axis = 0; axis < 3; axis++)
        (*items)[*count][axis] = triple[axis] + 0.0; /* -0 and 0 are one value */
    (*count)++;
    return FM_OK;
}

fm_status polygons_position(fm_polygons *polygons, const double at[3], fm_error *err)
{
    return add_triple(&polygons->positions, &polygons->position_count, &polygons->position_room, at,
                      err);
}

fm_status polygons_normal(fm_polygons *polygons, const double normal[3], fm_error *err)
{
    return add_triple(&polygons->normals, &polygons->normal_count, &polygons->normal_room, normal,
                      err);
}

fm_status polygons_corner(fm_polygons *polygons, uint32_t position, uint32_t normal, fm_error *err)
{
    void *grown = polygons->corners;
    const fm_status status = grow(&grown, &polygons->corner_room, polygons->corner_count,
                                  sizeof polygons->corners[0], err);
    polygons->corners = grown;
    if (status == FM_OK)
        polygons->corners[polygons->corner_count++] = (fm_corner){ position, normal };
    return status;
}

fm_status polygons_end_face(fm_polygons *polygons, uint64_t origin, fm_error *err)
{
    const size_t first = polygons->face_count > 0 ? polygons->ends[polygons->face_count - 1] : 0;
    const size_t corners = polygons->corner_count - first;
    if (corners < 3) {
        polygons->corner_count = first;
        polygons->facts.points += corners == 1;
        polygons->facts.lines += corners == 2;
        polygons->facts.without_area += corners == 0;
        return FM_OK;
    }
    void *ends = polygons->ends, *origins = polygons->origins;
    fm_status status =
        grow(&ends, &polygons->face_room, polygons->face_count, sizeof polygons->ends[0], err);
    polygons->ends = ends;
    if (status == FM_OK)
        status = grow(&origins, &polygons->origin_room, polygons->face_count,
                      sizeof polygons->origins[0], err);
    polygons->origins = origins;
    if (status != FM_OK)
        return status;
    polygons->origins[polygons->face_count] = origin;
    polygons->ends[polygons->face_count++] = polygons->corner_count;
    return FM_OK;
}

void polygons_ignore(fm_polygons *polygons, fm_mesh_ignored what)
{
    polygons->facts.ignored |= 1u << what;
}

void polygons_free(fm_polygons *polygons)
{
    free(polygons->positions);
    free(polygons->normals);
    free(polygons->corners);
    free(polygons->ends);
    free(polygons->origins);
    *polygons = (fm_polygons){ 0 };
}
