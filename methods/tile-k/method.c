#include "fragmark/method.h"

/* tile-k, fragmark's own: published nowhere but in README.md beside this file. */
const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "tile-k",
    .title = "tile-k",
    .citation = "fragmark, methods/tile-k/README.md",
    .version = "1",
    .traits = FM_TRAIT_EXACT,
    .features_optional = FM_FEATURE_SUBGROUP_BALLOT,
    .feeds = FM_FEED_TRIANGLES,
    .family = FM_FAMILY_RASTERISER,
    .marker = FM_MARKER_DIAMOND,
    .options = {
        { .name = "structure", .values = { "auto", "registers", "sorted-array" },
          .help = "of the window of fragments that are not yet final" },
        { .name = "window", .values = { "0", "8", "4", "16", "32", "64", "128", "256" },
          .help = "fragments that it holds; 0: 32 on wide subgroups, 8 on narrow, 16 alone" },
        { .name = "used-buckets", .values = { "32", "1", "4", "8", "16" },
          .help = "of depth in a tile" },
        { .name = "chunk", .values = { "auto", "wide", "narrow", "alone" },
          .help = "depths by pixel, by triangle, without ballots; auto: by the subgroup" },
    },
    .resources = {
        { .name = "groups", .extent = { .constant = 5 } }, /* words: tile-k/layout.glsl */
        { .name = "fill_groups", .extent = { .constant = 3 } }, /* x y z of a dispatch */
        { .name = "store_groups", .extent = { .constant = 4 } }, /* ... and a count */
        { .name = "listed", .extent = { .per_tile = 1 } },
        { .name = "notes", .extent = { .per_triangle = 1 } },
        { .name = "bins", .extent = { .per_tile = 66 } }, /* BLOCKS BIN_WORDS */
        { .name = "pairs", .sizing = FM_SIZE_AFTER_TOTAL,
          .extent = { .per_total = 1, .total = "pairs" } },
    },
    .totals = { { .name = "pairs", .resource = "groups", .index = 4, .pass = "reference" } },
    .passes = {
        { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "bins", "groups" } },
        { .name = "clear-list", .kind = FM_PASS_CLEAR, .writes = { "store_groups" },
          .narrow_only = true },
        { .name = "count", .kind = FM_PASS_TRIANGLES, .shader = "count.glsl",
          .writes = { "bins", "groups", "notes", "listed" } },
        { .name = "count-large", .kind = FM_PASS_INDIRECT, .indirect = "groups",
          .shader = "count_large.glsl", .reads = { "groups", "notes", "listed" },
          .writes = { "bins" } },
        { .name = "reference", .kind = FM_PASS_TILES, .lanes = FM_GROUP_LANES, .lanes_narrow = 1,
          .shader = "reference.glsl",
          .writes = { "bins", "groups", "fill_groups", "store_groups", "listed" } },
        { .name = "fill", .kind = FM_PASS_INDIRECT, .indirect = "fill_groups",
          .shader = "fill.glsl", .reads = { "groups", "fill_groups", "notes", "listed" },
          .writes = { "bins", "pairs" } },
        { .name = "background", .kind = FM_PASS_PIXELS, .shader = "background.glsl",
          .emits = true, .narrow_only = true },
        { .name = "store", .kind = FM_PASS_INDIRECT, .indirect = "store_groups",
          .shader = "store.glsl", .reads = { "store_groups", "listed", "bins", "pairs" },
          .emits = true },
    },
};
