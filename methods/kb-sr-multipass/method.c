#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "kb-sr-multipass",
    .title = "KB-SR, multi-pass (SRAB)",
    .citation = "Myers, Bavoil 2007, Stencil Routed A-Buffer, doi:10.1145/1278780.1278806; "
                "Bavoil, Myers 2008, Deferred Rendering using a Stencil Routed K-Buffer, ShaderX6",
    .version = "1",
    .traits = FM_TRAIT_BOUNDED | FM_TRAIT_SORTED_INPUT | FM_TRAIT_SORTS_IN_RESOLVE |
              FM_TRAIT_PASSES_LOSE_TIES | FM_TRAIT_MULTISAMPLED,
    .feeds = FM_FEED_RASTER,
    .keeps = FM_KEEPS_K_NEAREST,
    .family = FM_FAMILY_K_BUFFER,
    .marker = FM_MARKER_CROSS,
    .options = { { .name = "samples", .values = { "4", "8", "16", "2", "1" },
                   .help = "fragments of a pixel that one pass keeps: samples of the device" } },
    .resources = {
        { .name = "routed", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RG32UI,
          .samples_option = "samples", .clear_words = { 0x7F800000u } }, /* FM_EMPTY_BITS */
        { .name = "stencil", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_D32F_S8,
          .samples_option = "samples", .clear_stencil = 2 },
        { .name = "boundary", .extent = { .per_pixel = 1 }, .used = { .per_pixel = 1 } },
        { .name = "left", .extent = { .constant = 1 } }, /* 1 when another pass is needed */
    },
    .totals = { { .name = "left", .resource = "left", .pass = "peel" } },
    .passes = {
        { .name = "settle", .kind = FM_PASS_CLEAR, .writes = { "left" } },
        { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "routed", "stencil" } },
        { .name = "route", .kind = FM_PASS_PIXELS, .shader = "kb-sr/route.glsl",
          .state = { .depth_stencil = "stencil", .stencil_test = FM_COMPARE_ALWAYS,
                     .stencil_pass = FM_STENCIL_REPLACE,
                     .stencil_reference = 2, .stencil_reference_step = 1,
                     .sample_mask = 1, .sample_mask_step = 1 } },
        { .name = "store", .shader = "store.glsl", .reads = { "boundary" },
          .targets = { { .resource = "routed" } },
          .state = { .depth_stencil = "stencil", .stencil_test = FM_COMPARE_EQUAL,
                     .stencil_reference = 2, .stencil_fail = FM_STENCIL_DECREMENT,
                     .stencil_depth_fail = FM_STENCIL_DECREMENT,
                     .stencil_pass = FM_STENCIL_DECREMENT } },
        { .name = "peel", .kind = FM_PASS_PIXELS, .shader = "peel.glsl", .reads = { "routed" },
          .writes = { "boundary", "left" } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "kb-sr/resolve.glsl",
          .emits = true, .reads = { "routed" } },
    },
    .loops = { { .first = "settle", .last = "resolve", .until_zero = "left" },
               { .first = "route", .last = "route", .count_option = "samples" } },
};
