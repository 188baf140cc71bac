#include "kb/slots.glsl"
#include "kb-multipass/advance.glsl"

// The last of the list is the farthest, or empty.
void peel(uvec2 pixel)
{
    advance(pixel, kept_bits_at(pixel, uint(SLOTS) - 1u), SLOTS);
}
