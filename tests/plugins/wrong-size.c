/* The right ABI number and another struct. */
#include "head.h"

const fm_method_desc fm_method = { .abi = FM_ABI, .size_bytes = 64 };
