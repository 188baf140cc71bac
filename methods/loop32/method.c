#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "loop32",
    .title = "Loop32",
    .citation = "NVIDIA, vk_order_independent_transparency, algorithm Loop32",
    .version = "1",
    .traits = FM_TRAIT_BOUNDED | FM_TRAIT_LOSES_TIES,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_CROSS,
    .dashed = true,
    .options = { { .name = "layout", .values = { "layer", "pixel", "tile" },
                   .help = "side by side: the i-th of all pixels, a pixel's, or of a tile" } },
    .resources = {
        { .name = "keys", .extent = { .per_pixel_k = 1 }, .used = { .per_kept = 1 } },
        { .name = "colours", .extent = { .per_pixel_k = 1 }, .used = { .per_kept = 1 } },
    },
    .passes = {
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "kb-mdt32/clear.glsl",
          .writes = { "keys", "colours" } },
        { .name = "store", .shader = "store.glsl", .writes = { "keys" } },
        { .name = "colour", .shader = "colour.glsl", .reads = { "keys" },
          .writes = { "colours" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "kb-mdt32/resolve.glsl",
          .emits = true, .reads = { "keys", "colours" } },
    },
};
