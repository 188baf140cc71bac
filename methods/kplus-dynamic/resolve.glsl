#include "kplus-dynamic/chosen.glsl"
#include "kplus-array/resolve.glsl"
