#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kb-multipass",
    .title = "KB, multi-pass",
    .citation = "Bavoil, Callahan, Lefohn, Comba, Silva 2007, doi:10.1145/1230100.1230117",
    .version = "2",
    .traits = FM_TRAIT_BOUNDED | FM_TRAIT_RACY | FM_TRAIT_PASSES_LOSE_TIES,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_CIRCLE,
    .dashed = true,
    .options = {
        { .name = "slots", .values = { "8", "16", "4", "2", "1", "32" },
          .help = "fragments of a pixel that one pass keeps: the render targets" },
        { .name = "layout", .values = { "auto", "pixel", "layer", "tile", "image" },
          .help = "side by side: a pixel's, the i-th of all pixels, or of a tile; image: a "
                           "layer each; auto: the fastest of them on the device" },
    },
    .resources = {
        { .name = "fragments", .element = FM_ELEMENT_UVEC2,
          .extent = { .per_pixel_option = 1, .option = "slots" }, .used = { .per_kept = 1 } },
        { .name = "fragments", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RG32UI,
          .extent = { .per_pixel_option = 1, .option = "slots" }, .used = { .per_kept = 1 },
          .when_option = "layout", .when_value = "image" },
        { .name = "boundary", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "left", .extent = { .constant = 1 } }, /* 1 when another pass is needed */
    },
    .totals = { { .name = "left", .resource = "left", .pass = "peel" } },
    .passes = {
        { .name = "settle", .kind = FM_PASS_CLEAR, .writes = { "left" } },
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "kb/clear.glsl",
          .writes = { "fragments" } },
        { .name = "store", .shader = "store.glsl", .reads = { "boundary" },
          .writes = { "fragments" } },
        { .name = "peel", .kind = FM_PASS_PIXELS, .shader = "peel.glsl", .reads = { "fragments" },
          .writes = { "boundary", "left" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "kb/resolve.glsl", .emits = true,
          .reads = { "fragments" } },
    },
    .loops = { { .first = "settle", .last = "resolve", .until_zero = "left" } },
};
