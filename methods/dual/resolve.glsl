// Layers at a pixel's back that are not wanted: none, unless the method bounds what it hands over.
#ifndef LAYERS_BEHIND
#define LAYERS_BEHIND(pixel) 0
#endif

// The two layers that this iteration peeled: the i-th from the front and the i-th from the back; one,
// where they are the same.
void resolve(uvec2 pixel)
{
    vec2 last = fm_load_interval_previous(pixel).xy;
    float nearest = -last.x, farthest = last.y;
    if (fm_iteration == 0u || farthest < 0.0) // nothing peeled yet; nothing left
        return;
    fm_emit(pixel, int(fm_iteration) - 1, nearest, packUnorm4x8(fm_load_front(pixel)));
    int from_back = int(fm_iteration) - LAYERS_BEHIND(pixel);
    if (farthest > nearest && from_back > 0)
        fm_emit(pixel, -from_back, farthest, packUnorm4x8(fm_load_back(pixel)));
}
