#include "fragmark/method.h"

/* The twin is sums.glsl. */
enum { SUMS = 13 };

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kb-mha",
    .title = "KB-MHA (reconstruction)",
    .citation = "after Zhang 2014, Memory-Hazard-Aware K-Buffer Algorithm for Order-Independent "
                "Transparency Rendering, doi:10.1109/TVCG.2013.72; a code of our own",
    .version = "1",
    .traits = FM_TRAIT_BOUNDED | FM_TRAIT_RACY | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .keeps = FM_KEEPS_K_NEAREST,
    .k_max = 1023,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_DIAMOND,
    .dashed = true,
    .options = {
        { .name = "layout", .values = { "auto", "pixel", "layer", "tile", "image" },
          .help = "side by side: a pixel's, the i-th of all pixels, or of a tile; image: a "
                  "layer each; auto: the fastest of them on the device" },
        { .name = "forge", .values = { "0", "1", "2", "3", "4", "evict" },
          .help = "for tests: so many records of each pixel are damaged before it is repaired; "
                  "evict: one is gone, and was told as pushed out" },
        { .name = "unrepaired", .values = { "keep", "drop" },
          .help = "what cannot be repaired is handed over as it is or, for tests, not at all" },
    },
    .resources = {
        { .name = "fragments", .element = FM_ELEMENT_UVEC2, .extent = { .per_pixel_k = 1 },
          .used = { .per_kept = 1 } },
        { .name = "fragments", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RG32UI,
          .extent = { .per_pixel_k = 1 }, .used = { .per_kept = 1 },
          .when_option = "layout", .when_value = "image" },
        { .name = "sums", .extent = { .per_pixel = SUMS }, .used = { .per_pixel = SUMS } },
    },
    .passes = {
        { .name = "begin", .kind = FM_PASS_CLEAR, .writes = { "sums" } },
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "kb/clear.glsl",
          .writes = { "fragments" } },
        { .name = "store", .shader = "store.glsl", .writes = { "fragments", "sums" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "fragments", "sums" } },
    },
};
