#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kb-mdt32",
    .title = "KB-MDT",
    .citation = "Maule, Comba, Torchelsen, Bastos 2013, Hybrid Transparency, "
                "doi:10.1145/2448196.2448212",
    .version = "2",
    .traits = FM_TRAIT_BOUNDED | FM_TRAIT_LOSES_TIES,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_CROSS,
    .options = { { .name = "depth_bits", .values = { "exact", "published" },
                   .help = "the float's bits, or the k+-buffer paper's quantisation" },
                 { .name = "layout", .values = { "auto", "pixel", "layer", "tile", "image" },
                   .help = "side by side: a pixel's, the i-th of all pixels, or of a tile; image: a "
                           "layer each; auto: the fastest of them on the device" },
                 { .name = "start", .values = { "auto", "front", "half", "binary" },
                   .help = "slot that a chain begins at: the first, by a look at k/2, searched" } },
    .resources = {
        { .name = "keys", .extent = { .per_pixel_k = 1 }, .used = { .per_kept = 1 } },
        { .name = "keys", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_R32UI,
          .extent = { .per_pixel_k = 1 }, .used = { .per_kept = 1 },
          .when_option = "layout", .when_value = "image" },
        { .name = "colours", .extent = { .per_pixel_k = 1 }, .used = { .per_kept = 1 } },
        { .name = "colours", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_R32UI,
          .extent = { .per_pixel_k = 1 }, .used = { .per_kept = 1 },
          .when_option = "layout", .when_value = "image" },
    },
    .passes = {
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "clear.glsl",
          .writes = { "keys", "colours" } },
        { .name = "store", .shader = "store.glsl", .writes = { "keys" } },
        { .name = "colour", .shader = "colour.glsl", .reads = { "keys" },
          .writes = { "colours" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "keys", "colours" } },
    },
};
