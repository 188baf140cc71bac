/* A pass reads a resource that is misspelt. */
#include "head.h"

const fm_method_desc fm_method = {
    HEAD("unknown-resource"),
    .resources = { NEAREST },
    .passes = { STORE,
                { .name = "resolve",
                  .kind = FM_PASS_PIXELS,
                  .shader = "resolve.glsl",
                  .reads = { "neerest" },
                  .emits = true } },
};
