/* What every device reads of vertices alike: through indices, and each type of attribute. */
#include <stdio.h>

#include "fetch_kit.h"

static fm_pipeline *make_flat(fm_device *device)
{
    static const char vertex[] = "#version 450\n"
                                 "layout(location = 0) in vec3 position;\n"
                                 "layout(location = 1) in uint word;\n"
                                 "layout(location = 0) flat out uint colour;\n"
                                 "void main() {\n"
                                 "  colour = word;\n"
                                 "  gl_Position = vec4(position, 1.0);\n"
                                 "}\n";
    static const char fragment[] = "#version 450\n"
                                   "layout(location = 0) flat in uint colour;\n"
                                   "layout(location = 0) out uint target;\n"
                                   "void main() { target = colour; }\n";
    return make_pipeline(
        device,
        (fm_pipeline_desc){
            .vertex = vertex,
            .fragment = fragment,
            .targets = { { .format = FM_FORMAT_R32UI } },
            .target_count = 1,
            .vertex_stride_bytes = 16,
            .attributes = { { .location = 0, .is_vec3 = true },
                            { .location = 1, .element = FM_ELEMENT_UINT, .offset_bytes = 12 } },
            .attribute_count = 2 });
}

/* Flat attributes come from the first vertex of a triangle, which the indices make vertex 2. */
static void device_reads_vertices_through_indices(void **state)
{
    static const struct {
        float x, y, z;
        uint32_t colour;
    } vertices[] = { { -1, -1, 0.5f, 7 }, { 3, -1, 0.5f, 8 }, { -1, 3, 0.5f, 9 } };
    static const uint32_t indices[] = { 2, 0, 1 };
    fm_device *device = device_of(state);
    uint32_t words[PIXELS];
    fm_image_resource *target = make_image(device, FM_FORMAT_R32UI, 1);
    fm_buffer *vertex_buffer =
        make_buffer(device, (fm_buffer_desc){ .bytes = sizeof vertices, .is_vertex = true });
    fm_buffer *index_buffer =
        make_buffer(device, (fm_buffer_desc){ .bytes = sizeof indices, .is_index = true });
    fm_pipeline *pipeline = make_flat(device);
    begin(device);
    device->ops->update(device, vertex_buffer, 0, vertices, sizeof vertices);
    device->ops->update(device, index_buffer, 0, indices, sizeof indices);
    draw(device,
         (fm_draw){ .pipeline = pipeline,
                    .targets = { target },
                    .target_loads = { FM_LOAD_CLEAR },
                    .target_count = 1,
                    .vertices = vertex_buffer,
                    .indices = index_buffer },
         1);
    end_and_fetch(words, device, target, FETCH_UINT);
    for (uint32_t i = 0; i < PIXELS; i++)
        assert_int_equal(words[i], 9);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->buffer_destroy(device, vertex_buffer);
    device->ops->buffer_destroy(device, index_buffer);
    device->ops->image_destroy(device, target);
}

typedef struct element_case {
    const char *type, *bits; /* GLSL: of the attribute; uvec4 of its bits */
    uint32_t components;
} element_case;

/* The first vertex's attribute, as a draw with it sees it. */
static void read_element(uint32_t bits[4], fm_device *device, const fm_pipeline *pipeline)
{
    static const struct {
        float position[3];
        uint32_t words[4]; /* ordinary floats, too: others need not arrive bit by bit */
    } vertices[] = {
        { { -1, -1, 0.5f }, { 0x3F800001u, 0xC0490FDBu, 0x7F7FFFFFu, 0x00800000u } },
        { { 3, -1, 0.5f }, { 1, 2, 3, 4 } },
        { { -1, 3, 0.5f }, { 5, 6, 7, 8 } },
    };
    fm_buffer *vertex_buffer =
        make_buffer(device, (fm_buffer_desc){ .bytes = sizeof vertices, .is_vertex = true });
    fm_buffer *seen = make_words(device, 4);
    const fm_bind bind = bind_words(0, seen, FM_ACCESS_WRITE);
    begin(device);
    device->ops->update(device, vertex_buffer, 0, vertices, sizeof vertices);
    draw(device,
         (fm_draw){
             .pipeline = pipeline, .binds = &bind, .bind_count = 1, .vertices = vertex_buffer },
         1);
    end(device);
    read_words(device, seen, bits, 4);
    device->ops->buffer_destroy(device, vertex_buffer);
    device->ops->buffer_destroy(device, seen);
}

static fm_pipeline *make_element(fm_device *device, fm_element element, const element_case *glsl)
{
    static const char fragment[] = "#version 450\n"
                                   "layout(location = 0) flat in uvec4 bits;\n"
                                   "layout(std430, binding = 0) buffer Seen { uvec4 seen; };\n"
                                   "void main() {\n"
                                   "  if (uvec2(gl_FragCoord.xy) == uvec2(5u, 3u)) seen = bits;\n"
                                   "}\n";
    char vertex[1024];
    snprintf(vertex, sizeof vertex,
             "#version 450\n"
             "layout(location = 0) in vec3 position;\n"
             "layout(location = 3) in %s value;\n"
             "layout(location = 0) flat out uvec4 bits;\n"
             "void main() { gl_Position = vec4(position, 1.0); bits = %s; }\n",
             glsl->type, glsl->bits);
    return make_pipeline(
        device, (fm_pipeline_desc){
                    .vertex = vertex,
                    .fragment = fragment,
                    .vertex_stride_bytes = 28,
                    .attributes = { { .location = 0, .is_vec3 = true },
                                    { .location = 3, .element = element, .offset_bytes = 12 } },
                    .attribute_count = 2,
                    .bindings = { { 0, FM_BINDING_STORAGE } },
                    .binding_count = 1 });
}

static void device_reads_every_element_bit_by_bit(void **state)
{
    static const uint32_t words[] = { 0x3F800001u, 0xC0490FDBu, 0x7F7FFFFFu, 0x00800000u };
    static const element_case cases[] = {
        [FM_ELEMENT_UINT] = { "uint", "uvec4(value, 0, 0, 0)", 1 },
        [FM_ELEMENT_UVEC2] = { "uvec2", "uvec4(value, 0, 0)", 2 },
        [FM_ELEMENT_UVEC4] = { "uvec4", "value", 4 },
        [FM_ELEMENT_FLOAT] = { "float", "uvec4(floatBitsToUint(value), 0, 0, 0)", 1 },
        [FM_ELEMENT_VEC2] = { "vec2", "uvec4(floatBitsToUint(value), 0, 0)", 2 },
        [FM_ELEMENT_VEC4] = { "vec4", "floatBitsToUint(value)", 4 },
        [FM_ELEMENT_UINT64] = { "uvec2", "uvec4(value, 0, 0)", 2 },
    };
    fm_device *device = device_of(state);
    _Static_assert(sizeof cases / sizeof cases[0] == FM_ELEMENT_COUNT, "each element once");
    for (fm_element element = 0; element < FM_ELEMENT_COUNT; element++) {
        uint32_t bits[4] = { 0 };
        fm_pipeline *pipeline = make_element(device, element, &cases[element]);
        read_element(bits, device, pipeline);
        for (uint32_t i = 0; i < 4; i++)
            assert_int_equal(bits[i], i < cases[element].components ? words[i] : 0);
        device->ops->pipeline_destroy(device, pipeline);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_EACH_DEVICE(device_reads_vertices_through_indices),
        ON_EACH_DEVICE(device_reads_every_element_bit_by_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
