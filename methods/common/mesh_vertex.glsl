// Vertex shader of meshes: one matrix an instance; colours were shaded on the host.
layout(location = 0) in vec3 position;
layout(location = 1) in uint colour;
layout(location = 0) flat out uint fm_out_colour;
layout(location = 2) flat out uint fm_out_instance;
invariant gl_Position; // all passes and methods see the same depths

void main()
{
    uint instance = uint(FM_INSTANCE_ID);
    mat4 clip_from_object = mat4(fm_clip_from_object[instance * 4u],
                                 fm_clip_from_object[instance * 4u + 1u],
                                 fm_clip_from_object[instance * 4u + 2u],
                                 fm_clip_from_object[instance * 4u + 3u]);
    gl_Position = clip_from_object * vec4(position, 1.0);
    fm_out_colour = colour;
    fm_out_instance = instance;
}
