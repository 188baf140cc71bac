/* A pass names a file that is not there. */
#include "head.h"

const fm_method_desc fm_method = {
    HEAD("missing-shader"),
    .resources = { NEAREST },
    .passes = { STORE,
                { .name = "resolve",
                  .kind = FM_PASS_PIXELS,
                  .shader = "nowhere.glsl",
                  .reads = { "nearest" },
                  .emits = true } },
};
