#include "kplus-array/clear.glsl"
