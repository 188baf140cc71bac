#include "fragmark/method.h"

#include "sizes.glsl"

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
        { .name = "structure", .values = { "auto", "registers", "sorted-array", "shared-array", "merge" },
          .help = "of the window of fragments that are not yet final" },
        { .name = "window", .values = { "0", "8", "4", "16", "32", "64", "128", "256" },
          .help = "fragments that it holds; 0: 32 on wide subgroups, 8 on narrow, 16 alone, 64 where k "
                  "is above 256. At most 32 in a shared-array, 64 in merge" },
        { .name = "used-buckets", .values = { "32", "1", "4", "8", "16" },
          .help = "of depth in a tile" },
        { .name = "chunk", .values = { "auto", "wide", "narrow", "alone" },
          .help = "depths by pixel, by triangle, without ballots; auto: by the subgroup" },
        { .name = "blocks", .values = { "0", "1", "2" },
          .help = "of a tile, each with bins of its own; 0: 2 with 32 lanes and over 4 triangles a "
                  "pixel" },
        { .name = "notes", .values = { "auto", "always", "never" },
          .help = "whether count leaves a note of each triangle for fill; never where some are "
                  "clipped; auto: with 32 lanes" },
    },
    .resources = {
        { .name = "fill_groups", .extent = { .constant = FILL_GROUPS_WORDS } },
        { .name = "store_groups", .extent = { .constant = STORE_GROUPS_WORDS } },
        { .name = "tile_words", .extent = { .per_tile = 1 } }, /* tile-k/layout.glsl: of what */
        { .name = "triangle_words", .extent = { .per_triangle = 1 } },
        { .name = "bins",
          .extent = { .constant = HEAD_WORDS, .per_tile = TILE_BLOCKS_MAX * BIN_WORDS } },
        { .name = "pairs", .sizing = FM_SIZE_AFTER_TOTAL,
          .extent = { .per_total = 1, .total = "pairs" } },
    },
    .totals = { { .name = "pairs",
                  .resource = "bins",
                  .index = HEAD_PAIRS,
                  .pass = "reference",
                  .late = true } },
    .passes = {
        { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "bins" } },
        { .name = "clear-list", .kind = FM_PASS_CLEAR, .writes = { "store_groups" },
          .narrow_only = true },
        { .name = "count", .kind = FM_PASS_TRIANGLES, .shader = "count.glsl",
          .writes = { "bins", "triangle_words", "tile_words" } },
        { .name = "count-large", .kind = FM_PASS_INDIRECT, .indirect = "bins",
          .shader = "count_large.glsl", .reads = { "triangle_words", "tile_words" },
          .writes = { "bins" } },
        { .name = "reference", .kind = FM_PASS_TILES, .lanes = FM_GROUP_LANES, .lanes_narrow = 1,
          .shader = "reference.glsl",
          .writes = { "bins", "fill_groups", "store_groups", "tile_words" } },
        { .name = "fill", .kind = FM_PASS_INDIRECT, .indirect = "fill_groups",
          .shader = "fill.glsl", .reads = { "fill_groups", "triangle_words", "tile_words" },
          .writes = { "bins", "pairs" } },
        { .name = "background", .kind = FM_PASS_PIXELS, .shader = "background.glsl",
          .emits = true, .narrow_only = true },
        { .name = "store", .kind = FM_PASS_INDIRECT, .indirect = "store_groups",
          .shader = "store.glsl", .reads = { "store_groups", "tile_words", "bins", "pairs" },
          .emits = true },
    },
};
