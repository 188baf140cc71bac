#include "fragmark/method.h"

/* A tile has as many pixels as a block of the scan: tiles are never fewer than blocks. */
const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "precalc-scan",
    .title = "PreCalc_OpenCL (scan)",
    .citation = "Peeper 2008, Prefix sum pass to linearize A-buffer storage; as measured by "
                "Vasilakis, Fudos 2012, S-buffer, doi:10.2312/conf/EG2012/short/101-104",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .keeps = FM_KEEPS_ALL,
    .family = FM_FAMILY_A_BUFFER,
    .marker = FM_MARKER_CIRCLE,
    .resources = {
        { .name = "counters", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "addresses", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "sums", .extent = { .constant = 3, .per_tile = 2 } },
        { .name = "fragments", .element = FM_ELEMENT_UVEC2, .sizing = FM_SIZE_AFTER_TOTAL,
          .extent = { .per_total = 1, .total = "fragments" }, .used = { .per_fragment = 1 } },
    },
    .totals = { { .name = "fragments", .resource = "sums", .pass = "top" } },
    .passes = {
        { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "counters" } },
        { .name = "count", .shader = "exact/count.glsl", .writes = { "counters" } },
        { .name = "sum", .kind = FM_PASS_TILES, .shader = "sum.glsl", .reads = { "counters" },
          .writes = { "sums" } },
        { .name = "top", .kind = FM_PASS_TILES, .shader = "top.glsl", .writes = { "sums" } },
        { .name = "spread", .kind = FM_PASS_TILES, .shader = "spread.glsl",
          .reads = { "counters" }, .writes = { "sums", "addresses" } },
        { .name = "store", .shader = "store.glsl", .writes = { "addresses", "fragments" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .resumes = FM_RESUMES_BY_N,
          .reads = { "counters", "addresses" }, .writes = { "fragments" } },
    },
    .loops = { { .first = "sum", .last = "sum", .count = 3 },
               { .first = "spread", .last = "spread", .count = 3 } },
};
