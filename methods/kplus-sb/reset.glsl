#include "s-buffer/bins.glsl"
#include "kplus-sb/slot.glsl"
#include "common/nearest_word.glsl"

// From local to final addresses; counters start again; slot 0 of a deep pixel is at infinity.
void reset(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    uint count = counters[i];
    counters[i] = NONE_KEPT;
    if (count == 0u)
        return;
    uint address = bins[S + bin_of(pixel)] + addresses[i];
    addresses[i] = count > K ? address | IS_DEEP : address;
    if (count > K)
        fragments[address] = uvec2(FM_EMPTY_BITS, 0u);
}
