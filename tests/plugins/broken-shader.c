/* A sound descriptor; its resolve does not compile. */
#include "head.h"

const fm_method_desc fm_method = {
    HEAD("broken-shader"),
    .resources = { NEAREST },
    .passes = { { .name = "clear",
                  .kind = FM_PASS_CLEAR,
                  .writes = { "nearest" },
                  .clear_word = 0x7F800000u },
                STORE,
                { .name = "resolve",
                  .kind = FM_PASS_PIXELS,
                  .shader = "broken.glsl",
                  .reads = { "nearest" },
                  .emits = true } },
};
