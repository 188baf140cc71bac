/* The nearest fragment of each pixel, out of a list of all: an example of a method outside the tree
 * that builds on one that comes with fragmark. Two passes are those of ab-ll, named by its folder;
 * they expect the buffers heads, allocated and nodes as ab-ll/node.glsl says. */
#include "fragmark/method.h"

enum { NODE_WORDS = 3 };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "nearest-list",
    .title = "Nearest (list)",
    .citation = "fragmark's example of a method that shares another one's shaders",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .keeps = FM_KEEPS_NEAREST,
    .family = FM_FAMILY_LINKED_LIST,
    .resources = {
        { .name = "heads", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "allocated", .extent = { .constant = 2 } }, /* words taken; words without room */
        { .name = "nodes",
          .extent = { .per_pixel = NODE_WORDS },
          .sizing = FM_SIZE_GROW,
          .overflow = "overflow",
          .grown = { .per_fragment = NODE_WORDS },
          .used = { .per_fragment = NODE_WORDS } },
    },
    .totals = {
        { .name = "overflow", .resource = "allocated", .index = 1, .pass = "store" },
    },
    .passes = {
        { .name = "clear",
          .kind = FM_PASS_PIXELS,
          .shader = "ab-ll/clear.glsl",
          .writes = { "heads", "allocated" } },
        { .name = "store",
          .shader = "ab-ll/store.glsl",
          .writes = { "heads", "allocated", "nodes" } },
        { .name = "resolve",
          .kind = FM_PASS_PIXELS,
          .shader = "resolve.glsl",
          .reads = { "heads", "nodes" },
          .emits = true },
    },
};
