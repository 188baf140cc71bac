#include "truth_triangles.h"

#include <string.h>

#include "scene/hand_on.h"
#include "scene/layers.h"
#include "scene/triangles.h"

/* What the rasteriser's call for a fragment needs. */
typedef struct truth_sink {
    const fm_scene *scene;
    fm_clip_triangle triangle;
    uint32_t primitive;
    uint32_t *counts;       /* counting */
    const truth_band *band; /* storing */
} truth_sink;

static void count_fragment(void *context, uint32_t x, uint32_t y, float depth)
{
    const truth_sink *sink = context;
    (void)depth;
    if (layers_lives(sink->scene, x, y, sink->triangle.layer))
        sink->counts[(uint64_t)y * sink->scene->width_px + x]++;
}

static void store_fragment(void *context, uint32_t x, uint32_t y, float depth)
{
    const truth_sink *sink = context;
    const truth_band *band = sink->band;
    const uint64_t pixel = (uint64_t)y * sink->scene->width_px + x;
    truth_record record = { .colour = sink->triangle.colour, .primitive = sink->primitive };
    if (pixel < band->first || pixel >= band->first + band->pixels ||
        !layers_lives(sink->scene, x, y, sink->triangle.layer))
        return;
    depth = hand_on(sink->scene->settings.depth, depth);
    memcpy(&record.depth_bits, &depth, sizeof depth);
    band->records[band->cursors[pixel]++] = record;
}

static void rasterise_scene(const fm_raster_target *target, truth_sink *sink)
{
    for (uint64_t i = 0; i < sink->scene->triangles; i++) {
        triangle_of(&sink->triangle, sink->scene, i);
        sink->primitive = (uint32_t)i;
        rasterise_triangle(target, sink->triangle.corners);
    }
}

void truth_count_triangles(uint32_t *counts, const fm_scene *scene)
{
    truth_sink sink = { .scene = scene, .counts = counts };
    const fm_raster_target target = { .width_px = scene->width_px,
                                      .height_px = scene->height_px,
                                      .last_row = scene->height_px,
                                      .fragment = count_fragment,
                                      .context = &sink };
    rasterise_scene(&target, &sink);
}

void truth_store_triangles(const truth_band *band, const fm_scene *scene)
{
    truth_sink sink = { .scene = scene, .band = band };
    const uint64_t last = band->first + band->pixels;
    const fm_raster_target target = {
        .width_px = scene->width_px,
        .height_px = scene->height_px,
        .first_row = (uint32_t)(band->first / scene->width_px),
        .last_row = (uint32_t)((last + scene->width_px - 1) / scene->width_px),
        .fragment = store_fragment,
        .context = &sink,
    };
    rasterise_scene(&target, &sink);
}
