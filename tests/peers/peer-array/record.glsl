// The i-th record of a pixel: the i-th layer of an image. One that has a single layer is not asked for it.
uvec2 record_at(uvec2 pixel, uint i)
{
#if K > 1
    return fm_load_fragments(pixel, i).xy;
#else
    return fm_load_fragments(pixel).xy;
#endif
}
