#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "peer-list",
    .title = "Linked list",
    .citation = "port: NVIDIA, vk_order_independent_transparency, algorithm Linked List",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .feeds = FM_FEED_RASTER,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_LINKED_LIST,
    .marker = FM_MARKER_CIRCLE,
    .dashed = true,
    .resources = {
        { .name = "heads", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "allocated", .extent = { .constant = 2 } }, /* nodes taken; without room */
        { .name = "nodes", .element = FM_ELEMENT_UVEC4, .extent = { .per_pixel = 1 },
          .sizing = FM_SIZE_GROW, .overflow = "overflow", .grown = { .per_fragment = 1 },
          .used = { .per_fragment = 1 } },
    },
    .totals = { { .name = "overflow", .resource = "allocated", .index = 1, .pass = "store" } },
    .passes = {
        { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "heads", "allocated" } },
        { .name = "store", .shader = "store.glsl",
          .writes = { "heads", "allocated", "nodes" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "heads", "nodes" } },
    },
};
