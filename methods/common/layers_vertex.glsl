// Vertex shader of layer scenes: no vertex buffer; four corners a cell from the index alone.
// Drawn layer by layer (instance = arrival), or cell by cell (FM_CELL_MAJOR: instance = cell).
layout(location = 0) flat out uint fm_out_colour;
layout(location = 1) flat out uint fm_out_layer;
layout(location = 2) flat out uint fm_out_instance;
invariant gl_Position; // all passes and methods see the same depths

void main()
{
    uint quad = uint(FM_VERTEX_ID) / 4u, corner = uint(FM_VERTEX_ID) % 4u;
#if FM_CELL_MAJOR
    uint cell = uint(FM_INSTANCE_ID), arrival = quad;
#else
    uint cell = quad, arrival = uint(FM_INSTANCE_ID);
#endif
    uint column = cell % uint(FM_TESSELLATION), row = cell / uint(FM_TESSELLATION);
#if FM_ORDER_ROWS > 1
    uint layer = fm_order[cell * uint(FM_LAYERS) + arrival];
#else
    uint layer = fm_order[arrival];
#endif
    uvec2 corner_px = uvec2(
        fm_border(column + (corner & 1u), uint(FM_RECT_X0), uint(FM_RECT_X1 - FM_RECT_X0)),
        fm_border(row + (corner >> 1u), uint(FM_RECT_Y0), uint(FM_RECT_Y1 - FM_RECT_Y0)));
    vec2 ndc = vec2(corner_px) * 2.0 / vec2(FM_WIDTH, FM_HEIGHT) - 1.0;
    fm_layer plane = fm_layers[layer];
    gl_Position = vec4(ndc, plane.depth + plane.slope_x * ndc.x + plane.slope_y * ndc.y, 1.0);
    fm_out_colour = plane.colour;
    fm_out_layer = layer;
    fm_out_instance = uint(FM_INSTANCE_ID);
}
