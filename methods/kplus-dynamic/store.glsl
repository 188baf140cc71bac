#include "kplus-dynamic/chosen.glsl"
#include "kplus-array/store.glsl"
