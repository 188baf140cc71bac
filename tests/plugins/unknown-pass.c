/* A loop begins at a pass that is misspelt. */
#include "head.h"

const fm_method_desc fm_method = {
    HEAD("unknown-pass"),
    .resources = { NEAREST },
    .passes = { STORE, RESOLVE },
    .loops = { { .first = "stor", .last = "resolve", .count = 2 } },
};
