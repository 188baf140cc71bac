#include "kplus-multipass/slots.glsl"

// Slot 0 is the farthest of a full array, and infinity in one that has a place left: that pixel is done.
void peel(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    uvec4 from = boundary[i];
    uvec2 farthest = kept_at(pixel, 0u);
    uint copies = farthest == from.xy ? from.z : 0u;
    FM_LOOP for (uint slot = 0u; slot < K; ++slot)
        copies += kept_at(pixel, slot) == farthest ? 1u : 0u;
    boundary[i] = uvec4(farthest, copies, 0u);
    if (farthest.x != FM_EMPTY_BITS && (fm_iteration + 1u) * K < K_WANTED)
        left[0] = 1u; // all write the same
}
