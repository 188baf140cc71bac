#define SLOT_OF(i) (i)
#include "peer-array/resolve.glsl"
