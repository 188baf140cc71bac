// After a method that emits from both ends: the front over the back.
#include "common/accumulate.glsl"

void combine(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    vec4 front = fm_output[i], back = fm_output_back[i]; // front.a is 1 - A
    FM_PRECISE vec4 both = vec4(front.rgb + back.rgb * front.a, front.a * (1.0 - back.a));
    fm_output[i] = fm_rounded(both);
}
