#include "fragmark/method.h"

/* The control: all fragments, in lists of exactly their number, fully sorted. */
const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "exact",
    .title = "exact",
    .citation = "control: all fragments, full sort",
    .version = "1",
    .traits = FM_TRAIT_CONTROL | FM_TRAIT_EXACT | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .keeps = FM_KEEPS_ALL,
    .family = FM_FAMILY_CONTROL,
    .marker = FM_MARKER_CIRCLE,
    .resources = {
        { .name = "counters", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "offsets", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "allocated", .extent = { .constant = 1 } },
        { .name = "fragments", .element = FM_ELEMENT_UVEC2, .sizing = FM_SIZE_AFTER_TOTAL,
          .extent = { .per_total = 1, .total = "fragments" }, .used = { .per_fragment = 1 } },
    },
    .totals = { { .name = "fragments", .resource = "allocated", .pass = "reference" } },
    .passes = {
        { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "counters", "allocated" } },
        { .name = "count", .shader = "count.glsl", .writes = { "counters" } },
        { .name = "reference", .kind = FM_PASS_PIXELS, .shader = "reference.glsl",
          .writes = { "counters", "offsets", "allocated" } },
        { .name = "store", .shader = "store.glsl", .reads = { "offsets" },
          .writes = { "counters", "fragments" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .resumes = FM_RESUMES_BY_N,
          .reads = { "counters", "offsets" }, .writes = { "fragments" } },
    },
};
