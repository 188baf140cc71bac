#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "loop64",
    .title = "Loop64",
    .citation = "NVIDIA, vk_order_independent_transparency, algorithm Loop64",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_BOUNDED,
    .features = FM_FEATURE_INT64_ATOMICS,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_DIAMOND,
    .dashed = true,
    .options = { { .name = "layout", .values = { "layer", "pixel", "tile" },
                   .help = "side by side: the i-th of all pixels, a pixel's, or of a tile" } },
    .resources = {
        { .name = "keys", .element = FM_ELEMENT_UINT64, .extent = { .per_pixel_k = 1 },
          .used = { .per_kept = 1 } },
    },
    .passes = {
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "kb-mdt64/clear.glsl",
          .writes = { "keys" } },
        { .name = "store", .shader = "store.glsl", .writes = { "keys" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "kb-mdt64/resolve.glsl",
          .emits = true, .reads = { "keys" } },
    },
};
