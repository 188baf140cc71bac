/* The papers' synthetic scene: n layers over a centred rectangle, from a seed. */
#include <assert.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "procedural.h"
#include "scene/layers.h"

static const uint64_t max_order_bytes = UINT64_C(2) << 30;
static const double far_over_near = 1e7; /* of projected depths */
enum { CLUSTERS = 8 };

/* What random numbers are for: independent sequences of one seed. */
enum { FOR_ORDER = 1, FOR_ALPHA = 2, FOR_SLOPE = 3 };

static uint64_t sequence_start(uint64_t seed, uint64_t number)
{
    uint64_t state = seed ^ number * 0xD6E8FEB86659FD93u;
    return random_next(&state);
}

static uint32_t threshold_of(double probability)
{
    return probability >= 1.0 ? LAYERS_ALL_LIVE : (uint32_t)(probability * 4294967296.0);
}

static uint32_t clamp_px(double size, uint32_t limit)
{
    return size < 1.0 ? 1 : size > limit ? limit : (uint32_t)size;
}

static fm_rect centred_rect(const fm_settings *s)
{
    const double area = s->pixel_density * s->width_px * s->height_px;
    const uint32_t height = clamp_px(round(s->height_px * sqrt(s->pixel_density)), s->height_px);
    const uint32_t width = clamp_px(round(area / height), s->width_px);
    const uint32_t x0 = (s->width_px - width) / 2, y0 = (s->height_px - height) / 2;
    return (fm_rect){ x0, y0, x0 + width, y0 + height };
}

/* (i + 1) / 2^m, below 1 for all i < count: exact, as count < 2^24. */
static double uniform_depth(uint32_t i, uint32_t count)
{
    int exponent = 0;
    while (count >> exponent != 0)
        exponent++;
    return ldexp((double)i + 1.0, -exponent);
}

/* Steps of 2^-20 from the middle of each eighth. */
static double clustered_depth(uint32_t i, uint32_t count)
{
    const uint64_t cluster = (uint64_t)i * CLUSTERS / count;
    const uint64_t first = (cluster * count + CLUSTERS - 1) / CLUSTERS;
    return (double)(2 * cluster + 1) / (2 * CLUSTERS) + ldexp((double)(i - first), -20);
}

/* Neighbouring floats from 1/2 on. */
static double ulp_depth(uint32_t i)
{
    return 0.5 + ldexp((double)i, -24);
}

/* Exactly 0, then as uniform, then exactly 1; one layer is at 0. */
static double ends_depth(uint32_t i, uint32_t count)
{
    if (i == 0)
        return 0.0;
    return i + 1 == count ? 1.0 : uniform_depth(i, count);
}

/* far (v - near) / (v (far - near)) of the distance v = far^((i + 1) / (count + 1)), near being 1.
 */
static double projected_depth(uint32_t i, uint32_t count)
{
    const double distance = pow(far_over_near, ((double)i + 1.0) / ((double)count + 1.0));
    return far_over_near * (distance - 1.0) / (distance * (far_over_near - 1.0));
}

/* Uniform in [-1, 1]. */
static double random_signed(uint64_t *state)
{
    return ldexp((double)(random_next(state) >> 11), -52) - 1.0;
}

/* Within 0.04 of the middle in the centre, so that nearly all planes cross inside the rectangle;
 * 0.5 - 0.04 - 2 * 0.2195 > 0.02 keeps the corners of the square in range. */
static void sloped_plane(fm_layer *layer, uint64_t *state)
{
    layer->depth = (float)(0.5 + 0.04 * random_signed(state));
    layer->slope_x = (float)(0.2195 * random_signed(state));
    layer->slope_y = (float)(0.2195 * random_signed(state));
}

static int compare_depths(const void *left, const void *right)
{
    const float a = ((const fm_layer *)left)->depth, b = ((const fm_layer *)right)->depth;
    return (a > b) - (a < b);
}

