// Equation 10: weights fall with depth, so that near layers count more, whatever the order.
float weight(float depth, float alpha)
{
    return alpha * max(1e-2, 3e3 * pow(1.0 - depth, 3.0));
}

// Blending adds up C w and a w, and multiplies revealage by 1 - a.
void store(uvec2 pixel, float depth, uint colour)
{
    vec4 c = unpackUnorm4x8(colour);
    fm_target_sums = c * weight(depth, c.a);
    fm_target_revealage = c.a;
}
