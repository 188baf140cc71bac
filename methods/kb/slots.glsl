// Places of a pixel's list: k, unless the method has an option of this name.
#ifndef SLOTS
#define SLOTS K
#endif
#define KEPT_PLACES SLOTS
#include "common/kept.glsl"
