/* The id is not the name of the file. */
#include "head.h"

const fm_method_desc fm_method = {
    HEAD("another-name"),
    .resources = { NEAREST },
    .passes = { STORE, RESOLVE },
};
