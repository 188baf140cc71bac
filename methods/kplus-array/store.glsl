#include "common/kept.glsl"
#include "kplus-array/max_array.glsl"
#include "common/keep_nearest.glsl"
