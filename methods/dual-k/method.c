#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "dual-k",
    .title = "Dual, k layers",
    .citation = "Bavoil, Myers 2008, Order Independent Transparency with Dual Depth Peeling, NVIDIA",
    .version = "1",
    .traits = FM_TRAIT_BOUNDED | FM_TRAIT_LOSES_TIES | FM_TRAIT_EMITS_BACK,
    .feeds = FM_FEED_RASTER,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_PEELING,
    .marker = FM_MARKER_PLUS,
    .resources = {
        { .name = "interval", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RG32F,
          .ping_pong = true, .clear_colour = { -1.0f, -1.0f } },
        { .name = "front", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RGBA8 },
        { .name = "back", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RGBA8 },
        { .name = "counts", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
    },
    .totals = { { .name = "peeled", .pass = "store" } },
    .passes = {
        { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "counts" } },
        { .name = "store", .shader = "store.glsl", .reads = { "interval_previous" },
          .writes = { "counts" },
          .targets = {
              { .resource = "interval", .load = FM_LOAD_CLEAR, .blend = FM_BLEND_MAX },
              { .resource = "front", .load = FM_LOAD_CLEAR, .blend = FM_BLEND_MAX },
              { .resource = "back", .load = FM_LOAD_CLEAR, .blend = FM_BLEND_MAX },
          } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "interval_previous", "front", "back", "counts" } },
    },
    .loops = { { .first = "store", .last = "resolve", .until_zero = "peeled", .count = 1,
                 .count_per_k = 1 } }, /* the first finds the ends of all */
};
