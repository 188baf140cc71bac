#include "fragmark/method.h"

enum { COUNTERS = 32 };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "peer-s-buffer",
    .title = "S-buffer on images",
    .citation = "port: Vasilakis, Fudos 2012, S-buffer, doi:10.2312/conf/EG2012/short/101-104",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .feeds = FM_FEED_RASTER,
    .keeps = FM_KEEPS_ALL,
    .family = FM_FAMILY_A_BUFFER,
    .marker = FM_MARKER_PLUS,
    .dashed = true,
    .resources = {
        { .name = "counters", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_R32UI },
        { .name = "addresses", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_R32UI },
        { .name = "bins", .extent = { .constant = 2 * COUNTERS } },
        { .name = "fragments", .element = FM_ELEMENT_UVEC2, .sizing = FM_SIZE_AFTER_TOTAL,
          .extent = { .per_total = 1, .total = "fragments" }, .used = { .per_fragment = 1 } },
    },
    .totals = { { .name = "fragments", .resource = "bins", .sum = true, .pass = "reference" } },
    .passes = {
        { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "counters", "bins" } },
        { .name = "count", .shader = "count.glsl", .writes = { "counters" } },
        { .name = "reference", .kind = FM_PASS_PIXELS, .shader = "reference.glsl",
          .reads = { "counters" }, .writes = { "addresses", "bins" } },
        { .name = "map", .kind = FM_PASS_PIXELS, .shader = "map.glsl", .writes = { "bins" } },
        { .name = "store", .shader = "store.glsl", .reads = { "bins" },
          .writes = { "addresses", "fragments" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "counters", "addresses", "bins" }, .writes = { "fragments" } },
    },
};
