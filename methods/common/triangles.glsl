// Feed triangles: the scene's triangles in drawing order, before clipping, at the positions that the
// raster feed draws; the same numbers as its primitives. runner/scene/triangles.c is the twin on the host,
// bit for bit: hence `precise`, and sums written out.

#ifdef FM_LAYERS

// Cell, layer, and which half of the cell's quad (0 1 / 2 3).
uvec3 fm_layer_triangle(uint number)
{
    uint instance = number / uint(FM_INSTANCE_TRIANGLES);
    uint primitive = number % uint(FM_INSTANCE_TRIANGLES);
#if FM_CELL_MAJOR
    uint cell = instance, arrival = primitive / 2u;
#else
    uint cell = primitive / 2u, arrival = instance;
#endif
#if FM_ORDER_ROWS > 1
    return uvec3(cell, fm_order[cell * uint(FM_LAYERS) + arrival], primitive & 1u);
#else
    return uvec3(cell, fm_order[arrival], primitive & 1u);
#endif
}

vec4 fm_layer_corner(uint cell, fm_layer plane, uint corner)
{
    uint column = cell % uint(FM_TESSELLATION), row = cell / uint(FM_TESSELLATION);
    float x_px = float(fm_border(column + (corner & 1u), uint(FM_RECT_X0), uint(FM_RECT_X1 - FM_RECT_X0)));
    float y_px = float(fm_border(row + (corner >> 1u), uint(FM_RECT_Y0), uint(FM_RECT_Y1 - FM_RECT_Y0)));
    precise float x = x_px * FM_NDC_STEP_X - 1.0;
    precise float y = y_px * FM_NDC_STEP_Y - 1.0;
    precise float z = plane.depth + plane.slope_x * x + plane.slope_y * y;
    return vec4(x, y, z, 1.0);
}

void fm_triangle(uint number, out vec4 corners[3])
{
    uvec3 of = fm_layer_triangle(number);
    fm_layer plane = fm_layers[of.y];
    corners[0] = fm_layer_corner(of.x, plane, 2u * of.z);
    corners[1] = fm_layer_corner(of.x, plane, 1u);
    corners[2] = fm_layer_corner(of.x, plane, 2u + of.z);
}

// Flat: the first corner's.
uint fm_triangle_colour(uint number)
{
    return fm_layers[fm_layer_triangle(number).y].colour;
}

// A layer of fragment_probability < 1 has holes.
bool fm_triangle_lives(uint number, uvec2 pixel)
{
#ifdef FM_SURVIVAL
    return fm_survives(pixel, fm_layer_triangle(number).y);
#else
    return true;
#endif
}

#else

vec4 fm_mesh_corner(uint instance, uint vertex)
{
    vec3 p = uintBitsToFloat(fm_vertices[vertex].xyz);
    precise vec4 clip = fm_clip_from_object[instance * 4u] * p.x
        + fm_clip_from_object[instance * 4u + 1u] * p.y
        + fm_clip_from_object[instance * 4u + 2u] * p.z
        + fm_clip_from_object[instance * 4u + 3u];
    return clip;
}

void fm_triangle(uint number, out vec4 corners[3])
{
    uint instance = number / uint(FM_INSTANCE_TRIANGLES);
    uint first = number % uint(FM_INSTANCE_TRIANGLES) * 3u;
    corners[0] = fm_mesh_corner(instance, fm_indices[first]);
    corners[1] = fm_mesh_corner(instance, fm_indices[first + 1u]);
    corners[2] = fm_mesh_corner(instance, fm_indices[first + 2u]);
}

uint fm_triangle_colour(uint number)
{
    return fm_vertices[fm_indices[number % uint(FM_INSTANCE_TRIANGLES) * 3u]].w;
}

bool fm_triangle_lives(uint number, uvec2 pixel)
{
    return true;
}

#endif
