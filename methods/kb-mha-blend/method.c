#include "fragmark/method.h"

#define SUMS_OF_FOUR(id)                                                                           \
    {                                                                                              \
        .name = id, .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RGBA32F                         \
    }
#define ADDED(id)                                                                                  \
    {                                                                                              \
        .resource = id, .load = FM_LOAD_CLEAR, .blend = FM_BLEND_ADD                               \
    }

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kb-mha-blend",
    .title = "KB-MHA, blended (reconstruction)",
    .citation = "after Zhang 2014, Memory-Hazard-Aware K-Buffer Algorithm for Order-Independent "
                "Transparency Rendering, doi:10.1109/TVCG.2013.72; a code of our own",
    .version = "1",
    .traits = FM_TRAIT_BOUNDED | FM_TRAIT_RACY | FM_TRAIT_SORTS_IN_RESOLVE | FM_TRAIT_EMITS_EITHER,
    .feeds = FM_FEED_RASTER,
    .keeps = FM_KEEPS_K_NEAREST,
    .k_max = 128,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_DIAMOND,
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
        SUMS_OF_FOUR("powers"),
        SUMS_OF_FOUR("values"),
        SUMS_OF_FOUR("products"),
        { .name = "evicted", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_R32F,
          .clear_colour = { 2.0f } }, /* behind all depths */
    },
    .passes = {
        { .name = "clear", .kind = FM_PASS_PIXELS, .shader = "kb/clear.glsl",
          .writes = { "fragments" } },
        { .name = "store", .shader = "store.glsl", .writes = { "fragments" },
          .targets = { ADDED("powers"), ADDED("values"), ADDED("products"),
                       { .resource = "evicted", .load = FM_LOAD_CLEAR, .blend = FM_BLEND_MIN } } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "fragments", "powers", "values", "products", "evicted" } },
    },
};
