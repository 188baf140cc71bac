#define LAYERS_BEHIND(pixel) int(max(counts[fm_pixel_index(pixel)], uint(K)) - uint(K))
#include "dual/resolve.glsl"
