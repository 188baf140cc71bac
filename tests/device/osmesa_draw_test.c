/* What the OpenGL device draws: its state tables and Vulkan's coordinates. */
#include "osmesa_kit.h"

#include <string.h>

static const char store_fragcoord[] =
    "#version 450\n"
    "layout(binding = 7, std430) buffer Out { vec4 seen[]; };\n"
    "void main() {\n"
    "  seen[uint(gl_FragCoord.y) * 16u + uint(gl_FragCoord.x)] = gl_FragCoord;\n"
    "}\n";

/* The vertex shader covers y < 0 only: rows 0 to 7 in Vulkan's coordinates. */
static void osmesa_draws_without_targets_in_vulkan_coordinates(void **state)
{
    (void)state;
    const fm_device_desc plain = { .selector = NULL };
    fm_device *device = open_osmesa(&plain);
    fm_buffer *seen = make_buffer(device, PIXELS * 16);
    fm_pipeline *pipeline = make_pipeline(
        device, (fm_pipeline_desc){ .vertex = "#version 450\n"
                                              "void main() {\n"
                                              "  vec2 c = vec2(gl_VertexIndex & 1,\n"
                                              "                gl_VertexIndex >> 1);\n"
                                              "  gl_Position = vec4(c.x * 64.0 - 32.0,\n"
                                              "                     c.y * -64.0, 0.25, 1.0);\n"
                                              "}\n",
                                    .fragment = store_fragcoord });
    const fm_bind bind = { 7, FM_BINDING_STORAGE, seen, NULL, FM_ACCESS_WRITE };
    float pixels[PIXELS][4];

    begin(device);
    device->ops->fill(device, seen, 0);
    draw(device, &(fm_draw){ .pipeline = pipeline,
                             .binds = &bind,
                             .bind_count = 1,
                             .width_px = SIDE_PX,
                             .height_px = SIDE_PX,
                             .vertex_count = 3,
                             .instance_count = 1,
                             .query = -1 });
    end(device);
    device->ops->buffer_read(device, seen, 0, pixels, sizeof pixels, NULL);

    assert_true(pixels[0][0] == 0.5f && pixels[0][1] == 0.5f && pixels[0][2] == 0.25f);
    assert_true(pixels[7 * SIDE_PX][1] == 7.5f);
    assert_true(pixels[8 * SIDE_PX + 0][1] == 0.0f);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->buffer_destroy(device, seen);
    assert_int_equal(device->ledger.bytes[FM_OWNER_RUNNER], 0);
    device->ops->close(device);
}

static const char route_source[] = "#version 450\n"
                                   "layout(location = 0) flat in int instance;\n"
                                   "layout(location = 0) out vec4 target;\n"
                                   "void main() { target = vec4(float(instance) + 1.0); }\n";

static const char read_samples_source[] = "#version 450\n"
                                          "layout(local_size_x = 4) in;\n"
                                          "layout(binding = 0) uniform sampler2DMS slots;\n"
                                          "layout(binding = 1) buffer Out { float o[]; };\n"
                                          "void main() {\n"
                                          "  ivec2 p = ivec2(gl_WorkGroupID.xy);\n"
                                          "  int s = int(gl_LocalInvocationID.x);\n"
                                          "  o[(p.y * 16 + p.x) * 4 + s] =\n"
                                          "    texelFetch(slots, p, s).x;\n"
                                          "}\n";

/* Stencil routing (Bavoil and Myers 2008): sample i starts at 2 + i, each fragment passes where the
 * stencil is 2 and decrements all, so the i-th arriving fragment lands in sample i. */
