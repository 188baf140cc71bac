#include "s-buffer/bins.glsl"

// The place of a fragment whose local address in its counter's stretch is `local`.
uint bin_place(uvec2 pixel, uint local)
{
    uint bin = bin_of(pixel);
    uint at = bins[S + bin] + local;
    return is_inverse(bin) ? fm_length_fragments - 1u - at : at;
}
