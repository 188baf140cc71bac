#include "common/array.glsl"
#include "kb-multipass/advance.glsl"

// The last of the list is the farthest, or empty.
void peel(uvec2 pixel)
{
    advance(pixel, fragments[array_slot(pixel, uint(SLOTS) - 1u, SLOTS)].x, SLOTS);
}
