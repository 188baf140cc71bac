#include "kb/insert.glsl"

// Every fragment has its share in the image.
bool wanted(uvec2 pixel, float depth)
{
    return true;
}

// The nearer of two layers over the farther, both premultiplied: C = C1 + C2 T1, T = T1 T2.
uint merge(uint nearer, uint farther)
{
    vec4 c = unpackUnorm4x8(nearer);
    return packUnorm4x8(c + unpackUnorm4x8(farther) * (1.0 - c.a));
}

// A sorted insertion into k layers; the one too many becomes part of the last, at the last's depth.
void store(uvec2 pixel, float depth, uint colour)
{
    uvec2 over = insert(pixel, fm_pack(depth, colour));
    if (over.x == FM_EMPTY_BITS)
        return;
    uvec2 last = kept_at(pixel, K - 1u);
    keep_at(pixel, K - 1u, uvec2(last.x, merge(last.y, over.y)));
}
