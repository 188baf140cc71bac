#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kb-ab-array",
    .title = "KB-AB-Array",
    .citation = "Vasilakis, Fudos 2014, k+-buffer, doi:10.1145/2556700.2556702; store: Liu 2010",
    .version = "2",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_SQUARE,
    .dashed = true,
    .options = {
        { .name = "layout", .values = { "auto", "pixel", "layer", "tile", "image" },
          .help = "side by side: a pixel's, the i-th of all pixels, or of a tile; image: a "
                           "layer each; auto: the fastest of them on the device" },
        { .name = "select", .values = { "registers", "heap", "farthest" },
          .help = "the k nearest so far: in order, as a heap, or as the paper's farthest one" },
    },
    .resources = {
        { .name = "counters", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "fragments", .element = FM_ELEMENT_UVEC2, .extent = { .per_pixel_n = 1 },
          .used = { .per_fragment = 1 } },
        { .name = "fragments", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RG32UI,
          .extent = { .per_pixel_n = 1 }, .used = { .per_fragment = 1 },
          .when_option = "layout", .when_value = "image" },
    },
    .passes = {
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "ab-array/clear.glsl",
          .writes = { "counters" } },
        { .name = "store", .shader = "ab-array/store.glsl", .writes = { "counters", "fragments" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .resumes = FM_RESUMES_BY_N_K,
          .reads = { "counters", "fragments" } },
    },
};
