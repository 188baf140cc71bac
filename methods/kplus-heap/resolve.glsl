#define SLOT_OF(i) (i)
#include "kplus-array/resolve.glsl"
