#include "naive_tbr.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

naive_gpu *naive_create(const naive_rules *rules, uint32_t width_px, uint32_t height_px)
{
    naive_gpu *gpu = calloc(1, sizeof *gpu);
    assert(gpu != NULL);
    gpu->rules = *rules;
    gpu->width = (int32_t)width_px;
    gpu->height = (int32_t)height_px;
    gpu->tiles_x = (gpu->width + 15) / 16;
    gpu->tiles_y = (gpu->height + 15) / 16;
    assert(gpu->tiles_x * gpu->tiles_y <= NAIVE_MAX_TILES);
    gpu->image = calloc((size_t)width_px * height_px, sizeof *gpu->image);
    assert(gpu->image != NULL);
    for (int i = 0; i < NAIVE_MAX_TILES; i++)
        gpu->tiles[i].fvp = FM_FVP_UNKNOWN;
    return gpu;
}

void naive_destroy(naive_gpu *gpu)
{
    free(gpu->image);
    free(gpu);
}

/* ---- geometry of one triangle ---- */

static int64_t area_of(const fm_corner c[3])
{
    return (int64_t)(c[1].x - c[0].x) * (c[2].y - c[0].y) -
           (int64_t)(c[2].x - c[0].x) * (c[1].y - c[0].y);
}

/* The corners, so turned that the area is positive. */
static int64_t turn(fm_corner c[3], const fm_triangle *triangle)
{
    memcpy(c, triangle->corners, sizeof triangle->corners);
    const int64_t area = area_of(c);
    if (area < 0) {
        c[1] = triangle->corners[2];
        c[2] = triangle->corners[1];
    }
    return area < 0 ? -area : area;
}

static bool is_inside(const fm_corner *a, const fm_corner *b, int32_t px, int32_t py)
{
    const int64_t cx = 16 * (int64_t)px + 8, cy = 16 * (int64_t)py + 8;
    const int64_t e = (b->x - a->x) * (cy - a->y) - (b->y - a->y) * (cx - a->x);
    return e > 0 || (e == 0 && (b->y < a->y || (b->y == a->y && b->x > a->x)));
}

static bool covers(const fm_triangle *triangle, int32_t px, int32_t py)
{
    fm_corner c[3];
    return turn(c, triangle) > 0 && is_inside(&c[0], &c[1], px, py) &&
           is_inside(&c[1], &c[2], px, py) && is_inside(&c[2], &c[0], px, py);
}

static int64_t floor_of(int64_t value, int64_t by)
{
    int64_t quotient = value / by;
    while (quotient * by > value)
        quotient--;
    return quotient;
}

static int64_t limited(int64_t value, int64_t most)
{
    return value > most ? most : value < -most ? -most : value;
}

/* The plane through a0, a0 + d1, a0 + d2 at the corners. */
static uint32_t interpolate(const fm_corner c[3], int64_t area, const int64_t a[3], int32_t px,
                            int32_t py)
{
    const int64_t limit = (int64_t)1 << 40;
    const int64_t nx = a[1] * (c[2].y - c[0].y) - a[2] * (c[1].y - c[0].y);
    const int64_t ny = a[2] * (c[1].x - c[0].x) - a[1] * (c[2].x - c[0].x);
    const int64_t gx = limited(16 * nx / area, limit), gy = limited(16 * ny / area, limit);
    const int64_t at_origin = a[0] + floor_of(gx * (8 - c[0].x) + gy * (8 - c[0].y), 16);
    return (uint32_t)(at_origin + gx * px + gy * py);
}

static uint32_t depth_at(const fm_triangle *triangle, int32_t px, int32_t py)
{
    fm_corner c[3];
    const int64_t area = turn(c, triangle);
    const int64_t a[3] = { (int64_t)c[0].z * 128, ((int64_t)c[1].z - c[0].z) * 128,
                           ((int64_t)c[2].z - c[0].z) * 128 };
    const int64_t z = floor_of((int32_t)interpolate(c, area, a, px, py), 128);
    int64_t low = c[0].z, high = c[0].z;
    for (int i = 1; i < 3; i++) {
        low = c[i].z < low ? c[i].z : low;
        high = c[i].z > high ? c[i].z : high;
    }
    return (uint32_t)(z < low ? low : z > high ? high : z);
}