static void osmesa_routes_fragments_to_samples_by_stencil(void **state)
{
    (void)state;
    enum { SAMPLES = 4 };
    const fm_device_desc plain = { .selector = NULL };
    fm_device *device = open_osmesa(&plain);
    fm_image_resource *slots = make_image(device, FM_FORMAT_RG32F, SAMPLES);
    fm_image_resource *depth = make_image(device, FM_FORMAT_D32F_S8, SAMPLES);
    fm_buffer *out = make_buffer(device, PIXELS * SAMPLES * 4);
    const fm_bind sampled[] = { { 0, FM_BINDING_SAMPLED, NULL, slots, FM_ACCESS_READ },
                                { 1, FM_BINDING_STORAGE, out, NULL, FM_ACCESS_WRITE } };
    const fm_pipeline_desc initial = {
        .fragment = "#version 450\nvoid main() {}\n",
        .state = { .stencil_test = FM_COMPARE_ALWAYS,
                   .stencil_pass = FM_STENCIL_REPLACE,
                   .stencil_reference = 2,
                   .stencil_reference_step = 1,
                   .sample_mask = 1,
                   .sample_mask_step = 1 },
        .depth_stencil = FM_FORMAT_D32F_S8,
        .samples = SAMPLES,
    };
    fm_pipeline *store = make_pipeline(
        device, (fm_pipeline_desc){ .fragment = route_source,
                                    .state = { .stencil_test = FM_COMPARE_EQUAL,
                                               .stencil_fail = FM_STENCIL_DECREMENT,
                                               .stencil_depth_fail = FM_STENCIL_DECREMENT,
                                               .stencil_pass = FM_STENCIL_DECREMENT,
                                               .stencil_reference = 2 },
                                    .targets = { { .format = FM_FORMAT_RG32F } },
                                    .target_count = 1,
                                    .depth_stencil = FM_FORMAT_D32F_S8,
                                    .samples = SAMPLES });
    fm_pipeline *copy = make_pipeline(device, (fm_pipeline_desc){ .compute = read_samples_source });
    fm_draw command = { .width_px = SIDE_PX,
                        .height_px = SIDE_PX,
                        .vertex_count = 3,
                        .instance_count = 1,
                        .depth_stencil = depth,
                        .query = -1 };
    float samples[PIXELS * SAMPLES];

    begin(device);
    device->ops->image_clear(device, slots, (const float[4]){ 0.0f }, 0.0f, 0);
    device->ops->image_clear(device, depth, (const float[4]){ 0.0f }, 0.0f, 99);
    for (uint32_t i = 0; i < SAMPLES; i++) {
        fm_pipeline_desc desc = initial;
        desc.iteration = i;
        fm_pipeline *pipeline = make_pipeline(device, desc);
        command.pipeline = pipeline;
        draw(device, &command);
        device->ops->pipeline_destroy(device, pipeline);
    }
    command.pipeline = store;
    command.targets[0] = slots;
    command.target_count = 1;
    command.instance_count = 3;
    draw(device, &command);
    dispatch(device, &(fm_dispatch){ .pipeline = copy,
                                     .binds = sampled,
                                     .bind_count = 2,
                                     .groups = { SIDE_PX, SIDE_PX, 1 } });
    end(device);
    device->ops->buffer_read(device, out, 0, samples, sizeof samples, NULL);

    for (int i = 0; i < PIXELS; i++) {
        assert_true(samples[i * SAMPLES + 0] == 1.0f && samples[i * SAMPLES + 1] == 2.0f);
        assert_true(samples[i * SAMPLES + 2] == 3.0f && samples[i * SAMPLES + 3] == 0.0f);
    }
    device->ops->pipeline_destroy(device, store);
    device->ops->pipeline_destroy(device, copy);
    device->ops->image_destroy(device, slots);
    device->ops->image_destroy(device, depth);
    device->ops->buffer_destroy(device, out);
    device->ops->close(device);
}

/* Attachments that differ in their samples are refused, twice in a row, and the next draw is not
 * harmed. */
