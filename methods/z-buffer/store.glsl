// The hardware's depth test does the work: the nearest fragment's colour stays.
void store(uvec2 pixel, float depth, uint colour)
{
    fm_target_colour = colour;
}
