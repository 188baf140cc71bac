#include "fragmark/method.h"

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
        { .name = "range", .extent = { .constant = 2 } },
        { .name = "groups", .extent = { .constant = 4 } }, /* x y z of a dispatch; large ones */
        { .name = "allocated", .extent = { .constant = 1 } },
        { .name = "large", .extent = { .per_triangle = 1 } },
        { .name = "bins", .extent = { .per_tile = 33 } }, /* TILE_WORDS of tile-k/layout.glsl */
        { .name = "pairs", .sizing = FM_SIZE_AFTER_TOTAL,
          .extent = { .per_total = 1, .total = "pairs" } },
        { .name = "sink", .extent = { .constant = 1 } },
    },
    .totals = { { .name = "pairs", .resource = "allocated", .pass = "reference" } },
    .passes = {
        { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "bins", "groups", "allocated" } },
        { .name = "clear-range", .kind = FM_PASS_CLEAR, .writes = { "range" },
          .clear_word = 0xFFFFFFFFu },
        { .name = "range-of-depths", .kind = FM_PASS_TILES, .shader = "tile-k/range.glsl",
          .writes = { "range" } },
        { .name = "count", .kind = FM_PASS_TRIANGLES, .shader = "tile-k/count.glsl",
          .reads = { "range" }, .writes = { "bins", "groups", "large" } },
        { .name = "count-large", .kind = FM_PASS_INDIRECT, .indirect = "groups",
          .shader = "tile-k/count_large.glsl", .reads = { "range", "groups", "large" },
          .writes = { "bins" } },
        { .name = "reference", .kind = FM_PASS_TILES, .shader = "tile-k/reference.glsl",
          .reads = { "range" }, .writes = { "bins", "allocated" } },
        { .name = "fill", .kind = FM_PASS_TRIANGLES, .shader = "tile-k/fill.glsl",
          .reads = { "range" }, .writes = { "bins", "pairs" } },
        { .name = "fill-large", .kind = FM_PASS_INDIRECT, .indirect = "groups",
          .shader = "tile-k/fill_large.glsl", .reads = { "range", "groups", "large" },
          .writes = { "bins", "pairs" } },
        { .name = "store", .kind = FM_PASS_TILES, .lanes = FM_GROUP_LANES,
          .shader = "store.glsl", .reads = { "range", "bins", "pairs" }, .writes = { "sink" } },
    },
};
