#include "rasterise.h"

#include <math.h>
#include <string.h>

/* A coordinate of 2^64 or more, an infinity or no number. */
static const uint32_t too_large_bits = 0x5F800000u;
static const uint32_t least_normal_bits = 0x00800000u;
static const float w_least = 0x1p-40f;

typedef struct polygon {
    fm_clip_corner corners[RASTER_CORNERS_MAX];
    uint32_t count;
} polygon;

/* A corner in 1/256 px. */
typedef struct snapped {
    int32_t x, y;
    float z;
} snapped;

/* Inside is a x + b y + c >= 0, x and y whole pixels. */
typedef struct edge {
    int64_t a, b, c;
} edge;

typedef struct raster_triangle {
    snapped corners[3];
    edge edges[3];
    float dz_dx, dz_dy; /* by 1/256 px */
    float z_least, z_most;
    int64_t x0, y0, x1, y1; /* pixels whose centres the box holds; x1, y1 included */
} raster_triangle;

static uint32_t bits_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static float reciprocal(float v)
{
    const uint32_t bits = 0x7EF311C7u - bits_of(v);
    float r;
    memcpy(&r, &bits, sizeof r);
    for (int i = 0; i < 4; i++)
        r = r * (2.0f - v * r);
    return v == 1.0f ? 1.0f : r;
}

float raster_guard(uint32_t size_px)
{
    float guard = 1.0f;
    while ((double)guard * 2 * size_px / 2 <= RASTER_GUARD_PX)
        guard *= 2;
    return guard;
}

/* ---- clip ---- */

typedef struct guard_band {
    float x, y;
} guard_band;

/* Positive or 0: inside. */
static float distance(const fm_clip_corner *c, int plane, const guard_band *guard)
{
    const float bx = guard->x * c->w, by = guard->y * c->w;
    const float distances[RASTER_PLANES] = {
        c->w - w_least, c->z, c->w - c->z, bx + c->x, bx - c->x, by + c->y, by - c->y,
    };
    return distances[plane];
}

static bool is_finite(const fm_clip_corner *c)
{
    const float values[4] = { c->x, c->y, c->z, c->w };
    for (int i = 0; i < 4; i++)
        if ((bits_of(values[i]) & 0x7FFFFFFFu) >= too_large_bits)
            return false;
    return true;
}

static fm_clip_corner between(const fm_clip_corner *in, const fm_clip_corner *out, float d_in,
                              float d_out)
{
    const float t = fminf(d_in * reciprocal(d_in - d_out), 1.0f);
    return (fm_clip_corner){ in->x + (out->x - in->x) * t, in->y + (out->y - in->y) * t,
                             in->z + (out->z - in->z) * t, in->w + (out->w - in->w) * t };
}

static void add_corner(polygon *to, const fm_clip_corner *corner)
{
    if (to->count < RASTER_CORNERS_MAX) /* rounding could make a thin polygon cross twice */
        to->corners[to->count++] = *corner;
}

static void clip_by(polygon *shape, int plane, const guard_band *guard)
{
    polygon kept = { .count = 0 };
    for (uint32_t i = 0; i < shape->count; i++) {
        const fm_clip_corner *a = &shape->corners[i];
        const fm_clip_corner *b = &shape->corners[(i + 1) % shape->count];
        const float da = distance(a, plane, guard), db = distance(b, plane, guard);
        if (da >= 0.0f)
            add_corner(&kept, a);
        if ((da >= 0.0f) == (db >= 0.0f))
            continue;
        /* Always from the inside: both triangles at an edge cut it at the same point. */
        const fm_clip_corner cut = da >= 0.0f ? between(a, b, da, db) : between(b, a, db, da);
        add_corner(&kept, &cut);
    }
    *shape = kept;
}

