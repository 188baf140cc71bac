#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "l-buffer",
    .title = "L-buffer",
    .citation = "Lipowski 2010, Multi-layered framebuffer condensation: the l-buffer concept; as "
                "measured by Vasilakis, Fudos 2012, doi:10.2312/conf/EG2012/short/101-104",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .keeps = FM_KEEPS_ALL,
    .family = FM_FAMILY_A_BUFFER,
    .marker = FM_MARKER_CROSS,
    .dashed = true,
    .options = {
        { .name = "sort", .values = { "shell", "registers", "blocks" },
          .help = "in resolve: in a private array, up to 32 in registers, or in blocks of 32" },
    },
    .resources = {
        { .name = "counters", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "addresses", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "bins", .extent = { .constant = 2 } },
        { .name = "fragments", .element = FM_ELEMENT_UVEC2, .sizing = FM_SIZE_AFTER_TOTAL,
          .extent = { .per_total = 1, .total = "fragments" }, .used = { .per_fragment = 1 } },
    },
    .totals = { { .name = "fragments", .resource = "bins", .sum = true, .pass = "reference" } },
    .passes = {
        { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "counters", "bins" } },
        { .name = "count", .shader = "exact/count.glsl", .writes = { "counters" } },
        { .name = "reference", .kind = FM_PASS_PIXELS, .shader = "s-buffer/reference.glsl",
          .reads = { "counters" }, .writes = { "addresses", "bins" } },
        { .name = "map", .kind = FM_PASS_PIXELS, .shader = "s-buffer/map.glsl",
          .writes = { "bins" } },
        { .name = "store", .shader = "s-buffer/store.glsl", .reads = { "bins" },
          .writes = { "addresses", "fragments" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "s-buffer/resolve.glsl",
          .emits = true,
          .resumes = FM_RESUMES_BY_N, .reads = { "counters", "addresses", "bins" },
          .writes = { "fragments" } },
    },
};
