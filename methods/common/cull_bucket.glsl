#include "common/cull_map.glsl"

// Occupancy map, section 2: the depth range [near, far] of a pixel in S equal buckets, j = 0 .. S-1,
//   bucket j holds near + (far - near) j / S <= depth < near + (far - near) (j + 1) / S.
// What rounding may do: the quotients, products and sums below are each within 2.5 ulp (as Vulkan
// guarantees), together a part of 2^-20. The fill's bucket never falls with depth, so it is enough that a
// bucket's far edge, as the count gives it, lies behind all depths that the fill gives that bucket. The last
// sum needs no margin: where it is exactly at a depth or behind it, so is what it is rounded to.
const uint CULL_BUCKETS = 32u * FM_CULL_WORDS;
const float CULL_LEAST_WIDTH = 8.673617379884035e-19; // 2^-60: quotients stay finite

// Near and far; false: no range, and nothing is culled. The range pass keeps the greatest of -depth and of
// depth. Where only one face of the body is seen, the near plane cut the other away (or the eye is inside,
// or the body is flat): the range then begins at 0.
bool cull_range_of(uvec2 pixel, out float near, out float far)
{
    vec2 greatest = fm_load_fm_cull_range(pixel).xy;
    near = -greatest.x;
    far = greatest.y;
    if (!(far - near >= CULL_LEAST_WIDTH))
        near = 0.0;
    return far - near >= CULL_LEAST_WIDTH;
}

// Fragments outside the range go to the first or the last bucket.
uint cull_bucket(float depth, float near, float far)
{
    precise float scale = float(CULL_BUCKETS) / (far - near);
    precise float at = (depth - near) * scale;
    return uint(clamp(at, 0.0, float(CULL_BUCKETS - 1u)));
}

// No depth of the buckets 0..j is greater. The last one has no edge: what lies behind `far` is in it.
float cull_far_edge(uint j, float near, float far)
{
    const float margin = 3.814697265625e-06; // 2^-18 of the part: 4 times what rounding may do
    if (j + 1u >= CULL_BUCKETS)
        return 1.0;
    precise float part = float(j + 1u) / float(CULL_BUCKETS);
    precise float edge = near + (far - near) * (part + part * margin);
    return min(edge, 1.0);
}
