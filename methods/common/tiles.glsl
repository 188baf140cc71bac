// Pixels in the order of tiles of 8 x 8 (narrower at the border: no number is left out): how many lie in
// the tiles before the pixel's own, how many in its own, and how many there before it.
uvec3 tile_place(uvec2 pixel)
{
    uvec2 corner = pixel & ~7u, within = pixel - corner;
    uvec2 size = min(uvec2(FM_WIDTH, FM_HEIGHT) - corner, uvec2(8u));
    uint before = corner.y * uint(FM_WIDTH) + corner.x * size.y;
    return uvec3(before, size.x * size.y, within.y * size.x + within.x);
}
