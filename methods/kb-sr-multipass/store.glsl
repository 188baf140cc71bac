#include "kb-multipass/boundary.glsl"

// As kb-sr, behind the boundary: what is discarded leaves the stencil as it is.
void store(uvec2 pixel, float depth, uint colour)
{
    if (!is_behind(pixel, depth))
        discard;
    fm_target_routed = fm_pack(depth, colour);
}
