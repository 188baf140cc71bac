#include "kplus-dynamic/chosen.glsl"
#include "kplus-array/clear.glsl"
