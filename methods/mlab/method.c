#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "mlab",
    .title = "MLAB",
    .citation = "Salvi, Vaidyanathan 2014, Multi-Layer Alpha Blending, doi:10.1145/2556700.2556705",
    .version = "2",
    .traits = FM_TRAIT_BOUNDED | FM_TRAIT_APPROXIMATE | FM_TRAIT_SORTED_INPUT |
              FM_TRAIT_READS_COLOUR,
    .keeps = FM_KEEPS_ALL_IN_K,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_CROSS,
    .dashed = true,
    .options = { { .name = "layout", .values = { "auto", "pixel", "layer", "tile", "image" },
                   .help = "side by side: a pixel's, the i-th of all pixels, or of a tile; image: a "
                           "layer each; auto: the fastest of them on the device" } },
    .resources = {
        { .name = "fragments", .element = FM_ELEMENT_UVEC2, .extent = { .per_pixel_k = 1 },
          .used = { .per_kept = 1 } },
        { .name = "fragments", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RG32UI,
          .extent = { .per_pixel_k = 1 }, .used = { .per_kept = 1 },
          .when_option = "layout", .when_value = "image" },
    },
    .passes = {
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "kb/clear.glsl",
          .writes = { "fragments" } },
        { .name = "store", .shader = "store.glsl", .exclusive = true, .writes = { "fragments" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "kb/resolve.glsl", .emits = true,
          .reads = { "fragments" } },
    },
};