static void osmesa_refuses_attachments_that_do_not_fit(void **state)
{
    (void)state;
    const fm_device_desc plain = { .selector = NULL };
    fm_device *device = open_osmesa(&plain);
    fm_image_resource *colour = make_image(device, FM_FORMAT_RGBA8, 1);
    fm_image_resource *depth = make_image(device, FM_FORMAT_D32F, 4);
    fm_pipeline *pipeline =
        make_pipeline(device, (fm_pipeline_desc){ .fragment = "#version 450\nvoid main() {}\n" });
    fm_draw command = { .pipeline = pipeline,
                        .width_px = SIDE_PX,
                        .height_px = SIDE_PX,
                        .vertex_count = 3,
                        .instance_count = 1,
                        .targets = { colour },
                        .target_count = 1,
                        .depth_stencil = depth,
                        .query = 2 };
    fm_error err = { .message = "" };
    begin(device);
    for (int i = 0; i < 2; i++)
        assert_int_equal(device->ops->draw(device, &command, &err), FM_UNSUPPORTED);
    assert_non_null(strstr(err.message, "differ in their samples"));
    command.depth_stencil = NULL;
    draw(device, &command);
    draw(device, &command); /* a query used twice adds up */
    assert_int_equal(end(device).query[2], 2 * PIXELS);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->image_destroy(device, colour);
    device->ops->image_destroy(device, depth);
    device->ops->close(device);
}

/* Copies one texel of a float image to the host, through texelFetch in a compute shader. */
static void read_texel(float texel[4], fm_device *device, fm_image_resource *image)
{
    fm_buffer *out = make_buffer(device, 16);
    fm_pipeline *copy = make_pipeline(
        device, (fm_pipeline_desc){ .compute = "#version 450\n"
                                               "layout(local_size_x = 1) in;\n"
                                               "layout(binding = 0) uniform sampler2D image;\n"
                                               "layout(binding = 1) buffer Out { vec4 o; };\n"
                                               "void main() {\n"
                                               "  o = texelFetch(image, ivec2(5, 3), 0);\n"
                                               "}\n" });
    const fm_bind binds[] = { { 0, FM_BINDING_SAMPLED, NULL, image, FM_ACCESS_READ },
                              { 1, FM_BINDING_STORAGE, out, NULL, FM_ACCESS_WRITE } };
    begin(device);
    dispatch(
        device,
        &(fm_dispatch){ .pipeline = copy, .binds = binds, .bind_count = 2, .groups = { 1, 1, 1 } });
    end(device);
    device->ops->buffer_read(device, out, 0, texel, 16, NULL);
    device->ops->pipeline_destroy(device, copy);
    device->ops->buffer_destroy(device, out);
}

static const char constant_colour[] = "#version 450\n"
                                      "layout(location = 0) out vec4 target;\n"
                                      "void main() { target = vec4(0.5, 2.0, -1.0, 0.25); }\n";

/* Draws (0.5, 2, -1, 0.25) over (1, 0.5, 0.25, 0.5): every product is exact in binary. */
static void blend_once(float texel[4], fm_device *device, const fm_target_desc *target)
{
    fm_image_resource *image = make_image(device, FM_FORMAT_RGBA32F, 1);
    fm_pipeline *pipeline = make_pipeline(device, (fm_pipeline_desc){ .fragment = constant_colour,
                                                                      .targets = { *target },
                                                                      .target_count = 1 });
    begin(device);
    draw(device, &(fm_draw){ .pipeline = pipeline,
                             .width_px = SIDE_PX,
                             .height_px = SIDE_PX,
                             .targets = { image },
                             .target_loads = { FM_LOAD_CLEAR },
                             .target_clears = { { 1.0f, 0.5f, 0.25f, 0.5f } },
                             .target_count = 1,
                             .vertex_count = 3,
                             .instance_count = 1,
                             .query = -1 });
    end(device);
    read_texel(texel, device, image);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->image_destroy(device, image);
}

