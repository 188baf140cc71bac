#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "wboit",
    .title = "WBOIT",
    .citation = "McGuire, Bavoil 2013, Weighted Blended Order-Independent Transparency, JCGT 2(2)",
    .version = "1",
    .traits = FM_TRAIT_BOUNDED | FM_TRAIT_APPROXIMATE | FM_TRAIT_READS_COLOUR,
    .feeds = FM_FEED_RASTER,
    .keeps = FM_KEEPS_ALL,
    .family = FM_FAMILY_Z_BUFFER, /* fixed function, a fixed number of words */
    .marker = FM_MARKER_CROSS,
    .dashed = true,
    .resources = {
        { .name = "sums", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RGBA32F },
        { .name = "revealage", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_R32F,
          .clear_colour = { 1.0f } },
    },
    .passes = {
        { .name = "store", .shader = "store.glsl",
          .targets = {
              { .resource = "sums", .load = FM_LOAD_CLEAR, .blend = FM_BLEND_ADD },
              { .resource = "revealage", .load = FM_LOAD_CLEAR, .blend = FM_BLEND_PRODUCT },
          } },
        { .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl", .emits = true,
          .reads = { "sums", "revealage" } },
    },
};
