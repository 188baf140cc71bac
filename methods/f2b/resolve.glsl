// One layer, behind all that came before.
void resolve(uvec2 pixel)
{
    float depth = fm_load_depth(pixel).x;
    if (depth < 1.0) // the clear value: a fragment at 1.0 cannot be told from none
        fm_emit(pixel, int(fm_iteration), depth, fm_load_colour(pixel).x);
}
