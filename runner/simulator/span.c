/* Loops over LANES are what the compiler turns into vector instructions: no branch inside, no call.
 * Compiled twice, with SPAN_NAME the function's name. */
#include "span.h"

enum { LANES = FM_TILE_SIDE };
#define ALL_CHANNELS 15

typedef struct row {
    int32_t mask[LANES]; /* -1: the fragment is there */
    int32_t z[LANES];    /* 24 bits */
    uint32_t colour[LANES];
    uint32_t hash[LANES];
    int32_t opaque[LANES];
} row;

static uint16_t bits_of(const int32_t mask[LANES])
{
    uint32_t bits = 0;
    for (int i = 0; i < LANES; i++)
        bits |= (uint32_t)mask[i] & (1u << i);
    return (uint16_t)bits;
}

static void cover(row *r, const tbr_span *span, int32_t y)
{
    const int32_t e0 = span->edges[0].e + y * span->edges[0].b, a0 = span->edges[0].a;
    const int32_t e1 = span->edges[1].e + y * span->edges[1].b, a1 = span->edges[1].a;
    const int32_t e2 = span->edges[2].e + y * span->edges[2].b, a2 = span->edges[2].a;
    const int32_t last = span->width - 1;
    for (int32_t i = 0; i < LANES; i++) {
        const int32_t outside = (e0 + i * a0) | (e1 + i * a1) | (e2 + i * a2) | (last - i);
        r->mask[i] = ~(outside >> 31);
    }
}

static void interpolate_z(row *r, const tbr_span *span, int32_t y)
{
    const uint32_t base = span->z.base + (uint32_t)y * span->z.gy, gx = span->z.gx;
    const int32_t low = span->z_min, high = span->z_max;
    for (int i = 0; i < LANES; i++) {
        int32_t z = (int32_t)(base + (uint32_t)i * gx) >> 7;
        z = z < low ? low : z;
        r->z[i] = z > high ? high : z;
    }
}

static void shade(row *r, const tbr_span *span, int32_t y)
{
    const uint32_t u0 = span->u.base + (uint32_t)y * span->u.gy, ux = span->u.gx;
    const uint32_t v0 = span->v.base + (uint32_t)y * span->v.gy, vx = span->v.gx;
    const uint32_t digest = span->digest, alpha = (uint32_t)span->draw->alpha << 24;
    const uint32_t textured = (span->draw->flags & FM_DRAW_TEXTURED_ALPHA) != 0 ? 0xFF000000u : 0;
    for (int i = 0; i < LANES; i++) {
        const uint32_t u = u0 + (uint32_t)i * ux, v = v0 + (uint32_t)i * vx;
        uint32_t h = (u >> 16) * 0x9E3779B1u + (v >> 16) * 0x85EBCA77u + digest;
        h ^= h >> 15;
        h *= 0x2C1B3C6Du;
        h ^= h >> 12;
        const uint32_t opaque = textured & (uint32_t)((int32_t)h >> 31);
        r->hash[i] = h;
        r->colour[i] = (h & 0xFFFFFFu) | alpha | opaque;
    }
}

static void discard(row *r)
{
    for (int i = 0; i < LANES; i++)
        r->mask[i] &= -(int32_t)((r->hash[i] >> 28 & 3) != 0);
}

static void shade_depth(row *r)
{
    for (int i = 0; i < LANES; i++) {
        const int32_t z = r->z[i] + (int32_t)(r->hash[i] & 0xFFFF);
        r->z[i] = z > FRAMES_DEPTH_MAX ? FRAMES_DEPTH_MAX : z;
    }
}

#define TEST(OPERATOR)                                                                             \
    for (int i = 0; i < LANES; i++)                                                                \
        r->mask[i] &= -(int32_t)(2 * r->z[i] OPERATOR(int32_t) depth[i]);                          \
    return

static void test(row *r, const uint32_t depth[LANES], fm_compare compare)
{
    switch (compare) {
    case FM_COMPARE_LESS:
        TEST(<);
    case FM_COMPARE_LESS_EQUAL:
        TEST(<=);
    case FM_COMPARE_EQUAL:
        TEST(==);
    case FM_COMPARE_GREATER:
        TEST(>);
    case FM_COMPARE_GREATER_EQUAL:
        TEST(>=);
    case FM_COMPARE_NOT_EQUAL:
        TEST(!=);
    case FM_COMPARE_NEVER:
        for (int i = 0; i < LANES; i++)
            r->mask[i] = 0;
        return;
    case FM_COMPARE_OFF:
    case FM_COMPARE_ALWAYS:
    case FM_COMPARE_COUNT:
        return;
    }
}

