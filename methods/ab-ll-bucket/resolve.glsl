#include "ab-ll-bucket/bucket.glsl"
#define LISTS BUCKETS
#include "ab-ll/resolve_list.glsl"

// Bucket by bucket: what lies in one is nearer than all in the next.
void resolve(uvec2 pixel)
{
    uint rank = 0u;
    FM_LOOP for (uint bucket = 0u; bucket < BUCKETS; ++bucket)
        rank = resolve_list(pixel, fm_pixel_index(pixel) * BUCKETS + bucket, rank);
}
