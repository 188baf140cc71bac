#include "setup.h"

enum { Z_FRACTION_BITS = 7, CENTRE = FRAMES_SUBPIXELS / 2 };
#define GRADIENT_MAX (1ll << 40)

static int64_t minimum(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static int64_t maximum(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

/* Division that rounds down. */
static int64_t floor_div(int64_t value, int64_t by)
{
    return value / by - (value % by < 0 ? 1 : 0);
}

static tbr_edge make_edge(const fm_corner *from, const fm_corner *to)
{
    const int64_t dx = (int64_t)to->x - from->x, dy = (int64_t)to->y - from->y;
    const bool has_zero = dy < 0 || (dy == 0 && dx > 0);
    return (tbr_edge){
        .c = dx * (CENTRE - from->y) - dy * (CENTRE - from->x) - (has_zero ? 0 : 1),
        .a = (int32_t)(-dy * FRAMES_SUBPIXELS),
        .b = (int32_t)(dx * FRAMES_SUBPIXELS),
    };
}

/* The value at corner 0, its differences at corners 1 and 2, with fraction bits. */
typedef struct plane_source {
    int64_t value, first, second;
    int fraction_bits;
} plane_source;

static int64_t gradient(int64_t numerator, int fraction_bits, int64_t area)
{
    const int64_t slope = numerator * FRAMES_SUBPIXELS * (1 << fraction_bits) / area;
    return maximum(-GRADIENT_MAX, minimum(GRADIENT_MAX, slope));
}

static tbr_plane make_plane(const plane_source *source, const fm_corner *c[3], int64_t area)
{
    const int64_t x1 = c[1]->x - c[0]->x, y1 = c[1]->y - c[0]->y;
    const int64_t x2 = c[2]->x - c[0]->x, y2 = c[2]->y - c[0]->y;
    const int64_t gx =
        gradient(source->first * y2 - source->second * y1, source->fraction_bits, area);
    const int64_t gy =
        gradient(source->second * x1 - source->first * x2, source->fraction_bits, area);
    const int64_t moved =
        floor_div(gx * (CENTRE - c[0]->x) + gy * (CENTRE - c[0]->y), FRAMES_SUBPIXELS);
    return (tbr_plane){
        .base =
            (uint32_t)((uint64_t)(source->value * (1 << source->fraction_bits)) + (uint64_t)moved),
        .gx = (uint32_t)(uint64_t)gx,
        .gy = (uint32_t)(uint64_t)gy,
    };
}

static int64_t wrapped_difference(uint32_t to, uint32_t from)
{
    return (int64_t)(int32_t)(to - from);
}

static void make_planes(tbr_setup *setup, const fm_corner *c[3], int64_t area)
{
    const plane_source z = { c[0]->z, (int64_t)c[1]->z - c[0]->z, (int64_t)c[2]->z - c[0]->z,
                             Z_FRACTION_BITS };
    const plane_source u = { c[0]->u, wrapped_difference(c[1]->u, c[0]->u),
                             wrapped_difference(c[2]->u, c[0]->u), 0 };
    const plane_source v = { c[0]->v, wrapped_difference(c[1]->v, c[0]->v),
                             wrapped_difference(c[2]->v, c[0]->v), 0 };
    setup->z = make_plane(&z, c, area);
    setup->u = make_plane(&u, c, area);
    setup->v = make_plane(&v, c, area);
    setup->z_min = (uint32_t)minimum(c[0]->z, minimum(c[1]->z, c[2]->z));
    setup->z_max = (uint32_t)maximum(c[0]->z, maximum(c[1]->z, c[2]->z));
}

/* First pixel whose centre is not left of (above) the position. */
static int32_t first_pixel(int32_t position)
{
    return (int32_t)-floor_div(CENTRE - position, FRAMES_SUBPIXELS);
}

static void make_box(tbr_setup *setup, const fm_corner *c[3], uint32_t width_px, uint32_t height_px)
{
    int32_t low_x = c[0]->x, high_x = c[0]->x, low_y = c[0]->y, high_y = c[0]->y;
    for (int i = 1; i < 3; i++) {
        low_x = (int32_t)minimum(low_x, c[i]->x);
        high_x = (int32_t)maximum(high_x, c[i]->x);
        low_y = (int32_t)minimum(low_y, c[i]->y);
        high_y = (int32_t)maximum(high_y, c[i]->y);
    }
    setup->x0 = (int32_t)maximum(0, first_pixel(low_x));
    setup->y0 = (int32_t)maximum(0, first_pixel(low_y));
    setup->x1 = (int32_t)minimum(width_px, floor_div(high_x - CENTRE, FRAMES_SUBPIXELS) + 1);
    setup->y1 = (int32_t)minimum(height_px, floor_div(high_y - CENTRE, FRAMES_SUBPIXELS) + 1);
}

bool setup_triangle(tbr_setup *setup, const fm_triangle *triangle, uint32_t width_px,
                    uint32_t height_px)
{
    const fm_corner *c[3] = { &triangle->corners[0], &triangle->corners[1], &triangle->corners[2] };
    int64_t area = ((int64_t)c[1]->x - c[0]->x) * ((int64_t)c[2]->y - c[0]->y) -
                   ((int64_t)c[2]->x - c[0]->x) * ((int64_t)c[1]->y - c[0]->y);
    make_box(setup, c, width_px, height_px);
    if (area == 0 || setup->x0 >= setup->x1 || setup->y0 >= setup->y1)
        return false;
    if (area < 0) {
        const fm_corner *kept = c[1];
        c[1] = c[2];
        c[2] = kept;
        area = -area;
    }
    for (int i = 0; i < 3; i++)
        setup->edges[i] = make_edge(c[i], c[(i + 1) % 3]);
    make_planes(setup, c, area);
    return true;
}
