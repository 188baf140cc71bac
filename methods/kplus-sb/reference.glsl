#define RECORDS(count) min(count, uint(K))
#include "s-buffer/reference.glsl"
