#include "kplus-sb/slot.glsl"
#define SLOT_OF(i) (i) // where there are fewer than K; else in any order
#include "kplus-array/resolve.glsl"
