#include "kb-sr/samples.glsl"
#include "kb-multipass/advance.glsl"

// Samples fill in the order of arrival: the last one tells whether all are taken.
void peel(uvec2 pixel)
{
    uint farthest_bits = 0u;
    FM_LOOP for (uint i = 0u; i < SAMPLES; ++i)
        farthest_bits = max(farthest_bits, routed_sample(pixel, i).x); // empty: infinity
    advance(pixel, farthest_bits, SAMPLES);
}
