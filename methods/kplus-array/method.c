#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kplus-array",
    .title = "K+B-Array",
    .citation = "Vasilakis, Fudos 2014, k+-buffer, doi:10.1145/2556700.2556702",
    .version = "4",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_BOUNDED | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_K_PLUS_BUFFER,
    .marker = FM_MARKER_SQUARE,
    .options = { { .name = "layout", .values = { "auto", "pixel", "layer", "tile", "image" },
                   .help = "side by side: a pixel's, the i-th of all pixels, or of a tile; image: a "
                           "layer each; auto: the fastest of them on the device" },
                 { .name = "count_in", .values = { "lock", "own" },
                   .help = "of a pixel's fragments: in the word of its lock, or beside it, as published" } },
    .resources = {
        { .name = "counters", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "fragments", .element = FM_ELEMENT_UVEC2, .extent = { .per_pixel_k = 1 },
          .used = { .per_kept = 1 } },
        { .name = "counters", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_R32UI,
          .used = { .per_pixel = 1 }, .when_option = "layout", .when_value = "image" },
        { .name = "fragments", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RG32UI,
          .extent = { .per_pixel_k = 1 }, .used = { .per_kept = 1 },
          .when_option = "layout", .when_value = "image" },
    },
    .passes = {
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "clear.glsl",
          .writes = { "counters", "fragments" } },
        { .name = "store", .shader = "store.glsl", .exclusive = true, .lock_word = "counters",
          .lock_word_option = "count_in",
          .writes = { "counters", "fragments" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl",
          .emits = true,
          .resumes = FM_RESUMES_BY_K, .reads = { "counters", "fragments" } },
    },
};
