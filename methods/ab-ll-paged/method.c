#include "fragmark/method.h"

enum { PAGE_WORDS = 9 };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "ab-ll-paged",
    .title = "LL-Paged",
    .citation = "Crassin 2010, OpenGL 4.0+ A-buffer V2.0: Linked lists of fragment pages",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .keeps = FM_KEEPS_ALL,
    .family = FM_FAMILY_LINKED_LIST,
    .marker = FM_MARKER_SQUARE,
    .resources = {
        { .name = "heads", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "counters", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "allocated", .extent = { .constant = 2 } }, /* words taken; words without room */
        { .name = "pages", .extent = { .constant = PAGE_WORDS }, .sizing = FM_SIZE_GROW,
          .overflow = "overflow", .grown = { .per_total = 1, .total = "taken" },
          .used = { .per_fragment = 2 } },
    },
    .totals = {
        { .name = "overflow", .resource = "allocated", .index = 1, .pass = "store" },
        { .name = "taken", .resource = "allocated", .index = 0, .pass = "store" },
    },
    .passes = {
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "clear.glsl",
          .writes = { "heads", "counters", "allocated" } },
        { .name = "store", .shader = "store.glsl", .exclusive = true,
          .writes = { "heads", "counters", "allocated", "pages" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .resumes = FM_RESUMES_BY_N,
          .reads = { "heads", "counters" }, .writes = { "pages" } },
    },
};