/* A bit a plane: set in *any where a corner is outside, in *all where all three are. */
static void outcodes(uint32_t *any, uint32_t *all, const fm_clip_corner corners[3],
                     const guard_band *guard)
{
    *any = 0;
    *all = (1u << RASTER_PLANES) - 1u;
    for (int i = 0; i < 3; i++) {
        uint32_t code = 0;
        for (int plane = 0; plane < RASTER_PLANES; plane++)
            code |= (uint32_t) !(distance(&corners[i], plane, guard) >= 0.0f) << plane;
        *any |= code;
        *all &= code;
    }
}

static bool all_finite(const fm_clip_corner corners[3])
{
    return is_finite(&corners[0]) && is_finite(&corners[1]) && is_finite(&corners[2]);
}

static guard_band guard_of(uint32_t width_px, uint32_t height_px)
{
    return (guard_band){ raster_guard(width_px), raster_guard(height_px) };
}

bool raster_needs_clip(uint32_t width_px, uint32_t height_px, const fm_clip_corner corners[3])
{
    const guard_band guard = guard_of(width_px, height_px);
    uint32_t any, all;
    if (!all_finite(corners))
        return true;
    outcodes(&any, &all, corners, &guard);
    return any != 0;
}

static void clip(polygon *shape, const fm_clip_corner corners[3], const guard_band *guard)
{
    uint32_t any, all;
    *shape = (polygon){ .count = 0 };
    if (!all_finite(corners))
        return;
    outcodes(&any, &all, corners, guard);
    if (all != 0)
        return;
    memcpy(shape->corners, corners, 3 * sizeof corners[0]);
    shape->count = 3;
    for (int plane = 0; plane < RASTER_PLANES; plane++)
        if ((any >> plane & 1u) != 0)
            clip_by(shape, plane, guard);
}

/* ---- set up ---- */

static snapped snap(const fm_clip_corner *corner, const fm_raster_target *target)
{
    const float half = RASTER_SUBPIXELS / 2; /* of a pixel's subpixels */
    const float r = reciprocal(corner->w);
    const float half_x = (float)target->width_px * half, half_y = (float)target->height_px * half;
    const float x = corner->x * r * half_x + half_x, y = corner->y * r * half_y + half_y;
    return (snapped){ .x = (int32_t)floorf(x + 0.5f),
                      .y = (int32_t)floorf(y + 0.5f),
                      .z = fminf(fmaxf(corner->z * r, 0.0f), 1.0f) };
}

/* Pixel centres at or right of the subpixel; and at or left of it. */
static int64_t first_centre(int32_t subpixel)
{
    return ((int64_t)subpixel + RASTER_SUBPIXELS / 2 - 1) >> 8;
}
static int64_t last_centre(int32_t subpixel)
{
    return ((int64_t)subpixel - RASTER_SUBPIXELS / 2) >> 8;
}

static int32_t least(int32_t a, int32_t b, int32_t c)
{
    const int32_t ab = a < b ? a : b;
    return ab < c ? ab : c;
}
static int32_t most(int32_t a, int32_t b, int32_t c)
{
    const int32_t ab = a > b ? a : b;
    return ab > c ? ab : c;
}

static edge edge_of(const snapped *from, const snapped *to)
{
    const int64_t a = (int64_t)from->y - to->y, b = (int64_t)to->x - from->x;
    const bool is_top_left = a > 0 || (a == 0 && b > 0);
    const int64_t c = -(a * (from->x - 128) + b * (from->y - 128)) - (is_top_left ? 0 : 1);
    return (edge){ a, b, c >> 8 };
}

static void set_box(raster_triangle *t, const fm_raster_target *target)
{
    const snapped *p = t->corners;
    const int64_t low_y = target->first_row, high_y = (int64_t)target->last_row - 1;
    t->x0 = first_centre(least(p[0].x, p[1].x, p[2].x));
    t->x1 = last_centre(most(p[0].x, p[1].x, p[2].x));
    t->y0 = first_centre(least(p[0].y, p[1].y, p[2].y));
    t->y1 = last_centre(most(p[0].y, p[1].y, p[2].y));
    t->x0 = t->x0 > 0 ? t->x0 : 0;
    t->x1 = t->x1 < target->width_px ? t->x1 : (int64_t)target->width_px - 1;
    t->y0 = t->y0 > low_y ? t->y0 : low_y;
    t->y1 = t->y1 < high_y ? t->y1 : high_y;
}

