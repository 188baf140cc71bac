// Least and greatest depth of a pixel, by MAX blending; the image is cleared to less than either.
void store(uvec2 pixel, float depth, uint colour)
{
    fm_target_fm_cull_range = vec2(-depth, depth);
}
