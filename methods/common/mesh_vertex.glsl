// Vertex shader of meshes: one matrix an instance; colours were shaded on the host.
layout(location = 0) in vec3 position;
layout(location = 1) in uint colour;
layout(location = 0) flat out uint fm_out_colour;
layout(location = 2) flat out uint fm_out_instance;
invariant gl_Position; // all passes and methods see the same depths

void main()
{
    uint instance = uint(FM_INSTANCE_ID);
    // Written out: of a matrix product each API's compiler takes the sum in an order of its own, and
    // depths would be a few ulp apart.
    gl_Position = fm_clip_from_object[instance * 4u] * position.x
        + fm_clip_from_object[instance * 4u + 1u] * position.y
        + fm_clip_from_object[instance * 4u + 2u] * position.z
        + fm_clip_from_object[instance * 4u + 3u];
    fm_out_colour = colour;
    fm_out_instance = instance;
}
