#include "kplus-multipass/slots.glsl"
#include "kplus-array/max_array.glsl"

// Fragment culling by depth alone. Read without the lock: the boundary stays during a pass and slot 0 only
// comes nearer, so a stale value culls too little, never too much. Ties go on to store().
bool wanted(uvec2 pixel, float depth)
{
    uint bits = fm_pack(depth, 0u).x;
    return bits >= boundary[fm_pixel_index(pixel)].x && bits <= kept_bits_at(pixel, 0u);
}

// The k+-buffer behind the boundary. Of copies of the fragment there, as many are passed over as were handed
// over: which ones does not matter. The lock keeps their count right.
void store(uvec2 pixel, float depth, uint colour)
{
    uvec2 fragment = fm_pack(depth, colour);
    uint i = fm_pixel_index(pixel), count = K;
    uvec4 from = boundary[i];
    if (is_farther(from.xy, fragment))
        return;
    if (fragment == from.xy && from.w < from.z) {
        boundary[i].w = from.w + 1u;
        return;
    }
    uvec2 farthest = kept_at(pixel, 0u);
    if (!is_farther(farthest, fragment))
        return;
    if (farthest.x == FM_EMPTY_BITS) {
        count = counters[i];
        counters[i] = count + 1u;
    }
    uint farthest_bits = fragment.x; // peel.glsl asks slot 0
    keep_at(pixel, place(pixel, count, fragment, farthest_bits), fragment);
}