/* Of equal depths: the latest of those with LEQUAL, or else the earliest, whatever came first. */
static void test_exact(row *r, const uint32_t depth[LANES], const uint32_t owner[LANES],
                       const tbr_span *span)
{
    const uint32_t order = span->order;
    const int32_t is_lequal = -(int32_t)(span->draw->depth_test == FM_COMPARE_LESS_EQUAL);
    for (int i = 0; i < LANES; i++) {
        const int32_t z = 2 * r->z[i], there = (int32_t)depth[i];
        const int32_t is_later = -(int32_t)(order > owner[i] >> 1);
        const int32_t owner_lequal = -(int32_t)(owner[i] & 1);
        const int32_t wins = (is_later & is_lequal) | (~is_later & ~owner_lequal);
        r->mask[i] &= -(int32_t)(z < there) | (-(int32_t)(z == there) & wins);
    }
}

/* What failed against a tainted depth; with a test that is not monotone, what met one. */
static uint16_t met_taint(const row *r, const int32_t before[LANES],
                          const int32_t is_tainted[LANES], fm_compare compare)
{
    int32_t met[LANES];
    const int32_t monotone =
        -(int32_t)(compare == FM_COMPARE_LESS || compare == FM_COMPARE_LESS_EQUAL);
    for (int i = 0; i < LANES; i++)
        met[i] = before[i] & is_tainted[i] & ~(r->mask[i] & monotone);
    return bits_of(met);
}

static void test_depth(row *r, const tbr_buffers *buffers, tbr_span_result *result,
                       const tbr_span *span, int32_t y)
{
    int32_t before[LANES];
    const fm_compare compare = span->draw->depth_test;
    if (compare == FM_COMPARE_OFF)
        return;
    for (int i = 0; i < LANES; i++)
        before[i] = r->mask[i];
    if (span->exact_ties)
        test_exact(r, buffers->depth + y * LANES, buffers->owner + y * LANES, span);
    else
        test(r, buffers->depth + y * LANES, compare);
    if (span->tracks_taint && span->is_signed)
        result->failed_tainted |= met_taint(r, before, buffers->is_tainted + y * LANES, compare);
}

static void write_depth(const row *r, tbr_buffers *buffers, const tbr_span *span, int32_t y)
{
    uint32_t *depth = buffers->depth + y * LANES, *owner = buffers->owner + y * LANES;
    int32_t *is_tainted = buffers->is_tainted + y * LANES;
    const uint32_t own =
        span->order * 2 + (span->draw->depth_test == FM_COMPARE_LESS_EQUAL ? 1u : 0u);
    const int32_t taint = span->is_signed ? 0 : -1;
    for (int i = 0; i < LANES; i++)
        depth[i] = r->mask[i] ? 2 * (uint32_t)r->z[i] : depth[i];
    if (span->tracks_order)
        for (int i = 0; i < LANES; i++)
            owner[i] = r->mask[i] ? own : owner[i];
    if (span->tracks_taint)
        for (int i = 0; i < LANES; i++)
            is_tainted[i] = r->mask[i] ? taint : is_tainted[i];
}

/* The nearest integer to t / 255, t at most 65 535. */
static inline uint32_t div_255(uint32_t t)
{
    t += 128;
    return (t + (t >> 8)) >> 8;
}

static void blend_over(row *r, const uint32_t there[LANES])
{
    for (int i = 0; i < LANES; i++) {
        const uint32_t s = r->colour[i] | 0xFF000000u, a = r->colour[i] >> 24, b = 255 - a;
        const uint32_t d = there[i];
        r->colour[i] = div_255((s & 255) * a + (d & 255) * b) |
                       div_255((s >> 8 & 255) * a + (d >> 8 & 255) * b) << 8 |
                       div_255((s >> 16 & 255) * a + (d >> 16 & 255) * b) << 16 |
                       div_255((s >> 24) * a + (d >> 24) * b) << 24;
    }
}

static inline uint32_t sum_255(uint32_t a, uint32_t b)
{
    return a + b > 255 ? 255 : a + b;
}

static void blend_add(row *r, const uint32_t there[LANES])
{
    for (int i = 0; i < LANES; i++) {
        const uint32_t s = r->colour[i], a = s >> 24, d = there[i];
        r->colour[i] = sum_255(d & 255, div_255((s & 255) * a)) |
                       sum_255(d >> 8 & 255, div_255((s >> 8 & 255) * a)) << 8 |
                       sum_255(d >> 16 & 255, div_255((s >> 16 & 255) * a)) << 16 |
                       sum_255(d >> 24, a) << 24;
    }
}

