// Vertex shader of a scene's cover: of meshes in object space, of layers (FM_COVER_IN_NDC) in NDC.
layout(location = 0) in vec3 position;
layout(location = 1) in uint colour;
layout(location = 0) flat out uint fm_out_colour;

void main()
{
#if FM_COVER_IN_NDC
    gl_Position = vec4(position, 1.0);
#else
    // As mesh_vertex.glsl: the cover's corners are vertices of the mesh, and have their depths.
    uint instance = uint(FM_INSTANCE_ID);
    gl_Position = fm_clip_from_object[instance * 4u] * position.x
        + fm_clip_from_object[instance * 4u + 1u] * position.y
        + fm_clip_from_object[instance * 4u + 2u] * position.z
        + fm_clip_from_object[instance * 4u + 3u];
#endif
    fm_out_colour = colour;
}
