#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "peer-spinlock",
    .title = "Spinlock, interlock",
    .citation = "port: NVIDIA, vk_order_independent_transparency, algorithms Spinlock, Interlock",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_BOUNDED | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .feeds = FM_FEED_RASTER,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_PLUS,
    .dashed = true,
    .resources = {
        { .name = "counters", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "farthest", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "fragments", .element = FM_ELEMENT_UVEC2, .extent = { .per_pixel_k = 1 },
          .used = { .per_kept = 1 } },
    },
    .passes = {
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "clear.glsl",
          .writes = { "counters", "farthest" } },
        { .name = "store", .shader = "store.glsl", .exclusive = true,
          .writes = { "counters", "farthest", "fragments" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "counters", "fragments" } },
    },
};
