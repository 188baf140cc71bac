#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "freepipe-compute",
    .title = "FreePipe",
    .citation = "Liu, Huang, Liu, Wu 2010, FreePipe, doi:10.1145/1730804.1730817",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .feeds = FM_FEED_TRIANGLES,
    .keeps = FM_KEEPS_ALL,
    .family = FM_FAMILY_RASTERISER,
    .marker = FM_MARKER_SQUARE,
    .resources = {
        { .name = "counters", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "fragments", .element = FM_ELEMENT_UVEC2, .extent = { .per_pixel_n = 1 },
          .used = { .per_fragment = 1 } },
        { .name = "unfinished", .extent = { .constant = 1 } },
    },
    .totals = { { .name = "unfinished", .resource = "unfinished", .pass = "store" } },
    .passes = {
        { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "counters" } },
        { .name = "begin", .kind = FM_PASS_CLEAR, .writes = { "unfinished" } },
        { .name = "store", .kind = FM_PASS_TRIANGLES, .shader = "store.glsl",
          .writes = { "counters", "fragments", "unfinished" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl",
          .reads = { "counters" }, .writes = { "fragments" }, .emits = true,
          .resumes = FM_RESUMES_BY_N },
    },
    .loops = { { .first = "begin", .last = "store", .until_zero = "unfinished" } },
};
