// Layer i: of the fragments behind layer i - 1 the hardware's depth test keeps the nearest. The pixel's
// previous depth is read only: the other depth image is the one that is tested.
void store(uvec2 pixel, float depth, uint colour)
{
    if (fm_iteration > 0u && depth <= fm_load_depth_previous(pixel).x)
        discard;
    fm_target_colour = colour;
}
