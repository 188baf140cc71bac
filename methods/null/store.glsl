// Depths are never negative, but no compiler knows: pixel, depth and colour are all consumed.
void store(uvec2 pixel, float depth, uint colour)
{
    if (depth * float(pixel.x + pixel.y + 1u) < -1.0)
        sink[0] = colour;
}