static uint32_t hash_at(const fm_triangle *triangle, const fm_draw_call *draw, int32_t px,
                        int32_t py)
{
    fm_corner c[3];
    const int64_t area = turn(c, triangle);
    const int64_t us[3] = { c[0].u, (int32_t)(c[1].u - c[0].u), (int32_t)(c[2].u - c[0].u) };
    const int64_t vs[3] = { c[0].v, (int32_t)(c[1].v - c[0].v), (int32_t)(c[2].v - c[0].v) };
    const uint32_t u = interpolate(c, area, us, px, py), v = interpolate(c, area, vs, px, py);
    uint32_t h = (u >> 16) * 0x9E3779B1u + (v >> 16) * 0x85EBCA77u + draw_digest(draw);
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    return h ^ h >> 12;
}

/* ---- lists ---- */

static bool overlaps(const naive_gpu *gpu, const fm_triangle *triangle, int32_t tx, int32_t ty)
{
    fm_corner c[3];
    bool touches = false, sides[3] = { false, false, false };
    if (turn(c, triangle) == 0)
        return false;
    for (int32_t y = 16 * ty; y < 16 * ty + 16; y++)
        for (int32_t x = 16 * tx; x < 16 * tx + 16; x++) {
            const int32_t cx = 16 * x + 8, cy = 16 * y + 8;
            bool left = false, right = false, above = false, below = false;
            for (int i = 0; i < 3; i++) {
                left |= c[i].x <= cx;
                right |= c[i].x >= cx;
                above |= c[i].y <= cy;
                below |= c[i].y >= cy;
                sides[i] |= is_inside(&c[i], &c[(i + 1) % 3], x, y);
            }
            touches |= left && right && above && below && x < gpu->width && y < gpu->height;
        }
    return touches && sides[0] && sides[1] && sides[2];
}

static bool writes_depth(const fm_draw_call *draw)
{
    return draw->depth_test != FM_COMPARE_OFF && (draw->flags & FM_DRAW_DEPTH_WRITE) != 0;
}

static bool is_woz(const fm_draw_call *draw)
{
    return writes_depth(draw) && draw->mix == FM_MIX_OFF && draw->mask == 15 &&
           (draw->flags & (FM_DRAW_STENCIL | FM_DRAW_SHADER_DEPTH)) == 0 &&
           (draw->depth_test == FM_COMPARE_LESS || draw->depth_test == FM_COMPARE_LESS_EQUAL);
}

static uint32_t nearest_depth(const fm_triangle *triangle)
{
    uint32_t least = triangle->corners[0].z;
    for (int i = 1; i < 3; i++)
        least = triangle->corners[i].z < least ? triangle->corners[i].z : least;
    return least;
}

static fm_prediction predict(const naive_gpu *gpu, const naive_tile *tile, const naive_entry *entry,
                             const fm_draw_call *draw)
{
    if (!gpu->rules.predicts || entry->is_clear)
        return FM_VISIBLE;
    if (tile->fvp.is_layer)
        return entry->layer < tile->fvp.value ? FM_HIDDEN_BY_LAYER : FM_VISIBLE;
    return is_woz(draw) && 2 * nearest_depth(entry->triangle) > tile->fvp.value ? FM_HIDDEN_BY_DEPTH
                                                                                : FM_VISIBLE;
}

/* All that overlaps the tile, as submitted, with layers and predictions. */
static uint32_t submit(naive_entry *entries, const naive_gpu *gpu, const naive_tile *tile,
                       const fm_frame *frame, int32_t tx, int32_t ty)
{
    uint32_t count = 0, primitive = 0, layer = 0;
    int64_t last_draw = -1;
    bool last_is_woz = false;
    for (uint32_t d = 0; d < frame->draw_count; d++) {
        const fm_draw_call *draw = &frame->draws[d];
        assert(count < NAIVE_MAX_ENTRIES - 2);
        if ((draw->flags & FM_DRAW_DEPTH_CLEAR) != 0)
            entries[count++] = (naive_entry){
                .primitive = UINT32_MAX, .draw = d, .is_clear = true, .is_signed = true
            };
        for (uint32_t i = 0; (draw->flags & FM_DRAW_DEPTH_CLEAR) == 0 && i < draw->count; i++) {
            const fm_triangle *triangle = &frame->triangles[draw->first + i];
            primitive++;
            if (!overlaps(gpu, triangle, tx, ty))
                continue;
            if (last_draw != (int64_t)d && (!is_woz(draw) || !last_is_woz))
                layer++;
            last_draw = d;
            last_is_woz = is_woz(draw);
            naive_entry entry = { .primitive = primitive - 1,
                                  .draw = d,
                                  .layer = gpu->rules.predicts ? layer : 0,
                                  .triangle = triangle };
            entry.prediction = predict(gpu, tile, &entry, draw);
            entry.is_signed = !gpu->rules.leaves_out || entry.prediction == FM_VISIBLE;
            entries[count++] = entry;
        }
    }
    return count;
}

