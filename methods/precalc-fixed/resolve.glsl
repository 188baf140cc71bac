#include "precalc-fixed/address.glsl"
#include "ab-array/resolve.glsl"
