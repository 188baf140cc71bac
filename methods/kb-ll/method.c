#include "fragmark/method.h"

enum { NODE_WORDS = 3, SENTINEL_WORDS = 2 * NODE_WORDS, NODES_PER_PIXEL = 1 };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kb-ll",
    .title = "KB-LL",
    .citation = "Yu, Yang, Hensley, Harada, Yu 2012, rendering complex scattering effects on hair, I3D",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_LINKED_LIST,
    .marker = FM_MARKER_SQUARE,
    .resources = {
        { .name = "allocated", .extent = { .constant = 2 } }, /* words taken; words without room */
        { .name = "nodes", .extent = { .per_pixel = SENTINEL_WORDS + NODE_WORDS * NODES_PER_PIXEL },
          .sizing = FM_SIZE_GROW, .overflow = "overflow",
          .grown = { .per_pixel = SENTINEL_WORDS, .per_fragment = NODE_WORDS },
          .used = { .per_pixel = SENTINEL_WORDS, .per_fragment = NODE_WORDS } },
    },
    .totals = { { .name = "overflow", .resource = "allocated", .index = 1, .pass = "store" } },
    .passes = {
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "clear.glsl",
          .writes = { "allocated", "nodes" } },
        { .name = "store", .shader = "store.glsl", .writes = { "allocated", "nodes" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "nodes" } },
    },
};
