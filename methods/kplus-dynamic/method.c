#include "fragmark/method.h"

/* The twin is histogram.glsl. */
enum { HISTOGRAM_WORDS = 1024, K_MOST = 1023 };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kplus-dynamic",
    .title = "K+B-Dynamic",
    .citation = "Vasilakis, Papaioannou, Fudos 2015, k+-buffer: An Efficient, Memory-Friendly and "
                "Dynamic k-Buffer Framework, IEEE TVCG 21(6)",
    .version = "5",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .keeps = FM_KEEPS_K_NEAREST,
    .k_total = "k",
    .k_max = K_MOST,
    .family = FM_FAMILY_K_PLUS_BUFFER,
    .marker = FM_MARKER_CROSS,
    .options = {
        { .name = "memory_mib", .values = { "200", "1", "10", "1000" },
          .help = "the most that all of the method's buffers take, in MiB" },
        { .name = "discard", .values = { "0", "1", "10", "20", "50", "90" },
          .help = "per cent of all fragments that may be discarded" },
        { .name = "count", .values = { "tessellated", "flat" },
          .help = "the counting pass as all others, or without tessellation (flat layers)" },
        { .name = "count_in", .values = { "lock", "own" },
          .help = "of a pixel's fragments: in the word of its lock, or beside it, as published" },
        { .name = "kept_in", .values = { "rule", "array", "heap" },
          .help = "max-array, max-heap, or the papers' rule: the heap if the chosen k is above 16" },
        { .name = "layout", .values = { "auto", "pixel", "layer", "tile" },
          .help = "side by side: a pixel's, the i-th of all pixels, or of a tile; auto: "
                           "the fastest of them on the device" },
    },
    .resources = {
        { .name = "counters", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "histogram", .extent = { .constant = HISTOGRAM_WORDS } },
        { .name = "choice", .extent = { .constant = 2 } }, /* k; k N */
        { .name = "fragments", .element = FM_ELEMENT_UVEC2, .sizing = FM_SIZE_AFTER_TOTAL,
          .extent = { .per_total = 1, .total = "records" }, .used = { .per_kept = 1 } },
    },
    .totals = {
        { .name = "k", .resource = "choice", .index = 0, .pass = "choose" },
        { .name = "records", .resource = "choice", .index = 1, .pass = "choose" },
    },
    .passes = {
        { .name = "prepare", .kind = FM_PASS_CLEAR, .writes = { "counters", "histogram" } },
        { .name = "count", .shader = "exact/count.glsl", .writes = { "counters" },
          .flat_tessellation = true, .flat_option = "count" },
        { .name = "bin", .kind = FM_PASS_PIXELS, .shader = "bin.glsl", .reads = { "counters" },
          .writes = { "histogram" } },
        { .name = "choose", .kind = FM_PASS_TILES, .shader = "choose.glsl",
          .reads = { "histogram" }, .writes = { "choice" } },
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "clear.glsl", .reads = { "choice" },
          .writes = { "counters", "fragments" } },
        { .name = "store", .shader = "store.glsl", .exclusive = true, .lock_word = "counters",
          .lock_word_option = "count_in", .reads = { "choice" },
          .writes = { "counters", "fragments" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "choice", "counters", "fragments" } },
    },
};
