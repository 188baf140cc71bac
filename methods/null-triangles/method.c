#include "fragmark/method.h"

#include "../tile-k/sizes.glsl"

/* The floor of methods that rasterise by themselves: the bins of tile-k, and nothing is kept. */
const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "null-triangles",
    .title = "null (triangles)",
    .citation = "control: rasterises every triangle, stores no fragment",
    .version = "1",
    .traits = FM_TRAIT_CONTROL | FM_TRAIT_FLOOR,
    .features_optional = FM_FEATURE_SUBGROUP_BALLOT,
    .feeds = FM_FEED_TRIANGLES,
    .keeps = FM_KEEPS_ALL,
    .family = FM_FAMILY_CONTROL,
    .marker = FM_MARKER_PLUS,
    .options = {
        { .name = "used-buckets", .values = { "32", "1", "4", "8", "16" },
          .help = "of depth in a tile" },
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
        { .name = "sink", .extent = { .constant = 1 } },
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
        { .name = "count", .kind = FM_PASS_TRIANGLES, .shader = "tile-k/count.glsl",
          .writes = { "bins", "triangle_words", "tile_words" } },
        { .name = "count-large", .kind = FM_PASS_INDIRECT, .indirect = "bins",
          .shader = "tile-k/count_large.glsl", .reads = { "triangle_words", "tile_words" },
          .writes = { "bins" } },
        { .name = "reference", .kind = FM_PASS_TILES, .lanes = FM_GROUP_LANES, .lanes_narrow = 1,
          .shader = "tile-k/reference.glsl",
          .writes = { "bins", "fill_groups", "store_groups", "tile_words" } },
        { .name = "fill", .kind = FM_PASS_INDIRECT, .indirect = "fill_groups",
          .shader = "tile-k/fill.glsl", .reads = { "fill_groups", "triangle_words", "tile_words" },
          .writes = { "bins", "pairs" } },
        { .name = "store", .kind = FM_PASS_INDIRECT, .indirect = "store_groups",
          .shader = "store.glsl", .reads = { "store_groups", "tile_words", "bins", "pairs" },
          .writes = { "sink" } },
    },
};
