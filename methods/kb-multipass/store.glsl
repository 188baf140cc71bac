#include "kb/insert.glsl"
#include "kb-multipass/boundary.glsl"

// KB behind the boundary. As in kb nothing keeps two fragments of a pixel apart.
void store(uvec2 pixel, float depth, uint colour)
{
    if (is_behind(pixel, depth))
        insert(pixel, fm_pack(depth, colour));
}