/* Between barriers, what is visible first: a stable partition of each run. */
static void partition(naive_tile *tile, const naive_entry *entries, uint32_t count,
                      const fm_frame *frame)
{
    tile->count = 0;
    for (uint32_t begin = 0; begin < count;) {
        uint32_t end = begin;
        while (end < count && !entries[end].is_clear && is_woz(&frame->draws[entries[end].draw]))
            end++;
        for (int hidden = 0; hidden < 2; hidden++)
            for (uint32_t i = begin; i < end; i++)
                if ((entries[i].prediction != FM_VISIBLE) == (hidden == 1))
                    tile->list[tile->count++] = entries[i];
        if (end < count)
            tile->list[tile->count++] = entries[end++];
        begin = end;
    }
}

/* ---- signatures, as what they sum up ---- */

static void sign(naive_tile *tile, const void *bytes, size_t count)
{
    assert(tile->signed_count + count <= NAIVE_MAX_SIGNED);
    memcpy(tile->signed_bytes + tile->signed_count, bytes, count);
    tile->signed_count += (uint32_t)count;
}

static void sign_all(naive_tile *tile, const naive_entry *entries, uint32_t count,
                     const fm_frame *frame)
{
    int64_t last_draw = -1;
    tile->signed_count = 0;
    sign(tile, &frame->clear_colour, 4);
    sign(tile, &frame->clear_depth, 4);
    for (uint32_t i = 0; i < count; i++) {
        fm_draw_call state = frame->draws[entries[i].draw];
        if (!entries[i].is_signed)
            continue;
        state.first = state.count = state.vertices = 0;
        if (last_draw != (int64_t)entries[i].draw)
            sign(tile, &state, sizeof state);
        last_draw = entries[i].draw;
        if (!entries[i].is_clear)
            sign(tile, entries[i].triangle, sizeof *entries[i].triangle);
    }
}

/* A depth writer was left out because of its layer, and then something signed tested depths. */
static bool is_unusable(const naive_entry *entries, uint32_t count, const fm_frame *frame)
{
    bool was_left_out = false;
    for (uint32_t i = 0; i < count; i++) {
        const fm_draw_call *draw = &frame->draws[entries[i].draw];
        if (entries[i].is_clear)
            continue;
        if (!entries[i].is_signed && entries[i].prediction == FM_HIDDEN_BY_LAYER &&
            writes_depth(draw))
            was_left_out = true;
        if (entries[i].is_signed && was_left_out && draw->depth_test != FM_COMPARE_OFF)
            return true;
    }
    return false;
}

/* ---- one pixel ---- */

typedef struct pixel {
    uint32_t colour, z, layer;
    uint32_t owner; /* submission, from 1; 0: the clear */
    bool owner_lequal, is_tainted, layer_is_woz;
} pixel;

static bool passes(const pixel *p, uint32_t z, const naive_entry *entry, const fm_draw_call *draw,
                   bool exact_ties)
{
    const bool lequal = draw->depth_test == FM_COMPARE_LESS_EQUAL;
    if (exact_ties && is_woz(draw) && z == p->z)
        return entry->primitive + 1 > p->owner ? lequal : !p->owner_lequal;
    switch (draw->depth_test) {
    case FM_COMPARE_OFF:
    case FM_COMPARE_ALWAYS:
        return true;
    case FM_COMPARE_LESS:
        return z < p->z;
    case FM_COMPARE_LESS_EQUAL:
        return z <= p->z;
    case FM_COMPARE_EQUAL:
        return z == p->z;
    case FM_COMPARE_GREATER:
        return z > p->z;
    case FM_COMPARE_GREATER_EQUAL:
        return z >= p->z;
    case FM_COMPARE_NOT_EQUAL:
        return z != p->z;
    case FM_COMPARE_NEVER:
    case FM_COMPARE_COUNT:
        break;
    }
    return false;
}

