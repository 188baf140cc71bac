// A pixel's depths, from its nearest to its farthest, in BUCKETS equal parts; a list for each.
// bounds[2 i], bounds[2 i + 1]: nearest and farthest, as bits.
const uint BUCKETS = 8u;

// One product with a factor that is the same for all of a pixel: rounding cannot change the order.
uint bucket_of(uvec2 pixel, float depth)
{
    uint i = 2u * fm_pixel_index(pixel);
    float near = uintBitsToFloat(bounds[i]), far = uintBitsToFloat(bounds[i + 1u]);
    precise float scale = float(BUCKETS) / max(far - near, 1e-30); // one depth: all in bucket 0
    precise float along = (depth - near) * scale;
    return min(uint(max(along, 0.0)), BUCKETS - 1u);
}
