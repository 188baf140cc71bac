// The compute feeds: the same fragments, replayed.
//   compute-layer     invocation = fragment; the first arrivals of all pixels, then the second, ...
//   compute-pixel     invocation = pixel, looping over its fragments in arrival order
//   compute-adjacent  invocation = fragment; a pixel's fragments in adjacent lanes contend
// FM_REPLAY: from the list of captured fragments; else from the recipe of flat layers.
#define FM_RECT_W uint(FM_RECT_X1 - FM_RECT_X0)
#define FM_RECT_H uint(FM_RECT_Y1 - FM_RECT_Y0)

#ifndef FM_REPLAY
void fm_feed_layer(uvec2 pixel, uint arrival)
{
    uint layer = fm_order[fm_order_row(pixel) * uint(FM_LAYERS) + arrival];
#ifdef FM_SURVIVAL
    if (!fm_survives(pixel, layer))
        return;
#endif
    fm_take(pixel, fm_hand_on(fm_layers[layer].depth), fm_layers[layer].colour);
}
uvec2 fm_rect_pixel(uint i)
{
    return uvec2(uint(FM_RECT_X0) + i % FM_RECT_W, uint(FM_RECT_Y0) + i / FM_RECT_W);
}
#endif

#if FM_FEED_PIXEL
// Where a run of the pass goes on among a pixel's fragments, and up to which `end`: all in one, unless
// the device would end the loop.
uint fm_feed_from(uint first, inout uint end)
{
#if FM_FEED_STEP
    first += fm_run * uint(FM_FEED_STEP);
    if (first < end && end - first > uint(FM_FEED_STEP)) {
        end = first + uint(FM_FEED_STEP);
        fm_go_on();
    }
#endif
    return first;
}
#endif

void main()
{
    uint id = gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x)
        + gl_GlobalInvocationID.x;
    if (id >= uint(FM_INVOCATIONS))
        return;
#if defined(FM_REPLAY) && FM_FEED_PIXEL
    uvec2 pixel = uvec2(id % uint(FM_WIDTH), id / uint(FM_WIDTH));
    uint end = fm_list_offsets[id + 1u];
    FM_LOOP for (uint i = fm_feed_from(fm_list_offsets[id], end); i < end; ++i)
        fm_take(pixel, uintBitsToFloat(fm_list[i].x), fm_list[i].y);
#elif defined(FM_REPLAY)
    uint at = fm_list_pixels[id];
    fm_take(uvec2(at % uint(FM_WIDTH), at / uint(FM_WIDTH)), uintBitsToFloat(fm_list[id].x),
            fm_list[id].y);
#elif FM_FEED_PIXEL
    uvec2 pixel = fm_rect_pixel(id);
    uint end = uint(FM_LAYERS);
    FM_LOOP for (uint arrival = fm_feed_from(0u, end); arrival < end; ++arrival)
        fm_feed_layer(pixel, arrival);
#elif FM_FEED_ADJACENT
    fm_feed_layer(fm_rect_pixel(id / uint(FM_LAYERS)), id % uint(FM_LAYERS));
#else
    uint pixels = FM_RECT_W * FM_RECT_H;
    fm_feed_layer(fm_rect_pixel(id % pixels), id / pixels);
#endif
    fm_tell_cut();
}