/* As the device makes a float of 64 bits: by halves. */
static float float_of(int64_t value)
{
    return (float)(int32_t)(value >> 32) * 4294967296.0f + (float)(uint32_t)value;
}

/* False: it covers nothing. */
static bool set_up(raster_triangle *t, const fm_clip_corner *const corners[3],
                   const fm_raster_target *target)
{
    snapped p[3];
    for (int i = 0; i < 3; i++)
        p[i] = snap(corners[i], target);
    int64_t area = (int64_t)(p[1].x - p[0].x) * (p[2].y - p[0].y) -
                   (int64_t)(p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (area == 0)
        return false;
    t->corners[0] = p[0];
    t->corners[1] = area > 0 ? p[1] : p[2];
    t->corners[2] = area > 0 ? p[2] : p[1];
    area = area > 0 ? area : -area;
    for (int i = 0; i < 3; i++)
        t->edges[i] = edge_of(&t->corners[i], &t->corners[(i + 1) % 3]);
    const snapped *q = t->corners;
    const float r = reciprocal(float_of(area));
    const float d1 = q[1].z - q[0].z, d2 = q[2].z - q[0].z;
    t->dz_dx = (d1 * (float)(q[2].y - q[0].y) - d2 * (float)(q[1].y - q[0].y)) * r;
    t->dz_dy = (d2 * (float)(q[1].x - q[0].x) - d1 * (float)(q[2].x - q[0].x)) * r;
    t->z_least = fminf(fminf(q[0].z, q[1].z), q[2].z);
    t->z_most = fmaxf(fmaxf(q[0].z, q[1].z), q[2].z);
    set_box(t, target);
    return t->x0 <= t->x1 && t->y0 <= t->y1;
}

/* ---- fragments ---- */

static float depth_at(const raster_triangle *t, int64_t x, int64_t y)
{
    const float dx = (float)(int32_t)(x * 256 + 128 - t->corners[0].x);
    const float dy = (float)(int32_t)(y * 256 + 128 - t->corners[0].y);
    const float z = t->corners[0].z + (t->dz_dx * dx + t->dz_dy * dy);
    const float depth = fminf(fmaxf(z, t->z_least), t->z_most);
    return (bits_of(depth) & 0x7FFFFFFFu) < least_normal_bits ? 0.0f : depth;
}

static void draw_row(const raster_triangle *t, int64_t y, const fm_raster_target *target)
{
    int64_t e[3];
    for (int i = 0; i < 3; i++)
        e[i] = t->edges[i].a * t->x0 + t->edges[i].b * y + t->edges[i].c;
    for (int64_t x = t->x0; x <= t->x1; x++) {
        if ((e[0] | e[1] | e[2]) >= 0)
            target->fragment(target->context, (uint32_t)x, (uint32_t)y, depth_at(t, x, y));
        for (int i = 0; i < 3; i++)
            e[i] += t->edges[i].a;
    }
}

void rasterise_triangle(const fm_raster_target *target, const fm_clip_corner corners[3])
{
    const guard_band guard = guard_of(target->width_px, target->height_px);
    polygon shape;
    raster_triangle t;
    clip(&shape, corners, &guard);
    for (uint32_t i = 2; i < shape.count; i++) {
        const fm_clip_corner *fan[3] = { &shape.corners[0], &shape.corners[i - 1],
                                         &shape.corners[i] };
        if (!set_up(&t, fan, target))
            continue;
        for (int64_t y = t.y0; y <= t.y1; y++)
            draw_row(&t, y, target);
    }
}
