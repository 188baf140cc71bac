#include "common/array.glsl"
#include "kplus-array/max_array.glsl"
#include "common/keep_nearest.glsl"
