#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kb-mdt64",
    .title = "KB-MDT-64",
    .citation = "Maule, Comba, Torchelsen, Bastos 2013, Hybrid Transparency, "
                "doi:10.1145/2448196.2448212",
    .version = "3",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_BOUNDED,
    .features = FM_FEATURE_INT64_ATOMICS,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_DIAMOND,
    .options = { { .name = "layout", .values = { "auto", "pixel", "layer", "tile" },
                   .help = "side by side: a pixel's, the i-th of all pixels, or of a tile; auto: "
                           "the fastest of them on the device" },
                 { .name = "start", .values = { "auto", "front", "half", "binary" },
                   .help = "slot that a chain begins at: the first, by a look at k/2, searched" } },
    .resources = {
        { .name = "keys", .element = FM_ELEMENT_UINT64, .extent = { .per_pixel_k = 1 },
          .used = { .per_kept = 1 } },
    },
    .passes = {
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "clear.glsl", .writes = { "keys" } },
        { .name = "store", .shader = "store.glsl", .writes = { "keys" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "keys" } },
    },
};
