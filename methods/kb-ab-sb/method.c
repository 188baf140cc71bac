#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kb-ab-sb",
    .title = "KB-AB-SB",
    .citation = "Vasilakis, Fudos 2014, k+-buffer, doi:10.1145/2556700.2556702; store: "
                "Vasilakis, Fudos 2012",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_SORTS_IN_RESOLVE,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_PLUS,
    .dashed = true,
    .options = {
        { .name = "counters", .values = { "32", "1", "2", "10", "30", "50", "256", "1024" },
          .help = "S, how many counters all pixels share" },
        { .name = "hash", .values = { "paper", "tiled" },
          .help = "pixel to counter: by number, (x + W y) mod S, or by tiles of 256 x 96" },
        { .name = "mapping", .values = { "forward", "inverse" },
          .help = "all counters from the pool's front, or half of them from its end" },
    },
    .resources = {
        { .name = "counters", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "addresses", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "bins", .extent = { .per_option = 2, .option = "counters" } },
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
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "counters", "addresses", "bins", "fragments" } },
    },
};