static void osmesa_blends_as_the_interface_says(void **state)
{
    (void)state;
    static const float expected[FM_BLEND_COUNT][4] = {
        [FM_BLEND_OFF] = { 0.5f, 2.0f, -1.0f, 0.25f },
        [FM_BLEND_ADD] = { 1.5f, 2.5f, -0.75f, 0.75f },
        [FM_BLEND_MAX] = { 1.0f, 2.0f, 0.25f, 0.5f },
        [FM_BLEND_MIN] = { 0.5f, 0.5f, -1.0f, 0.25f },
        [FM_BLEND_OVER] = { 1.25f, 2.375f, -0.8125f, 0.625f },
        [FM_BLEND_UNDER] = { 1.25f, 1.5f, -0.25f, 0.375f },
        [FM_BLEND_PRODUCT] = { 0.5f, -0.5f, 0.5f, 0.375f },
    };
    const fm_device_desc plain = { .selector = NULL };
    fm_device *device = open_osmesa(&plain);
    float texel[4];
    for (fm_blend blend = FM_BLEND_OFF; blend < FM_BLEND_COUNT; blend++) {
        const fm_target_desc target = { .format = FM_FORMAT_RGBA32F, .blend = blend };
        blend_once(texel, device, &target);
        assert_memory_equal(texel, expected[blend], sizeof texel);
    }
    const fm_target_desc masked = { .format = FM_FORMAT_RGBA32F, .no_write = true };
    blend_once(texel, device, &masked); /* the clear, and nothing else, is seen */
    assert_memory_equal(texel, ((const float[4]){ 1.0f, 0.5f, 0.25f, 0.5f }), sizeof texel);
    device->ops->close(device);
}

/* Three instances at depths 0.75, 0.5 and 0.25 against a depth image cleared to `clear`. */
static uint64_t count_passing(float *left, fm_device *device, fm_state fixed, float clear)
{
    fm_image_resource *depth = make_image(device, FM_FORMAT_D32F, 1);
    fm_pipeline *pipeline =
        make_pipeline(device, (fm_pipeline_desc){ .fragment = "#version 450\nvoid main() {}\n",
                                                  .state = fixed,
                                                  .depth_stencil = FM_FORMAT_D32F });
    float texel[4];
    begin(device);
    draw(device, &(fm_draw){ .pipeline = pipeline,
                             .width_px = SIDE_PX,
                             .height_px = SIDE_PX,
                             .depth_stencil = depth,
                             .depth_stencil_load = FM_LOAD_CLEAR,
                             .clear_depth = clear,
                             .vertex_count = 3,
                             .instance_count = 3,
                             .query = 0 });
    const fm_frame_times times = end(device);
    read_texel(texel, device, depth);
    *left = texel[0];
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->image_destroy(device, depth);
    return times.query[0];
}

static void osmesa_tests_and_writes_depth(void **state)
{
    (void)state;
    const struct {
        fm_compare test;
        bool write;
        float clear, left;
        uint64_t passing; /* of three instances */
    } cases[] = {
        { FM_COMPARE_OFF, false, 0.6f, 0.6f, 3 },
        { FM_COMPARE_OFF, true, 0.6f, 0.25f, 3 },
        { FM_COMPARE_NEVER, true, 0.6f, 0.6f, 0 },
        { FM_COMPARE_LESS, true, 0.5f, 0.25f, 1 },
        { FM_COMPARE_LESS_EQUAL, false, 0.5f, 0.5f, 2 },
        { FM_COMPARE_EQUAL, true, 0.5f, 0.5f, 1 },
        { FM_COMPARE_GREATER, true, 0.5f, 0.75f, 1 },
        { FM_COMPARE_GREATER_EQUAL, false, 0.5f, 0.5f, 2 },
        { FM_COMPARE_NOT_EQUAL, false, 0.5f, 0.5f, 2 },
        { FM_COMPARE_ALWAYS, true, 0.5f, 0.25f, 3 },
    };
    const fm_device_desc plain = { .selector = NULL };
    fm_device *device = open_osmesa(&plain);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const fm_state fixed = { .depth_test = cases[i].test, .depth_write = cases[i].write };
        float left = -1.0f;
        assert_int_equal(count_passing(&left, device, fixed, cases[i].clear),
                         cases[i].passing * PIXELS);
        assert_true(left == cases[i].left);
    }
    device->ops->close(device);
}

