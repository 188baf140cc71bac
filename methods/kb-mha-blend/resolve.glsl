#include "kb-mha/code.glsl"
#include "kb/slots.glsl"

uint sum_at(uvec2 pixel, uint word)
{
    vec4 four = word < 4u ? fm_load_powers(pixel) : word < 8u ? fm_load_values(pixel) : fm_load_products(pixel);
    return modulo(int(four[word & 3u]));
}
uint nearest_evicted(uvec2 pixel)
{
    float depth = fm_load_evicted(pixel).x;
    return depth > 1.0 ? ~0u : floatBitsToUint(depth);
}
#include "kb-mha/repair.glsl"
