#include "ab-ll/push.glsl"
#include "ab-ll-bucket/bucket.glsl"

void store(uvec2 pixel, float depth, uint colour)
{
    push(fm_pixel_index(pixel) * BUCKETS + bucket_of(pixel, depth), depth, colour);
}
