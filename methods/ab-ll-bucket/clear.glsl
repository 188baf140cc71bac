#include "ab-ll/node.glsl"
#include "ab-ll-bucket/bucket.glsl"

void clear(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    bounds[2u * i] = 0xFFFFFFFFu;
    bounds[2u * i + 1u] = 0u;
    FM_LOOP for (uint bucket = 0u; bucket < BUCKETS; ++bucket)
        heads[i * BUCKETS + bucket] = END_OF_LIST;
    if (pixel == uvec2(0u)) {
        allocated[0] = 0u;
        allocated[1] = 0u;
    }
}
