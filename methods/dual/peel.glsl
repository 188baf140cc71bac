#include "dual/interval.glsl"

// Iteration 0 finds the interval of all depths. Then each one peels the ends of the last interval and
// finds the interval of what lies inside. Targets blend by MAX; what is not written stays neutral.
void peel(uvec2 pixel, float depth, uint colour)
{
    fm_target_interval = vec2(-depth, depth);
    fm_target_front = vec4(0.0);
    fm_target_back = vec4(0.0);
    if (fm_iteration == 0u)
        return;
    vec2 last = fm_load_interval_previous(pixel).xy;
    float nearest = -last.x, farthest = last.y;
    if (depth < nearest || depth > farthest)
        discard;
    if (depth == nearest)
        fm_target_front = unpackUnorm4x8(colour);
    else if (depth == farthest)
        fm_target_back = unpackUnorm4x8(colour);
    if (depth == nearest || depth == farthest)
        fm_target_interval = EMPTY_INTERVAL;
}
