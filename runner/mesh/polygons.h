/* What a reader of a format fills: polygons as the file has them, in doubles. */
#ifndef FM_POLYGONS_H
#define FM_POLYGONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "facts.h"

#define FM_NO_NORMAL UINT32_MAX

typedef struct fm_corner {
    uint32_t position, normal; /* FM_NO_NORMAL: smooth, from the faces about it */
} fm_corner;

/* Starts as {0}. Readers fill format, parts, lines, points, ignored and spacing of the facts. */
typedef struct fm_polygons {
    double (*positions)[3];
    double (*normals)[3]; /* any length */
    fm_corner *corners;
    size_t *ends;      /* face i: corners ends[i - 1] to ends[i] - 1 */
    uint64_t *origins; /* [face_count]: the line that a face begins on, or its number in the file */
    const char *element; /* what origins count, from 0: "face"; NULL: lines, from 1 */
    size_t position_count, normal_count, corner_count, face_count;
    size_t position_room, normal_room, corner_room, face_room, origin_room;
    bool is_flat;   /* faces have their own normals, and the file's are not used */
    bool is_single; /* coordinates were rounded to floats on the way */
    fm_mesh_facts facts;
} fm_polygons;

/* FM_NO_MEMORY, or FM_INVALID above 2^31 of a kind. */
fm_status polygons_position(fm_polygons *polygons, const double at[3], fm_error *err);
fm_status polygons_normal(fm_polygons *polygons, const double normal[3], fm_error *err);
fm_status polygons_corner(fm_polygons *polygons, uint32_t position, uint32_t normal, fm_error *err);
/* Makes a face of the corners since the last one; one or two are counted as a point or a line. */
fm_status polygons_end_face(fm_polygons *polygons, uint64_t origin, fm_error *err);
void polygons_ignore(fm_polygons *polygons, fm_mesh_ignored what);
void polygons_free(fm_polygons *polygons);

#endif
