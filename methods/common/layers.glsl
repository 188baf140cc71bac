// The layers generator on the device; generators/layers.c is its twin on the host.

// Cell borders lie on pixel borders, so that every cell covers whole pixels.
uint fm_border(uint i, uint origin, uint size)
{
    return origin + (i * size + uint(FM_TESSELLATION) / 2u) / uint(FM_TESSELLATION);
}

#ifdef FM_SURVIVAL
// An integer hash decides, the same on host and device.
bool fm_survives(uvec2 pixel, uint layer)
{
    uint h = pixel.x + pixel.y * 0x9E3779B1u + layer * 0x85EBCA77u + FM_SEED32 * 0xC2B2AE3Du;
    h ^= h >> 16;
    h *= 0x7FEB352Du;
    h ^= h >> 15;
    h *= 0x846CA68Bu;
    h ^= h >> 16;
    return h < FM_SURVIVAL;
}
#endif

// The row of the order table that a pixel's cell uses: random-cell has one a cell, others one.
uint fm_cell_along(uint x, uint origin, uint size)
{
    uint i = (x - origin) * uint(FM_TESSELLATION) / size;
    while (i > 0u && fm_border(i, origin, size) > x)
        --i;
    while (fm_border(i + 1u, origin, size) <= x)
        ++i;
    return i;
}
uint fm_order_row(uvec2 pixel)
{
#if FM_ORDER_ROWS > 1
    return fm_cell_along(pixel.y, uint(FM_RECT_Y0), uint(FM_RECT_Y1 - FM_RECT_Y0))
        * uint(FM_TESSELLATION)
        + fm_cell_along(pixel.x, uint(FM_RECT_X0), uint(FM_RECT_X1 - FM_RECT_X0));
#else
    return 0u;
#endif
}