static uint32_t nearest_255th(uint32_t t)
{
    return (2 * t + 255) / 510;
}

static uint32_t blend(uint32_t there, uint32_t source, const fm_draw_call *draw)
{
    const uint32_t a = source >> 24;
    uint32_t out = 0;
    for (uint32_t shift = 0; shift < 32; shift += 8) {
        const uint32_t d = there >> shift & 255;
        uint32_t s = source >> shift & 255, result = s;
        if (draw->mix == FM_MIX_OVER) {
            s = shift == 24 ? 255 : s;
            result = nearest_255th(s * a + d * (255 - a));
        } else if (draw->mix == FM_MIX_ADD) {
            result = d + (shift == 24 ? a : nearest_255th(s * a));
            result = result > 255 ? 255 : result;
        }
        out |= ((draw->mask >> shift / 8 & 1) != 0 ? result : d) << shift;
    }
    return out;
}

/* What a tile's pixels tell about it together. */
typedef struct findings {
    bool passed[NAIVE_MAX_ENTRIES]; /* by place in the list */
    bool met_taint;
} findings;

static void apply(pixel *p, const naive_entry *entry, const fm_draw_call *draw, uint32_t z,
                  uint32_t hash)
{
    uint32_t source = (hash & 0xFFFFFF) | (uint32_t)draw->alpha << 24;
    if ((draw->flags & FM_DRAW_TEXTURED_ALPHA) != 0 && hash >> 31 != 0)
        source |= 0xFF000000u;
    const bool is_opaque = draw->mask == 15 && (draw->mix == FM_MIX_OFF ||
                                                (draw->mix == FM_MIX_OVER && source >> 24 == 255));
    p->colour = blend(p->colour, source, draw);
    if (writes_depth(draw)) {
        p->z = z;
        p->owner = entry->primitive + 1;
        p->owner_lequal = draw->depth_test == FM_COMPARE_LESS_EQUAL;
        p->is_tainted = !entry->is_signed;
    }
    if (is_opaque) {
        p->layer = entry->layer;
        p->layer_is_woz = writes_depth(draw);
    }
}

static void draw_fragment(pixel *p, findings *found, const naive_gpu *gpu, const naive_tile *tile,
                          uint32_t place, const fm_draw_call *draw, int32_t x, int32_t y)
{
    const naive_entry *entry = &tile->list[place];
    const bool is_monotone =
        draw->depth_test == FM_COMPARE_LESS || draw->depth_test == FM_COMPARE_LESS_EQUAL;
    const uint32_t hash = hash_at(entry->triangle, draw, x, y);
    uint32_t z = depth_at(entry->triangle, x, y);
    if ((draw->flags & FM_DRAW_DISCARD) != 0 && (hash >> 28 & 3) == 0)
        return;
    if ((draw->flags & FM_DRAW_SHADER_DEPTH) != 0)
        z = z + (hash & 0xFFFF) > 0xFFFFFF ? 0xFFFFFF : z + (hash & 0xFFFF);
    const bool does_pass = passes(p, z, entry, draw, gpu->rules.exact_ties);
    if (entry->is_signed && p->is_tainted && draw->depth_test != FM_COMPARE_OFF &&
        !(does_pass && is_monotone))
        found->met_taint = true;
    if (!does_pass)
        return;
    found->passed[place] = true;
    apply(p, entry, draw, z, hash);
}

static pixel draw_pixel(findings *found, const naive_gpu *gpu, const naive_tile *tile,
                        const fm_frame *frame, int32_t x, int32_t y)
{
    pixel p = { .colour = frame->clear_colour, .z = frame->clear_depth };
    for (uint32_t i = 0; i < tile->count; i++) {
        const fm_draw_call *draw = &frame->draws[tile->list[i].draw];
        if (tile->list[i].is_clear) {
            p.z = draw->clear_depth;
            p.owner = 0;
            p.owner_lequal = p.is_tainted = false;
        } else if (covers(tile->list[i].triangle, x, y)) {
            draw_fragment(&p, found, gpu, tile, i, draw, x, y);
        }
    }
    return p;
}

