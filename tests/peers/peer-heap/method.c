#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "peer-heap",
    .title = "K+B-Heap on images",
    .citation = "port: Vasilakis, Fudos 2014, k+-buffer, doi:10.1145/2556700.2556702, max-heap",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_BOUNDED | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .feeds = FM_FEED_RASTER,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_K_PLUS_BUFFER,
    .marker = FM_MARKER_DIAMOND,
    .dashed = true,
    .resources = {
        { .name = "counters", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_R32UI },
        { .name = "locks", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_R32UI },
        { .name = "fragments", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RG32UI,
          .layers_per_k = 1 },
    },
    .passes = {
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "clear.glsl",
          .writes = { "counters", "locks" } },
        { .name = "store", .shader = "store.glsl",
          .writes = { "counters", "locks", "fragments" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "counters", "fragments" } },
    },
};
