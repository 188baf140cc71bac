#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kb-sr",
    .title = "KB-SR",
    .citation = "Bavoil, Myers 2008, Deferred Rendering using a Stencil Routed K-Buffer, ShaderX6; "
                "Myers, Bavoil 2007, doi:10.1145/1278780.1278806",
    .version = "1",
    .traits = FM_TRAIT_BOUNDED | FM_TRAIT_SORTED_INPUT | FM_TRAIT_SORTS_IN_RESOLVE |
              FM_TRAIT_MULTISAMPLED,
    .feeds = FM_FEED_RASTER,
    .keeps = FM_KEEPS_K_NEAREST,
    .k_max = 16,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_SQUARE,
    .resources = {
        { .name = "routed", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RG32UI,
          .samples_per_k = 1, .clear_words = { 0x7F800000u } }, /* FM_EMPTY_BITS */
        { .name = "stencil", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_D32F_S8,
          .samples_per_k = 1, .clear_stencil = 2 },
    },
    .passes = {
        { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "routed", "stencil" } },
        { .name = "route", .kind = FM_PASS_PIXELS, .shader = "route.glsl",
          .state = { .depth_stencil = "stencil", .stencil_test = FM_COMPARE_ALWAYS,
                     .stencil_pass = FM_STENCIL_REPLACE,
                     .stencil_reference = 2, .stencil_reference_step = 1,
                     .sample_mask = 1, .sample_mask_step = 1 } },
        { .name = "store", .shader = "store.glsl",
          .targets = { { .resource = "routed" } },
          .state = { .depth_stencil = "stencil", .stencil_test = FM_COMPARE_EQUAL,
                     .stencil_reference = 2, .stencil_fail = FM_STENCIL_DECREMENT,
                     .stencil_depth_fail = FM_STENCIL_DECREMENT,
                     .stencil_pass = FM_STENCIL_DECREMENT } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "routed" } },
    },
    .loops = { { .first = "route", .last = "route", .count_per_k = 1 } },
};
