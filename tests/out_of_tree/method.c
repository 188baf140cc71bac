/* The nearest fragment of each pixel, kept under a lock: an example of a method outside the tree.
 * It does what a z-buffer does, without one. */
#include "fragmark/method.h"

const fm_method_desc fm_method = {
    .abi = FM_ABI,
    .size_bytes = sizeof(fm_method_desc),
    .id = "nearest-lock",
    .title = "Nearest (lock)",
    .citation = "fragmark's example of a method outside its tree",
    .version = "1",
    .traits = FM_TRAIT_EXACT | FM_TRAIT_BOUNDED,
    .keeps = FM_KEEPS_NEAREST,
    .family = FM_FAMILY_Z_BUFFER,
    .resources = {
        { .name = "nearest",
          .element = FM_ELEMENT_UVEC2,
          .extent = { .per_pixel = 1 },
          .used = { .per_kept = 1 } },
    },
    .passes = {
        { .name = "clear",
          .kind = FM_PASS_CLEAR,
          .writes = { "nearest" },
          .clear_word = 0x7F800000u }, /* +infinity: FM_EMPTY_BITS */
        { .name = "store",
          .kind = FM_PASS_SCENE,
          .shader = "store.glsl",
          .writes = { "nearest" },
          .exclusive = true },
        { .name = "resolve",
          .kind = FM_PASS_PIXELS,
          .shader = "resolve.glsl",
          .reads = { "nearest" },
          .emits = true },
    },
};
