#include "fragmark/method.h"

/* The floor: every fragment is rasterised and read, none is stored. */
const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "null",
    .title = "null",
    .citation = "control: consumes every fragment, stores none",
    .version = "1",
    .traits = FM_TRAIT_CONTROL | FM_TRAIT_FLOOR | FM_TRAIT_BOUNDED,
    .keeps = FM_KEEPS_ALL,
    .family = FM_FAMILY_CONTROL,
    .marker = FM_MARKER_CROSS,
    .resources = { { .name = "sink", .extent = { .constant = 1 } } },
    .passes = { { .name = "store", .shader = "store.glsl", .writes = { "sink" } } },
};
