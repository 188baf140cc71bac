#include "layers.h"

#include <assert.h>

#include "hand_on.h"

/* What follows from the distribution of depths. */
static const struct {
    bool is_sloped;   /* a layer's depth varies over the viewport */
    bool may_tie;     /* two layers may share a depth at a pixel, or swap places */
    bool may_tie_far; /* the same, if the projection is reversed: 1 - depth is rounded */
    bool is_denormal; /* a rasteriser may make 0 of them */
} traits[] = {
    [FM_DEPTHS_UNIFORM] = { .is_sloped = false },
    [FM_DEPTHS_CLUSTERED] = { .is_sloped = false },
    [FM_DEPTHS_COPLANAR] = { .may_tie = true },
    [FM_DEPTHS_ULP] = { .is_sloped = false },
    [FM_DEPTHS_SLOPED] = { .is_sloped = true, .may_tie = true },
    [FM_DEPTHS_EQUAL] = { .may_tie = true },
    [FM_DEPTHS_STEP24] = { .is_sloped = false },
    [FM_DEPTHS_ENDS] = { .is_sloped = false },
    [FM_DEPTHS_STEP32] = { .may_tie_far = true },
    [FM_DEPTHS_DENORMAL] = { .may_tie = true, .is_denormal = true },
    [FM_DEPTHS_PROJECTED] = { .may_tie = true },
};
_Static_assert(sizeof traits / sizeof traits[0] == FM_DEPTHS_COUNT, "one row a distribution");

bool layers_are_flat(const fm_settings *settings)
{
    return settings->generator == FM_GENERATOR_LAYERS && !traits[settings->depths].is_sloped &&
           !traits[settings->depths].is_denormal;
}

bool layers_may_tie(const fm_settings *settings)
{
    return settings->generator != FM_GENERATOR_LAYERS || traits[settings->depths].may_tie ||
           (settings->depth == FM_DEPTH_REVERSED && traits[settings->depths].may_tie_far);
}

uint32_t layers_hash(uint32_t x, uint32_t y, uint32_t layer, uint64_t seed)
{
    const uint32_t seed32 = (uint32_t)(seed ^ seed >> 32);
    uint32_t h = x + y * 0x9E3779B1u + layer * 0x85EBCA77u + seed32 * 0xC2B2AE3Du;
    h ^= h >> 16;
    h *= 0x7FEB352Du;
    h ^= h >> 15;
    h *= 0x846CA68Bu;
    h ^= h >> 16;
    return h;
}

bool layers_lives(const fm_scene *scene, uint32_t x, uint32_t y, uint32_t layer)
{
    return !scene_is_layers(scene) || scene->survival_threshold == LAYERS_ALL_LIVE ||
           layers_hash(x, y, layer, scene->settings.seed) < scene->survival_threshold;
}

uint32_t layers_border(uint32_t begin, uint32_t end, uint32_t i, uint32_t t)
{
    return begin + (i * (end - begin) + t / 2) / t;
}

/* The one cell whose borders hold the pixel; empty cells are stepped over. */
static uint32_t cell_of(uint32_t begin, uint32_t end, uint32_t px, uint32_t t)
{
    uint32_t i = (uint32_t)((uint64_t)(px - begin) * t / (end - begin));
    while (i > 0 && layers_border(begin, end, i, t) > px)
        i--;
    while (layers_border(begin, end, i + 1, t) <= px)
        i++;
    return i;
}

static float depth_at(const fm_scene *scene, uint32_t index, double x_ndc, double y_ndc)
{
    const fm_layer *layer = &scene->layers[index];
    return hand_on(scene->settings.depth,
                   (float)((double)layer->depth + (double)layer->slope_x * x_ndc +
                           (double)layer->slope_y * y_ndc));
}

static bool is_covered(const fm_rect *rect, uint32_t x, uint32_t y)
{
    return x >= rect->x0 && x < rect->x1 && y >= rect->y0 && y < rect->y1;
}

uint32_t layers_fragments(fm_fragment *fragments, const fm_scene *scene, uint32_t x, uint32_t y)
{
    const fm_rect *rect = &scene->rect;
    const uint32_t t = scene->settings.tessellation;
    if (!is_covered(rect, x, y))
        return 0;
    const double x_ndc = 2.0 * (x + 0.5) / scene->width_px - 1.0;
    const double y_ndc = 2.0 * (y + 0.5) / scene->height_px - 1.0;
    const uint32_t row = scene->order_rows == 1 ? 0
                                                : cell_of(rect->y0, rect->y1, y, t) * t +
                                                      cell_of(rect->x0, rect->x1, x, t);
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < scene->n; slot++) {
        const uint32_t layer = scene->order[(size_t)row * scene->n + slot];
        if (layers_lives(scene, x, y, layer))
            fragments[count++] =
                (fm_fragment){ depth_at(scene, layer, x_ndc, y_ndc), scene->layers[layer].colour };
    }
    return count;
}

uint32_t layers_sorted(fm_fragment *fragments, const fm_scene *scene, uint32_t x, uint32_t y)
{
    uint32_t count = 0;
    assert(!layers_may_tie(&scene->settings));
    if (!is_covered(&scene->rect, x, y))
        return 0;
    for (uint32_t layer = 0; layer < scene->n; layer++)
        if (layers_lives(scene, x, y, layer))
            fragments[count++] =
                (fm_fragment){ hand_on(scene->settings.depth, scene->layers[layer].depth),
                               scene->layers[layer].colour };
    return count;
}
