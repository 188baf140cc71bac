// Between passes: the farthest depth that a pixel has handed over, as bits; infinity, behind which nothing
// lies, where the pixel had a place left and so is done.

// As published a fragment that ties with the boundary is not behind it: it is lost.
bool is_behind(uvec2 pixel, float depth)
{
    return fm_iteration == 0u || fm_pack(depth, 0u).x > boundary[fm_pixel_index(pixel)];
}
