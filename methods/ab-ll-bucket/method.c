#include "fragmark/method.h"

enum { NODE_WORDS = 3, NODES_PER_PIXEL = 1, BUCKETS = 8 };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "ab-ll-bucket",
    .title = "LL-BUN",
    .citation = "Yang, Hensley, Gruen, Thibieroz 2010, doi:10.1111/j.1467-8659.2010.01725.x; uniform "
                "buckets of depth as in the code of Vasilakis, Fudos",
    .version = "2",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_SORTS_IN_RESOLVE,
    .keeps = FM_KEEPS_ALL,
    .family = FM_FAMILY_LINKED_LIST,
    .marker = FM_MARKER_PLUS,
    .options = {
        { .name = "node", .values = { "auto", "split", "whole" },
          .help = "three words, or 16 bytes at once" },
    },
    .resources = {
        { .name = "heads", .extent = { .per_pixel = BUCKETS }, .used = { .per_pixel = BUCKETS } },
        { .name = "bounds", .extent = { .per_pixel = 2 }, .used = { .per_pixel = 2 } },
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
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "clear.glsl",
          .writes = { "heads", "bounds", "allocated" } },
        { .name = "range", .shader = "range.glsl", .writes = { "bounds" } },
        { .name = "store", .shader = "store.glsl", .reads = { "bounds" },
          .writes = { "heads", "allocated", "nodes" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .resumes = FM_RESUMES_BY_N,
          .reads = { "bounds" }, .writes = { "heads", "nodes" } },
    },
};
