// Equation 6, without the background: the weighted mean of all colours covers what is not revealed.
void resolve(uvec2 pixel)
{
    vec4 sums = fm_load_sums(pixel);
    float covered = 1.0 - fm_load_revealage(pixel).x;
    if (sums.a > 0.0)
        fm_blended(pixel, vec4(sums.rgb / sums.a, 1.0) * covered);
}
