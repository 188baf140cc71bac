#include "kplus-array/resolve.glsl"
