#include "kplus-dynamic/chosen.glsl"
#include "kplus-dynamic/kept_in.glsl"
#define SLOT_OF(i) (in_heap() ? (i) : K - 1u - (i))
#include "kplus-array/resolve.glsl"
