#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kplus-multipass",
    .title = "K+B, multi-pass",
    .citation = "Vasilakis, Fudos 2014, k+-buffer, doi:10.1145/2556700.2556702",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_BOUNDED | FM_TRAIT_SORTS_IN_RESOLVE,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_K_PLUS_BUFFER,
    .marker = FM_MARKER_PLUS,
    .options = {
        { .name = "slots", .values = { "8", "16", "4", "2", "1", "32", "64" },
          .help = "fragments of a pixel that one pass keeps" },
        { .name = "layout", .values = { "auto", "pixel", "layer", "tile", "image" },
          .help = "side by side: a pixel's, the i-th of all pixels, or of a tile; image: a "
                  "layer each; auto: the fastest of them on the device" },
    },
    .resources = {
        { .name = "counters", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "fragments", .element = FM_ELEMENT_UVEC2,
          .extent = { .per_pixel_option = 1, .option = "slots" }, .used = { .per_kept = 1 } },
        { .name = "fragments", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RG32UI,
          .extent = { .per_pixel_option = 1, .option = "slots" }, .used = { .per_kept = 1 },
          .when_option = "layout", .when_value = "image" },
        { .name = "boundary", .element = FM_ELEMENT_UVEC4, .extent = { .per_pixel = 1 },
          .used = { .per_pixel = 1 } },
        { .name = "left", .extent = { .constant = 1 } }, /* 1 when another pass is needed */
    },
    .totals = { { .name = "left", .resource = "left", .pass = "peel" } },
    .passes = {
        { .name = "settle", .kind = FM_PASS_CLEAR, .writes = { "left" } },
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "clear.glsl",
          .writes = { "counters", "fragments", "boundary" } },
        { .name = "store", .shader = "store.glsl", .exclusive = true,
          .writes = { "counters", "fragments", "boundary" } },
        { .name = "peel", .kind = FM_PASS_PIXELS, .shader = "peel.glsl", .reads = { "fragments" },
          .writes = { "boundary", "left" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "counters", "fragments" } },
    },
    .loops = { { .first = "settle", .last = "resolve", .until_zero = "left" } },
};
