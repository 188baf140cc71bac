#include "kb-mha/code.glsl"
#include "kb/slots.glsl"
#include "kb-mha/sums.glsl"
#include "kb-mha/repair.glsl"
