#include "fragmark/method.h"

enum { NODE_WORDS = 3, NODES_PER_PIXEL = 1 };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kb-ab-ll",
    .title = "KB-AB-LL",
    .citation = "Yu, Yang, Hensley, Harada, Yu 2012, A framework for rendering complex "
                "scattering effects on hair, I3D; store: Yang 2010",
    .version = "3",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_SORTS_IN_RESOLVE,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_CIRCLE,
    .dashed = true,
    .options = {
        { .name = "node", .values = { "auto", "split", "whole" },
          .help = "three words, or 16 bytes at once" },
        { .name = "select", .values = { "registers", "heap", "farthest" },
          .help = "the k nearest so far: in order, as a heap, or as the paper's farthest one" },
    },
    .resources = {
        { .name = "heads", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "allocated", .extent = { .constant = 2 } }, /* elements taken; those without room */
        { .name = "nodes", .extent = { .per_pixel = NODE_WORDS * NODES_PER_PIXEL },
          .sizing = FM_SIZE_GROW, .overflow = "overflow",
          .grown = { .per_fragment = NODE_WORDS }, /* a node a fragment */
          .used = { .per_fragment = NODE_WORDS } },
        { .name = "nodes", .element = FM_ELEMENT_UVEC4, .extent = { .per_pixel = NODES_PER_PIXEL },
          .sizing = FM_SIZE_GROW, .overflow = "overflow", .grown = { .per_fragment = 1 },
          .used = { .per_fragment = 1 }, .when_option = "node", .when_value = "whole" },
    },
    .totals = { { .name = "overflow", .resource = "allocated", .index = 1, .pass = "store" } },
    .passes = {
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "ab-ll/clear.glsl",
          .writes = { "heads", "allocated" } },
        { .name = "store", .shader = "ab-ll/store.glsl",
          .writes = { "heads", "allocated", "nodes" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .resumes = FM_RESUMES_BY_N_K,
          .reads = { "heads", "nodes" } },
    },
};