/* ---- a tile ---- */

typedef struct extremes {
    uint32_t layer_far, depth_far;
    bool far_is_woz;
} extremes;

static void take_pixel(extremes *far, const pixel *p)
{
    if (p->layer < far->layer_far) {
        far->layer_far = p->layer;
        far->far_is_woz = false;
    }
    if (p->layer == far->layer_far)
        far->far_is_woz = far->far_is_woz || p->layer_is_woz;
    if (p->z > far->depth_far)
        far->depth_far = p->z;
}

static void end_tile(naive_gpu *gpu, naive_tile *tile, const findings *found, const extremes *far,
                     const fm_frame *frame)
{
    int64_t zr = -1, highest_unsigned = -1;
    bool is_cleared = false;
    for (uint32_t i = 0; i < tile->count; i++) {
        is_cleared = is_cleared || tile->list[i].is_clear;
        if (!found->passed[i])
            continue;
        if (writes_depth(&frame->draws[tile->list[i].draw]))
            zr = tile->list[i].layer;
        if (!tile->list[i].is_signed && tile->list[i].layer > highest_unsigned)
            highest_unsigned = tile->list[i].layer;
    }
    if (gpu->rules.owner ? far->far_is_woz : zr == far->layer_far)
        tile->fvp = (fm_fvp){ false, 2 * far->depth_far };
    else
        tile->fvp = (fm_fvp){ true, far->layer_far };
    if (gpu->rules.is_safe && is_cleared && !tile->fvp.is_layer)
        tile->fvp = FM_FVP_UNKNOWN;
    tile->is_valid =
        !gpu->rules.is_safe || (!found->met_taint && highest_unsigned < (int64_t)far->layer_far);
}

static void render(naive_gpu *gpu, naive_tile *tile, const fm_frame *frame, int32_t tx, int32_t ty)
{
    findings found = { 0 };
    extremes far = { .layer_far = UINT32_MAX };
    for (int32_t y = 16 * ty; y < 16 * ty + 16 && y < gpu->height; y++)
        for (int32_t x = 16 * tx; x < 16 * tx + 16 && x < gpu->width; x++) {
            const pixel p = draw_pixel(&found, gpu, tile, frame, x, y);
            gpu->image[y * gpu->width + x] = p.colour;
            take_pixel(&far, &p);
        }
    if (gpu->rules.predicts)
        end_tile(gpu, tile, &found, &far, frame);
    else
        tile->is_valid = true;
}

static void run_tile(naive_gpu *gpu, const fm_frame *frame, int32_t tx, int32_t ty)
{
    naive_tile *tile = &gpu->tiles[ty * gpu->tiles_x + tx];
    naive_entry entries[NAIVE_MAX_ENTRIES];
    unsigned char before[NAIVE_MAX_SIGNED];
    const uint32_t before_count = tile->signed_count;
    const uint32_t count = submit(entries, gpu, tile, frame, tx, ty);
    if (gpu->rules.reorders) {
        partition(tile, entries, count, frame);
    } else {
        memcpy(tile->list, entries, sizeof entries);
        tile->count = count;
    }
    memcpy(before, tile->signed_bytes, before_count);
    sign_all(tile, entries, count, frame);
    const bool unusable = gpu->rules.is_safe && is_unusable(entries, count, frame);
    tile->is_skipped = gpu->rules.eliminates && gpu->frame_count > 0 && tile->is_valid &&
                       !unusable && before_count == tile->signed_count &&
                       memcmp(before, tile->signed_bytes, before_count) == 0;
    if (tile->is_skipped)
        return;
    render(gpu, tile, frame, tx, ty);
    tile->is_valid = tile->is_valid && !unusable;
}

void naive_frame(naive_gpu *gpu, const fm_frame *frame)
{
    for (int32_t y = 0; y < gpu->tiles_y; y++)
        for (int32_t x = 0; x < gpu->tiles_x; x++)
            run_tile(gpu, frame, x, y);
    gpu->frame_count++;
}
