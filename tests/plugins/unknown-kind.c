/* A pass of a kind that does not exist. */
#include "head.h"

const fm_method_desc fm_method = {
    HEAD("unknown-kind"),
    .resources = { NEAREST },
    .passes = { STORE, RESOLVE, { .name = "extra", .kind = FM_PASS_KIND_COUNT } },
};
