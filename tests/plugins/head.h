/* The head that all test plugins share; they differ in what is wrong with them. */
#ifndef FM_TEST_PLUGIN_HEAD_H
#define FM_TEST_PLUGIN_HEAD_H

#include "fragmark/method.h"

#define HEAD(ID)                                                                                   \
    .abi = FM_ABI, .size_bytes = sizeof(fm_method_desc), .id = ID, .title = ID,                    \
    .citation = "a test of the runner", .version = "1", .traits = FM_TRAIT_CONTROL

#define NEAREST                                                                                    \
    {                                                                                              \
        .name = "nearest", .element = FM_ELEMENT_UVEC2, .extent = {.per_pixel = 1 }                \
    }

#define STORE                                                                                      \
    {                                                                                              \
        .name = "store", .kind = FM_PASS_SCENE, .shader = "store.glsl", .writes = { "nearest" },   \
        .exclusive = true                                                                          \
    }

#define RESOLVE                                                                                    \
    {                                                                                              \
        .name = "resolve", .kind = FM_PASS_PIXELS, .shader = "resolve.glsl",                       \
        .reads = { "nearest" }, .emits = true                                                      \
    }

#endif
