/* Built against headers that do not exist yet. */
#include "head.h"

const fm_method_desc fm_method = { .abi = FM_ABI + 1, .size_bytes = sizeof(fm_method_desc) };
