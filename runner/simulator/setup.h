/* Triangles, ready to be rasterised: edges, planes, pixel box. The rules are in frames.h. */
#ifndef FM_TBR_SETUP_H
#define FM_TBR_SETUP_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/frames.h"

/* E(x, y) = c + a x + b y at the centre of pixel (x, y), less one where zero is outside: covered
 * where it is not negative. */
typedef struct tbr_edge {
    int64_t c;
    int32_t a, b;
} tbr_edge;

/* base + gx x + gy y, modulo 2^32. */
typedef struct tbr_plane {
    uint32_t base, gx, gy;
} tbr_plane;

typedef struct tbr_setup {
    tbr_edge edges[3];
    tbr_plane z, u, v;
    int32_t x0, y0, x1, y1; /* pixel box on the screen, half open; empty: x0 >= x1 */
    uint32_t z_min, z_max;  /* of the corners */
    uint32_t draw;
} tbr_setup;

/* Fills *setup, but for draw; false: the triangle covers nothing on the screen. */
bool setup_triangle(tbr_setup *setup, const fm_triangle *triangle, uint32_t width_px,
                    uint32_t height_px);

/* Whether any centre of the 16 by 16 pixels from (x, y) on lies inside each edge. */
static inline bool setup_overlaps(const tbr_setup *setup, int32_t x, int32_t y)
{
    for (int i = 0; i < 3; i++) {
        const tbr_edge *edge = &setup->edges[i];
        const int64_t most = edge->c + (int64_t)edge->a * (edge->a > 0 ? x + 15 : x) +
                             (int64_t)edge->b * (edge->b > 0 ? y + 15 : y);
        if (most < 0)
            return false;
    }
    return true;
}

#endif
