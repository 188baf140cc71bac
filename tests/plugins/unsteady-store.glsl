// For scenes of one fragment a pixel: no lock, whose failures would have frames run again.
void store(uvec2 pixel, float depth, uint colour)
{
    nearest[pixel.y * FM_WIDTH + pixel.x] = uvec2(floatBitsToUint(depth), colour);
}
