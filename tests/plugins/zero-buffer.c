/* A buffer of no elements. */
#include "head.h"

const fm_method_desc fm_method = {
    HEAD("zero-buffer"),
    .resources = { { .name = "nearest", .element = FM_ELEMENT_UVEC2 } },
    .passes = { STORE, RESOLVE },
};