/* Of flat layers, before the projection is reversed. */
static double flat_depth(fm_depths depths, uint32_t i, uint32_t n)
{
    switch (depths) {
    case FM_DEPTHS_UNIFORM:
        return uniform_depth(i, n);
    case FM_DEPTHS_CLUSTERED:
        return clustered_depth(i, n);
    case FM_DEPTHS_COPLANAR:
        return uniform_depth(i / 2, (n + 1) / 2);
    case FM_DEPTHS_ULP:
        return ulp_depth(i);
    case FM_DEPTHS_EQUAL:
        return 0.5;
    case FM_DEPTHS_STEP24:
        return ldexp((double)i + 1.0, -24);
    case FM_DEPTHS_ENDS:
        return ends_depth(i, n);
    case FM_DEPTHS_STEP32:
        return ldexp((double)i + 1.0, -32);
    case FM_DEPTHS_DENORMAL:
        return ldexp((double)i + 1.0, -149);
    case FM_DEPTHS_PROJECTED:
        return projected_depth(i, n);
    case FM_DEPTHS_SLOPED:
    case FM_DEPTHS_COUNT:
        break;
    }
    return 0.0;
}

static void fill_sloped(fm_scene *scene)
{
    uint64_t state = sequence_start(scene->settings.seed, FOR_SLOPE);
    for (uint32_t i = 0; i < scene->n; i++)
        sloped_plane(&scene->layers[i], &state);
    qsort(scene->layers, scene->n, sizeof *scene->layers, compare_depths);
}

/* A reversed projection has 1 - depth, rounded once: what is fine near 0 stays so at the far end.
 */
static void reverse_sloped(fm_scene *scene)
{
    for (uint32_t i = 0; i < scene->n; i++) {
        fm_layer *layer = &scene->layers[i];
        layer->depth = (float)(1.0 - (double)layer->depth);
        layer->slope_x = -layer->slope_x;
        layer->slope_y = -layer->slope_y;
    }
}

static void fill_depths(fm_scene *scene)
{
    const bool is_reversed = scene->settings.depth == FM_DEPTH_REVERSED;
    if (scene->settings.depths == FM_DEPTHS_SLOPED) {
        fill_sloped(scene);
        if (is_reversed)
            reverse_sloped(scene);
        return;
    }
    for (uint32_t i = 0; i < scene->n; i++) {
        const double depth = flat_depth(scene->settings.depths, i, scene->n);
        scene->layers[i].depth = (float)(is_reversed ? 1.0 - depth : depth);
    }
}

/* 0xBBGGRR, before alpha. */
static uint32_t base_colour(const fm_settings *settings, uint32_t layer)
{
    static const uint32_t cycle[8] = { 0x3030E0, 0x30C030, 0xE06030, 0x30D0E0,
                                       0xC040C0, 0xD0C030, 0x4090F0, 0xC8C8C8 };
    switch (settings->colours) {
    case FM_COLOURS_HASH:
        return layers_hash(1, 0, layer, settings->seed) & 0xFFFFFFu;
    case FM_COLOURS_CYCLE:
        return cycle[layer % 8];
    case FM_COLOURS_GREY:
        return 0x808080;
    case FM_COLOURS_COUNT:
        break;
    }
    return 0;
}

static uint32_t premultiplied(uint32_t bgr, uint32_t alpha)
{
    uint32_t colour = alpha << 24;
    for (uint32_t shift = 0; shift < 24; shift += 8)
        colour |= ((bgr >> shift & 0xFFu) * alpha + 127u) / 255u << shift;
    return colour;
}

static void fill_colours(fm_scene *scene)
{
    const fm_settings *settings = &scene->settings;
    uint64_t state = sequence_start(settings->seed, FOR_ALPHA);
    for (uint32_t i = 0; i < scene->n; i++) {
        uint32_t alpha = (uint32_t)lround(settings->alpha * 255.0);
        if (settings->alphas == FM_ALPHAS_RANDOM && alpha > 0)
            alpha = 1 + random_below(&state, alpha);
        scene->layers[i].colour = premultiplied(base_colour(settings, i), alpha);
    }
}

