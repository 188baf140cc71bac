#include "common/cull_bucket.glsl"

// Each fragment sets its bucket's bit. Fragments of a pixel collide in atomicOr: all bits stay. A bit that
// is seen set stays set, so that one read too early only sets it again.
void store(uvec2 pixel, float depth, uint colour)
{
    float near, far;
    if (!cull_range_of(pixel, near, far))
        return;
    uint bucket = cull_bucket(depth, near, far);
    uint word = cull_word(pixel, bucket >> 5), bit = 1u << (bucket & 31u);
    if ((fm_cull_map[word] & bit) == 0u)
        atomicOr(fm_cull_map[word], bit);
}
