/* A pass uses the shader of a method that lies elsewhere. */
#include "head.h"

const fm_method_desc fm_method = {
    HEAD("borrower"),
    .resources = { NEAREST },
    .passes = { STORE,
                { .name = "resolve",
                  .kind = FM_PASS_PIXELS,
                  .shader = "lender/piece.glsl",
                  .reads = { "nearest" },
                  .emits = true } },
};
