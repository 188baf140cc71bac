#include "polygons.h"

#include <math.h>
#include <string.h>

enum {
    TOKEN_PASS_THROUGH = 0x0700, /* OpenGL's GL_*_TOKEN */
    TOKEN_POINT,
    TOKEN_LINE,
    TOKEN_POLYGON,
    TOKEN_BITMAP,
    TOKEN_DRAW_PIXEL,
    TOKEN_COPY_PIXEL,
    TOKEN_LINE_RESET,
    MAX_CORNERS = 32, /* of a polygon that was clipped at six planes and a scissor */
};

typedef struct corner {
    float of[POLYGON_FLOATS];
} corner;

typedef struct polygon {
    corner corners[MAX_CORNERS];
    uint32_t count;
} polygon;

/* ---- scissor ---- */

/* Signed distance to one side: inside where it is not negative. */
static float distance(const corner *c, const polygon_view *view, unsigned side)
{
    switch (side) {
    case 0:
        return c->of[0] - view->left;
    case 1:
        return view->right - c->of[0];
    case 2:
        return c->of[1] - view->bottom;
    default:
        return view->top - c->of[1];
    }
}

static corner between(const corner *a, const corner *b, float share)
{
    corner made;
    for (int i = 0; i < POLYGON_FLOATS; i++)
        made.of[i] = a->of[i] + share * (b->of[i] - a->of[i]);
    return made;
}

static void push(polygon *to, const corner *c)
{
    if (to->count < MAX_CORNERS)
        to->corners[to->count++] = *c;
}

/* Sutherland and Hodgman, one side. */
static polygon clip_side(const polygon *from, const polygon_view *view, unsigned side)
{
    polygon kept = { .count = 0 };
    for (uint32_t i = 0; i < from->count; i++) {
        const corner *a = &from->corners[i], *b = &from->corners[(i + 1) % from->count];
        const float da = distance(a, view, side), db = distance(b, view, side);
        if (da >= 0)
            push(&kept, a);
        if ((da >= 0) != (db >= 0)) {
            const corner crossing = between(a, b, da / (da - db));
            push(&kept, &crossing);
        }
    }
    return kept;
}

/* ---- units ---- */

static int32_t fixed(double px)
{
    const double most = FRAMES_COORDINATE_MAX;
    return isfinite(px) ? (int32_t)lround(fmin(fmax(px * FRAMES_SUBPIXELS, -most), most)) : 0;
}

/* Texels with 16 bits of fraction, wrapping. */
static uint32_t texels(double coordinate, uint32_t size)
{
    const double wanted = coordinate * size;
    return isfinite(wanted) && fabs(wanted) < 0x1p40 ? (uint32_t)llround(wanted * 0x1p16) : 0;
}

static uint32_t byte_of(float channel)
{
    return isfinite(channel) ? (uint32_t)lroundf(fminf(fmaxf(channel, 0), 1) * 255) : 0;
}

static uint32_t hash_colours(const polygon *p)
{
    uint32_t hash = 0x811C9DC5u;
    for (uint32_t i = 0; i < p->count; i++)
        for (int c = 3; c < 7; c++)
            hash = (hash ^ byte_of(p->corners[i].of[c])) * 0x01000193u;
    return hash ^ hash >> 16;
}

static fm_corner convert(const corner *c, const polygon_view *view, uint32_t shift)
{
    const double z = isfinite(c->of[2]) ? fmin(fmax((double)c->of[2], 0), 1) : 1;
    return (fm_corner){ .x = fixed((double)c->of[0]),
                        .y = fixed(view->height_px - (double)c->of[1]),
                        .z = (uint32_t)lround(z * FRAMES_DEPTH_MAX),
                        .u = texels((double)c->of[7], view->texture_width) + (shift << 16),
                        .v = texels((double)c->of[8], view->texture_height) };
}

/* ---- the list ---- */

static void add_polygon(fm_frame_builder *builder, polygon_totals *totals, const polygon *whole,
                        const polygon_view *view)
{
    polygon p = *whole;
    const uint32_t shift = hash_colours(whole);
    for (unsigned side = 0; view->has_scissor && side < 4; side++)
        p = clip_side(&p, view, side);
    for (uint32_t i = 2; i < p.count; i++) {
        const fm_triangle triangle = { { convert(&p.corners[0], view, shift),
                                         convert(&p.corners[i - 1], view, shift),
                                         convert(&p.corners[i], view, shift) } };
        frame_builder_triangle(builder, &triangle);
        totals->triangles++;
    }
}

static void note_alpha(polygon_alpha *alpha, const polygon *p)
{
    for (uint32_t i = 0; i < p->count; i++) {
        alpha->least = fminf(alpha->least, p->corners[i].of[6]);
        alpha->most = fmaxf(alpha->most, p->corners[i].of[6]);
    }
}

/* Corners of a primitive that is no polygon; UINT32_MAX: no such token. */
static uint32_t other_corners(int token)
{
    switch (token) {
    case TOKEN_PASS_THROUGH:
        return 0;
    case TOKEN_LINE:
    case TOKEN_LINE_RESET:
        return 2;
    case TOKEN_POINT:
    case TOKEN_BITMAP:
    case TOKEN_DRAW_PIXEL:
    case TOKEN_COPY_PIXEL:
        return 1;
    default:
        return UINT32_MAX;
    }
}

/* The polygon whose corner count is at *at; false: it does not lie whole in the list, or is none.
 */
static bool read_polygon(polygon *p, size_t *at, const float *values, size_t count)
{
    const double corners = *at < count ? (double)values[*at] : 0;
    if (!(corners >= 3 && corners <= MAX_CORNERS))
        return false;
    p->count = (uint32_t)corners;
    if (count - *at - 1 < (size_t)p->count * POLYGON_FLOATS)
        return false;
    memcpy(p->corners, values + *at + 1, p->count * sizeof *p->corners);
    *at += 1 + (size_t)p->count * POLYGON_FLOATS;
    return true;
}

polygon_alpha polygons_add(fm_frame_builder *builder, polygon_totals *totals, const float *values,
                           size_t count, const polygon_view *view)
{
    polygon_alpha alpha = { 1, 0 };
    polygon p;
    for (size_t at = 0; at < count;) {
        const int token = (int)values[at++];
        const uint32_t corners = token == TOKEN_POLYGON ? 0 : other_corners(token);
        if (corners == UINT32_MAX)
            break;
        if (token != TOKEN_POLYGON) {
            totals->dropped += token != TOKEN_PASS_THROUGH;
            at += token == TOKEN_PASS_THROUGH ? 1 : (size_t)corners * POLYGON_FLOATS;
            continue;
        }
        if (!read_polygon(&p, &at, values, count))
            break;
        note_alpha(&alpha, &p);
        add_polygon(builder, totals, &p, view);
    }
    return alpha;
}
