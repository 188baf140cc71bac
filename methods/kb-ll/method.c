#include "fragmark/method.h"

enum { NODE_WORDS = 3, SENTINELS = 2, NODES_PER_PIXEL = 1 };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kb-ll",
    .title = "KB-LL",
    .citation = "Yu, Yang, Hensley, Harada, Yu 2012, rendering complex scattering effects on hair, I3D",
    .version = "2",
    .traits = FM_TRAIT_EXACT,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_LINKED_LIST,
    .marker = FM_MARKER_SQUARE,
    .options = {
        { .name = "node", .values = { "auto", "split", "whole" },
          .help = "three words, or 16 bytes at once" },
    },
    .resources = {
        { .name = "allocated", .extent = { .constant = 2 } }, /* elements taken; those without room */
        { .name = "nodes", .extent = { .per_pixel = NODE_WORDS * (SENTINELS + NODES_PER_PIXEL) },
          .sizing = FM_SIZE_GROW, .overflow = "overflow",
          .grown = { .per_pixel = NODE_WORDS * SENTINELS, .per_fragment = NODE_WORDS },
          .used = { .per_pixel = NODE_WORDS * SENTINELS, .per_fragment = NODE_WORDS } },
        { .name = "nodes", .element = FM_ELEMENT_UVEC4,
          .extent = { .per_pixel = SENTINELS + NODES_PER_PIXEL },
          .sizing = FM_SIZE_GROW, .overflow = "overflow",
          .grown = { .per_pixel = SENTINELS, .per_fragment = 1 },
          .used = { .per_pixel = SENTINELS, .per_fragment = 1 },
          .when_option = "node", .when_value = "whole" },
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
