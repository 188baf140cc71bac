#include "common/kept.glsl"
#include "kplus-heap/max_heap.glsl"
#include "common/keep_nearest.glsl"