/* Fisher-Yates. */
static void shuffle(uint32_t *row, uint32_t count, uint64_t *state)
{
    for (uint32_t i = count; i > 1; i--) {
        const uint32_t j = random_below(state, i), kept = row[j];
        row[j] = row[i - 1];
        row[i - 1] = kept;
    }
}

static void fill_order(fm_scene *scene)
{
    const uint32_t n = scene->n;
    uint64_t state = sequence_start(scene->settings.seed, FOR_ORDER);
    const bool is_shuffled = scene->settings.order == FM_ORDER_RANDOM ||
                             scene->settings.order == FM_ORDER_RANDOM_CELL ||
                             scene->settings.order == FM_ORDER_CELL_MAJOR;
    for (uint32_t r = 0; r < scene->order_rows; r++) {
        uint32_t *row = scene->order + (size_t)r * n;
        for (uint32_t i = 0; i < n; i++)
            row[i] = scene->settings.order == FM_ORDER_DESCENDING ? n - 1 - i : i;
        if (is_shuffled)
            shuffle(row, n, &state);
    }
}

/* How many layers keep the depths that were asked for, exactly. */
static uint32_t max_layers(fm_depths depths)
{
    switch (depths) {
    case FM_DEPTHS_UNIFORM:
    case FM_DEPTHS_COPLANAR:
    case FM_DEPTHS_SLOPED:
    case FM_DEPTHS_EQUAL:
    case FM_DEPTHS_STEP24:
    case FM_DEPTHS_ENDS:
    case FM_DEPTHS_STEP32:
    case FM_DEPTHS_PROJECTED:
        return (1u << 24) - 1;
    case FM_DEPTHS_DENORMAL:
        return (1u << 23) - 1;
    case FM_DEPTHS_CLUSTERED:
        return CLUSTERS << 16;
    case FM_DEPTHS_ULP:
        return 1u << 23;
    case FM_DEPTHS_COUNT:
        break;
    }
    return 0;
}

static fm_status allocate(fm_scene *scene, fm_error *err)
{
    const uint32_t n = scene->n;
    if (n > max_layers(scene->settings.depths))
        return fm_fail(err, FM_INVALID, "n: %" PRIu32 " layers; these depths hold %" PRIu32, n,
                       max_layers(scene->settings.depths));
    const uint64_t bytes = (uint64_t)scene->order_rows * n * sizeof *scene->order;
    if (bytes > max_order_bytes)
        return fm_fail(err, FM_NO_MEMORY,
                       "order random-cell: %" PRIu32 " cells of %" PRIu32 " layers need %" PRIu64
                       " bytes; at most %" PRIu64,
                       scene->order_rows, n, bytes, max_order_bytes);
    if (n == 0)
        return FM_OK;
    scene->layers = calloc(n, sizeof *scene->layers);
    scene->order = calloc(scene->order_rows, (size_t)n * sizeof *scene->order);
    if (scene->layers == NULL || scene->order == NULL)
        return fm_fail(err, FM_NO_MEMORY, "layers: %" PRIu64 " bytes",
                       bytes + n * sizeof(fm_layer));
    return FM_OK;
}

fm_status layers_generate(fm_scene *scene, fm_error *err)
{
    const uint32_t t = scene->settings.tessellation;
    assert(t > 0 && scene->width_px > 0 && scene->height_px > 0);
    scene->n = scene->settings.n;
    scene->order_rows = scene->settings.order == FM_ORDER_RANDOM_CELL ? t * t : 1;
    scene->rect = centred_rect(&scene->settings);
    scene->survival_threshold = threshold_of(scene->settings.fragment_probability);
    const fm_status status = allocate(scene, err);
    if (status != FM_OK || scene->n == 0)
        return status;
    scene->triangles = (uint64_t)2 * t * t * scene->n;
    fill_depths(scene);
    fill_colours(scene);
    fill_order(scene);
    return FM_OK;
}