/* Two triangles of one indexed quad: floats and integers arrive as they lie in the buffer, and the
 * flat colour is that of a triangle's first vertex. */
static void osmesa_reads_vertices_and_takes_flat_from_the_first(void **state)
{
    (void)state;
    static const struct {
        float position[3];
        uint32_t colour;
    } vertices[] = {
        { { -1.0f, -1.0f, 0.5f }, 7 },
        { { 1.0f, -1.0f, 0.5f }, 8 },
        { { 1.0f, 1.0f, 0.5f }, 0xFFFFFFFFu },
        { { -1.0f, 1.0f, 0.5f }, 9 },
    };
    static const uint32_t indices[] = { 2, 1, 0, 3, 2, 0 };
    const fm_device_desc plain = { .selector = NULL };
    fm_device *device = open_osmesa(&plain);
    fm_buffer *vertex_buffer = make_buffer(device, sizeof vertices);
    fm_buffer *index_buffer = make_buffer(device, sizeof indices);
    fm_buffer *out = make_buffer(device, PIXELS * 4);
    fm_pipeline *pipeline = make_pipeline(
        device,
        (fm_pipeline_desc){
            .vertex = "#version 450\n"
                      "layout(location = 0) in vec3 position;\n"
                      "layout(location = 1) in uint colour;\n"
                      "layout(location = 0) flat out uint c;\n"
                      "void main() { gl_Position = vec4(position, 1.0); c = colour; }\n",
            .fragment = "#version 450\n"
                        "layout(location = 0) flat in uint c;\n"
                        "layout(binding = 4) buffer Out { uint o[]; };\n"
                        "void main() {\n"
                        "  o[uint(gl_FragCoord.y) * 16u + uint(gl_FragCoord.x)] = c;\n"
                        "}\n",
            .vertex_stride_bytes = sizeof vertices[0],
            .attributes = { { .location = 0, .element = FM_ELEMENT_FLOAT, .is_vec3 = true },
                            { .location = 1, .element = FM_ELEMENT_UINT, .offset_bytes = 12 } },
            .attribute_count = 2 });
    const fm_bind bind = { 4, FM_BINDING_STORAGE, out, NULL, FM_ACCESS_WRITE };
    uint32_t words[PIXELS];
    device->ops->buffer_write(device, vertex_buffer, 0, vertices, sizeof vertices, NULL);
    device->ops->buffer_write(device, index_buffer, 0, indices, sizeof indices, NULL);

    begin(device);
    draw(device, &(fm_draw){ .pipeline = pipeline,
                             .binds = &bind,
                             .bind_count = 1,
                             .width_px = SIDE_PX,
                             .height_px = SIDE_PX,
                             .vertices = vertex_buffer,
                             .indices = index_buffer,
                             .vertex_count = 6,
                             .instance_count = 1,
                             .query = -1 });
    end(device);
    read_words(device, out, words, PIXELS);

    assert_int_equal(words[0 * SIDE_PX + 15], 0xFFFFFFFFu); /* right of the diagonal, row 0 */
    assert_int_equal(words[15 * SIDE_PX + 0], 9);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->buffer_destroy(device, vertex_buffer);
    device->ops->buffer_destroy(device, index_buffer);
    device->ops->buffer_destroy(device, out);
    device->ops->close(device);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(osmesa_draws_without_targets_in_vulkan_coordinates),
        cmocka_unit_test(osmesa_reads_vertices_and_takes_flat_from_the_first),
        cmocka_unit_test(osmesa_blends_as_the_interface_says),
        cmocka_unit_test(osmesa_tests_and_writes_depth),
        cmocka_unit_test(osmesa_routes_fragments_to_samples_by_stencil),
        cmocka_unit_test(osmesa_refuses_attachments_that_do_not_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