static void find_opaque(row *r, const fm_draw_call *draw)
{
    const int32_t covers = -(int32_t)(draw->mask == ALL_CHANNELS &&
                                      (draw->mix == FM_MIX_OFF || draw->mix == FM_MIX_OVER));
    const int32_t always = -(int32_t)(draw->mix == FM_MIX_OFF);
    for (int i = 0; i < LANES; i++)
        r->opaque[i] = covers & (always | -(int32_t)(r->colour[i] >= 0xFF000000u));
}

static void write_colour(row *r, uint32_t *there, const fm_draw_call *draw)
{
    uint32_t mask = 0;
    for (int channel = 0; channel < 4; channel++)
        mask |= (draw->mask >> channel & 1u) != 0 ? 255u << 8 * channel : 0;
    if (draw->mix == FM_MIX_OVER)
        blend_over(r, there);
    else if (draw->mix == FM_MIX_ADD)
        blend_add(r, there);
    for (int i = 0; i < LANES; i++) {
        const uint32_t chosen = mask & (uint32_t)r->mask[i];
        there[i] = (r->colour[i] & chosen) | (there[i] & ~chosen);
    }
}

static void write_layer(const row *r, tbr_buffers *buffers, const tbr_span *span, int32_t y)
{
    uint32_t *layer = buffers->layer + y * LANES;
    int32_t *is_woz = buffers->is_woz + y * LANES;
    const int32_t woz = span->writes_depth ? -1 : 0;
    const uint32_t own = span->layer; /* which no store may change: the loop is one of vectors */
    for (int i = 0; i < LANES; i++)
        layer[i] = (r->mask[i] & r->opaque[i]) ? own : layer[i];
    if (span->tracks_owner)
        for (int i = 0; i < LANES; i++)
            is_woz[i] = (r->mask[i] & r->opaque[i]) ? woz : is_woz[i];
}

static void draw_row(tbr_buffers *buffers, tbr_span_result *result, const tbr_span *span, int32_t y)
{
    row r;
    cover(&r, span, y);
    if ((result->covered[y] = bits_of(r.mask)) == 0)
        return;
    interpolate_z(&r, span, y);
    if (!span->late_test)
        test_depth(&r, buffers, result, span, y);
    if ((result->shaded[y] = bits_of(r.mask)) == 0)
        return;
    shade(&r, span, y);
    if ((span->draw->flags & FM_DRAW_DISCARD) != 0)
        discard(&r);
    if ((span->draw->flags & FM_DRAW_SHADER_DEPTH) != 0)
        shade_depth(&r);
    if (span->late_test)
        test_depth(&r, buffers, result, span, y);
    if ((result->passed[y] = bits_of(r.mask)) == 0)
        return;
    if (span->writes_depth)
        write_depth(&r, buffers, span, y);
    find_opaque(&r, span->draw);
    write_colour(&r, buffers->colour + y * LANES, span->draw);
    if (span->tracks_layers)
        write_layer(&r, buffers, span, y);
}

/* Depths that will be met again: half a step behind, so that the test to come decides ties. */
static void depth_row(tbr_buffers *buffers, tbr_span_result *result, const tbr_span *span,
                      int32_t y)
{
    row r;
    uint32_t *depth = buffers->depth + y * LANES;
    cover(&r, span, y);
    if ((result->covered[y] = bits_of(r.mask)) == 0)
        return;
    interpolate_z(&r, span, y);
    if ((span->draw->flags & FM_DRAW_DISCARD) != 0) {
        shade(&r, span, y);
        discard(&r);
    }
    for (int i = 0; i < LANES; i++)
        r.mask[i] &= -(int32_t)(2 * r.z[i] + 1 < (int32_t)depth[i]);
    for (int i = 0; i < LANES; i++)
        depth[i] = r.mask[i] ? 2 * (uint32_t)r.z[i] + 1 : depth[i];
    result->passed[y] = bits_of(r.mask);
}

void SPAN_NAME(tbr_buffers *buffers, tbr_span_result *result, const tbr_span *span)
{
    *result = (tbr_span_result){ 0 };
    for (int32_t y = span->y0; y < span->y1; y++) {
        if (span->mode == SPAN_DRAW)
            draw_row(buffers, result, span, y);
        else
            depth_row(buffers, result, span, y);
    }
}
