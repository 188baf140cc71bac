#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "z-buffer",
    .title = "Z-buffer",
    .citation = "Catmull 1974, A Subdivision Algorithm for Computer Display of Curved Surfaces",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_BOUNDED | FM_TRAIT_LOSES_DEPTH_ONE,
    .feeds = FM_FEED_RASTER,
    .keeps = FM_KEEPS_NEAREST,
    .family = FM_FAMILY_Z_BUFFER,
    .marker = FM_MARKER_DIAMOND,
    .resources = {
        { .name = "colour", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_R32UI },
        { .name = "depth", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_D32F,
          .clear_depth = 1.0f },
    },
    .passes = {
        { .name = "store", .shader = "store.glsl",
          .targets = { { .resource = "colour", .load = FM_LOAD_CLEAR } },
          .state = { .depth_stencil = "depth", .depth_stencil_load = FM_LOAD_CLEAR,
                     .depth_test = FM_COMPARE_LESS, .depth_write = true } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "colour", "depth" } },
    },
};
