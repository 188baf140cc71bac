#include "kplus-sb/slot.glsl"
#include "kplus-heap/resolve.glsl"
