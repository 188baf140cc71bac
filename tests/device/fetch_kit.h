/* What is in images, as words: through texelFetch, since devices copy buffers only. */
#ifndef FM_TESTS_FETCH_KIT_H
#define FM_TESTS_FETCH_KIT_H

#include "device_kit.h"

/* GLSL that writes what `expression`, of a pixel p, finds in an image of this sampler type. */
#define FETCH_SOURCE(sampler, expression)                                                          \
    "#version 450\n"                                                                               \
    "layout(local_size_x = 256) in;\n"                                                             \
    "layout(binding = 0) uniform " sampler " image;\n"                                             \
    "layout(std430, binding = 1) writeonly buffer To { uint to[]; };\n"                            \
    "void main() {\n"                                                                              \
    "  ivec2 p = ivec2(gl_LocalInvocationID.x & 15u, gl_LocalInvocationID.x >> 4);\n"              \
    "  to[gl_LocalInvocationID.x] = " expression ";\n"                                             \
    "}\n"

#define FETCH_UINT FETCH_SOURCE("usampler2D", "texelFetch(image, p, 0).r")
#define FETCH_RED  FETCH_SOURCE("sampler2D", "floatBitsToUint(texelFetch(image, p, 0).r)")

/* Reads an image in the frame that wrote it, then ends that frame. */
static inline fm_frame_times end_and_fetch(uint32_t words[PIXELS], fm_device *device,
                                           fm_image_resource *image, const char *source)
{
    fm_buffer *to = make_words(device, PIXELS);
    fm_pipeline *fetch = make_pipeline(
        device,
        (fm_pipeline_desc){ .compute = source,
                            .bindings = { { 0, FM_BINDING_SAMPLED }, { 1, FM_BINDING_STORAGE } },
                            .binding_count = 2 });
    const fm_bind binds[] = { bind_sampled(0, image), bind_words(1, to, FM_ACCESS_WRITE) };
    dispatch(device, fetch, binds, 2, 1);
    const fm_frame_times times = end(device);
    read_words(device, to, words, PIXELS);
    device->ops->pipeline_destroy(device, fetch);
    device->ops->buffer_destroy(device, to);
    return times;
}

#endif
