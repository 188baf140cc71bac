#include "precalc-fixed/address.glsl"
#include "ab-array/store.glsl"
