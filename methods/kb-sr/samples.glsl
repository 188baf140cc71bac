// Samples of a pixel: k, unless the method has an option of this name.
#ifndef SAMPLES
#define SAMPLES K
#endif

uvec2 routed_sample(uvec2 pixel, uint i)
{
#if SAMPLES == 1
    return fm_load_routed(pixel).xy; // an image of one sample
#else
    return fm_load_routed(pixel, int(i)).xy;
#endif
}
