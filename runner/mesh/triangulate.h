/* A polygon cut into triangles: convex ones from their first corner, others ear by ear. */
#ifndef FM_TRIANGULATE_H
#define FM_TRIANGULATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/vec3.h"

typedef enum fm_cut {
    FM_CUT,
    FM_CUT_NO_AREA,   /* no triangles */
    FM_CUT_CROSSES,   /* the border crosses itself in a plane: what is inside is not said */
    FM_CUT_WARPED,    /* it crosses itself as seen along the mean normal, but lies in no plane: cut
                         from its first corner */
    FM_CUT_TOO_LARGE, /* not convex, and above POLYGON_CONCAVE_MAX corners */
    FM_CUT_NO_MEMORY
} fm_cut;

/* Ears take the square of the corners: a zigzag or a spiral of so many takes 0.5 to 0.9 s. */
enum { POLYGON_CONCAVE_MAX = 8192 };

/* Starts as {0}; is used again for the next polygon. */
typedef struct fm_triangulator {
    vec3 *corners;       /* [room]: the polygon, filled by the caller up to count */
    uint32_t *triangles; /* [triangle_count][3]: numbers of corners */
    size_t triangle_count;
    /* its own */
    double (*flat)[2];
    uint32_t *previous, *next;
    bool *is_reflex;
    uint8_t *ear_kinds;
    size_t room;
} fm_triangulator;

/* Room for a polygon of so many corners. */
bool triangulator_reserve(fm_triangulator *t, size_t count);
void triangulator_free(fm_triangulator *t);
/* Cuts corners[0 .. count - 1], finite, count >= 3. Triangles turn as the polygon does; those
 * without area are left out. Positions that lie off the polygon's mean plane are kept. */
fm_cut polygon_cut(fm_triangulator *t, size_t count);
/* Whether three points span a triangle, beyond rounding. */
bool triangle_has_area(vec3 a, vec3 b, vec3 c);

#endif
