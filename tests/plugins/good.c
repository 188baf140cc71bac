/* Nothing is wrong: the nearest fragment, under a lock. */
#include "head.h"

const fm_method_desc fm_method = {
    HEAD("good"),
    .resources = { NEAREST },
    .passes = { { .name = "clear",
                  .kind = FM_PASS_CLEAR,
                  .writes = { "nearest" },
                  .clear_word = 0x7F800000u },
                STORE,
                RESOLVE },
};
