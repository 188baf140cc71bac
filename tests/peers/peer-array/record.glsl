// The i-th record of a pixel: the i-th layer of an image.
uvec2 record_at(uvec2 pixel, uint i)
{
    return fm_load_fragments(pixel, i).xy;
}
