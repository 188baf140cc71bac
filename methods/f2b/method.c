#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "f2b",
    .title = "F2B",
    .citation = "Everitt 2001, Interactive Order-Independent Transparency, NVIDIA",
    .version = "1",
    .traits = FM_TRAIT_BOUNDED | FM_TRAIT_LOSES_TIES | FM_TRAIT_LOSES_DEPTH_ONE,
    .feeds = FM_FEED_RASTER,
    .keeps = FM_KEEPS_ALL,
    .family = FM_FAMILY_PEELING,
    .marker = FM_MARKER_CIRCLE,
    .resources = {
        { .name = "colour", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_R32UI },
        { .name = "depth", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_D32F, .ping_pong = true,
          .clear_depth = 1.0f },
    },
    .totals = { { .name = "peeled", .pass = "store" } },
    .passes = {
        { .name = "store", .shader = "store.glsl", .reads = { "depth_previous" },
          .targets = { { .resource = "colour", .load = FM_LOAD_CLEAR } },
          .state = { .depth_stencil = "depth", .depth_stencil_load = FM_LOAD_CLEAR,
                     .depth_test = FM_COMPARE_LESS, .depth_write = true } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "colour", "depth" } },
    },
    .loops = { { .first = "store", .last = "resolve", .until_zero = "peeled" } },
};
