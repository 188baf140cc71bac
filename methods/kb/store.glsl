#include "kb/insert.glsl"

// As published nothing keeps two fragments of a pixel apart: both may read the same list, and then one
// of them is lost or doubled. The published code reads all k targets, then writes all k; here what
// does not change is not written back.
void store(uvec2 pixel, float depth, uint colour)
{
    insert(pixel, fm_pack(depth, colour));
}
