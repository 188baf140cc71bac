/* What the OpenGL device refuses, orders, measures and reports. What all devices share is in
 * device_test.c. */
#include "osmesa_kit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static fm_status try_buffer(const fm_buffer_desc *desc, fm_error *err)
{
    const fm_device_desc plain = { .selector = NULL };
    fm_device *device = open_osmesa(&plain);
    fm_buffer *buffer = NULL;
    const fm_status status = device->ops->buffer_create(&buffer, device, desc, err);
    assert_null(buffer);
    device->ops->close(device);
    return status;
}

static void osmesa_refuses_a_buffer_above_its_range_with_both_numbers(void **state)
{
    (void)state;
    fm_error err = { .message = "" };
    const fm_buffer_desc desc = { .name = "fragments", .bytes = 157u << 20 };
    assert_int_equal(try_buffer(&desc, &err), FM_UNSUPPORTED);
    assert_string_equal(err.message, "buffer 'fragments': 157 MiB, bound buffers of this device "
                                     "end at 128 MiB");
}

static void osmesa_refuses_a_buffer_by_address(void **state)
{
    (void)state;
    fm_error err = { .message = "" };
    const fm_buffer_desc desc = { .name = "heap", .bytes = 16, .by_address = true };
    assert_int_equal(try_buffer(&desc, &err), FM_UNSUPPORTED);
    assert_non_null(strstr(err.message, "'heap'"));
}

static fm_status try_image(const fm_image_desc *desc, fm_error *err)
{
    const fm_device_desc plain = { .selector = NULL };
    fm_device *device = open_osmesa(&plain);
    fm_image_resource *image = NULL;
    const fm_status status = device->ops->image_create(&image, device, desc, err);
    assert_null(image);
    assert_int_equal(device->ledger.bytes[desc->owner], 0);
    device->ops->close(device);
    return status;
}

static void osmesa_refuses_samples_it_would_round_up(void **state)
{
    (void)state;
    fm_error err = { .message = "" };
    const fm_image_desc desc = {
        .name = "slots", .format = FM_FORMAT_RG32F, .width_px = 4, .height_px = 4, .samples = 2
    };
    assert_int_equal(try_image(&desc, &err), FM_UNSUPPORTED);
    assert_non_null(strstr(err.message, "'slots': 2 samples"));
}

static void osmesa_refuses_an_image_above_its_limit_with_both_numbers(void **state)
{
    (void)state;
    fm_error err = { .message = "" };
    const fm_image_desc desc = { .name = "huge",
                                 .format = FM_FORMAT_RGBA32F,
                                 .width_px = 16384,
                                 .height_px = 16384,
                                 .layers = 64 };
    assert_int_equal(try_image(&desc, &err), FM_UNSUPPORTED);
    assert_non_null(strstr(err.message, "'huge': 274877906944 bytes"));
    assert_non_null(strstr(err.message, "end at 1073741824"));
}

static fm_status try_pipeline(const fm_pipeline_desc *desc, fm_error *err)
{
    const fm_device_desc plain = { .selector = NULL };
    fm_device *device = open_osmesa(&plain);
    fm_pipeline *pipeline = NULL;
    const fm_status status = device->ops->pipeline_create(&pipeline, device, desc, err);
    assert_null(pipeline);
    device->ops->close(device);
    return status;
}

static void osmesa_quotes_the_line_that_does_not_compile(void **state)
{
    (void)state;
    fm_error err = { .message = "" };
    const fm_pipeline_desc desc = { .name = "kb: store",
                                    .compute = "#version 450\n"
                                               "layout(local_size_x = 1) in;\n"
                                               "void main() {\n"
                                               "    uint slot = fragmets[0];\n"
                                               "}\n" };
    assert_int_equal(try_pipeline(&desc, &err), FM_SHADER);
    assert_ptr_equal(strstr(err.message, "kb: store: compute shader, line 4: "
                                         "'uint slot = fragmets[0];'\n"),
                     err.message);
}

static void osmesa_refuses_a_shader_that_does_not_link(void **state)
{
    (void)state;
    fm_error err = { .message = "" };
    const fm_pipeline_desc desc = { .name = "kb: store",
                                    .vertex = stacked_vertex,
                                    .fragment = "#version 450\n"
                                                "layout(location = 0) in vec4 colour;\n"
                                                "layout(location = 0) out vec4 target;\n"
                                                "void main() { target = colour; }\n" };
    assert_int_equal(try_pipeline(&desc, &err), FM_SHADER);
    assert_ptr_equal(strstr(err.message, "kb: store: linking: "), err.message);
}

static void osmesa_refuses_a_binding_beyond_its_end(void **state)
{
    (void)state;
    fm_error err = { .message = "" };
    const fm_pipeline_desc desc = { .name = "kb: store",
                                    .compute = "",
                                    .bindings = { { 4000, FM_BINDING_STORAGE } },
                                    .binding_count = 1 };
    assert_int_equal(try_pipeline(&desc, &err), FM_UNSUPPORTED);
    assert_non_null(strstr(err.message, "binding 4000, storage buffers"));
}

static void osmesa_refuses_more_storage_buffers_than_a_shader_can_have(void **state)
{
    (void)state;
    char source[4096] = "#version 450\nlayout(local_size_x = 1) in;\n";
    char *at = source + strlen(source);
    fm_error err = { .message = "" };
    fm_pipeline_desc desc = { .name = "kb: store", .compute = source, .binding_count = 20 };
    for (uint32_t i = 0; i < desc.binding_count; i++) {
        desc.bindings[i] = (fm_pipeline_binding){ i, FM_BINDING_STORAGE };
        at += sprintf(at, "layout(binding = %u) buffer B%u { uint b%u[]; };\n", i, i, i);
    }
    at += sprintf(at, "void main() {");
    for (uint32_t i = 0; i < desc.binding_count; i++)
        at += sprintf(at, " b%u[0] = 1u;", i);
    sprintf(at, " }\n");
    assert_int_equal(try_pipeline(&desc, &err), FM_UNSUPPORTED);
    assert_non_null(strstr(err.message, "storage buffers, the most of a shader"));
}

enum { WIDE_PX = 256, WIDE_PIXELS = WIDE_PX * WIDE_PX };

static const char slow_source[] = "#version 450\n"
                                  "layout(binding = 0, std430) buffer A { uint a[]; };\n"
                                  "void main() {\n"
                                  "  uint p = uint(gl_FragCoord.y) * 256u + uint(gl_FragCoord.x);\n"
                                  "  uint x = p;\n"
                                  "  for (int i = 0; i < 400; i++) x = x * 1664525u + 1u;\n"
                                  "  a[p] = p + 1u + (x == 12345u ? 1u : 0u);\n"
                                  "}\n";

static const char mirror_source[] =
    "#version 450\n"
    "layout(binding = 0, std430) readonly buffer A { uint a[]; };\n"
    "layout(binding = 1, std430) writeonly buffer B { uint b[]; };\n"
    "void main() {\n"
    "  uint p = uint(gl_FragCoord.y) * 256u + uint(gl_FragCoord.x);\n"
    "  b[p] = a[65535u - p] + 1u;\n"
    "}\n";

static const char compute_source[] =
    "#version 450\n"
    "layout(local_size_x = 64) in;\n"
    "layout(binding = 0, std430) buffer A { uint a[]; };\n"
    "layout(binding = 1, std430) readonly buffer B { uint b[]; };\n"
    "void main() {\n"
    "  uint i = gl_GlobalInvocationID.x;\n"
    "  a[i] = b[65535u - i] + 1u;\n"
    "}\n";

static const char last_source[] = "#version 450\n"
                                  "layout(binding = 0, std430) readonly buffer A { uint a[]; };\n"
                                  "layout(location = 0) flat out uint last;\n"
                                  "void main() {\n"
                                  "  last = a[65535];\n"
                                  "  gl_Position = vec4((gl_VertexIndex & 1) * 4 - 1,\n"
                                  "                     (gl_VertexIndex >> 1) * 4 - 1, 0.0, 1.0);\n"
                                  "}\n";

static const char spread_source[] =
    "#version 450\n"
    "layout(binding = 1, std430) writeonly buffer B { uint b[]; };\n"
    "layout(location = 0) flat in uint last;\n"
    "void main() { b[uint(gl_FragCoord.y) * 256u +\n"
    "                uint(gl_FragCoord.x)] = last; }\n";

/* Steps that each read what the last one wrote at the far end of the buffer, in another tile of
 * llvmpipe: a fragment, a compute and a vertex shader. */
static void osmesa_orders_commands_across_tiles_and_stages(void **state)
{
    (void)state;
    const fm_device_desc plain = { .selector = NULL };
    fm_device *device = open_osmesa(&plain);
    fm_buffer *a = make_buffer(device, WIDE_PIXELS * 4);
    fm_buffer *b = make_buffer(device, WIDE_PIXELS * 4);
    fm_pipeline *slow = make_pipeline(device, (fm_pipeline_desc){ .fragment = slow_source });
    fm_pipeline *mirror = make_pipeline(device, (fm_pipeline_desc){ .fragment = mirror_source });
    fm_pipeline *compute = make_pipeline(device, (fm_pipeline_desc){ .compute = compute_source });
    fm_pipeline *vertex = make_pipeline(
        device, (fm_pipeline_desc){ .vertex = last_source, .fragment = spread_source });
    const fm_bind binds[] = {
        { 0, FM_BINDING_STORAGE, a, NULL, FM_ACCESS_READ | FM_ACCESS_WRITE },
        { 1, FM_BINDING_STORAGE, b, NULL, FM_ACCESS_READ | FM_ACCESS_WRITE },
    };
    fm_draw command = { .binds = binds,
                        .bind_count = 2,
                        .width_px = WIDE_PX,
                        .height_px = WIDE_PX,
                        .vertex_count = 3,
                        .instance_count = 1,
                        .query = -1 };
    uint32_t *words = malloc(WIDE_PIXELS * sizeof *words);
    assert_non_null(words);

    for (int round = 0; round < 3; round++) {
        begin(device);
        device->ops->fill(device, a, 0);
        device->ops->fill(device, b, 0);
        command.pipeline = slow;
        draw(device, &command);
        command.pipeline = mirror;
        draw(device, &command);
        dispatch(device, &(fm_dispatch){ .pipeline = compute,
                                         .binds = binds,
                                         .bind_count = 2,
                                         .groups = { WIDE_PIXELS / 64, 1, 1 } });
        command.pipeline = vertex;
        draw(device, &command);
        end(device);
        read_words(device, a, words, WIDE_PIXELS);
        for (uint32_t i = 0; i < WIDE_PIXELS; i++)
            assert_int_equal(words[i], i + 3);
        read_words(device, b, words, WIDE_PIXELS);
        for (uint32_t i = 0; i < WIDE_PIXELS; i++)
            assert_int_equal(words[i], WIDE_PIXELS + 2);
    }

    free(words);
    fm_pipeline *const pipelines[] = { slow, mirror, compute, vertex };
    for (size_t i = 0; i < 4; i++)
        device->ops->pipeline_destroy(device, pipelines[i]);
    device->ops->buffer_destroy(device, a);
    device->ops->buffer_destroy(device, b);
    device->ops->close(device);
}

static const char busy_source[] = "#version 450\n"
                                  "layout(local_size_x = 64) in;\n"
                                  "layout(binding = 0) buffer Out { uint o[]; };\n"
                                  "void main() {\n"
                                  "  uint x = gl_GlobalInvocationID.x;\n"
                                  "  for (int i = 0; i < 20000; i++) x = x * 1664525u + 1u;\n"
                                  "  o[gl_GlobalInvocationID.x] = x;\n"
                                  "}\n";

static uint64_t run_busy_frame(fm_frame_times *times, fm_device *device, uint32_t rounds)
{
    fm_buffer *out = make_buffer(device, 65536 * 4);
    fm_pipeline *busy = make_pipeline(device, (fm_pipeline_desc){ .compute = busy_source });
    const fm_bind bind = { 0, FM_BINDING_STORAGE, out, NULL, FM_ACCESS_WRITE };
    begin(device);
    for (uint32_t i = 0; i < rounds; i++) {
        device->ops->timer_begin(device, 3);
        dispatch(device,
                 &(fm_dispatch){
                     .pipeline = busy, .binds = &bind, .bind_count = 1, .groups = { 1024, 1, 1 } });
        device->ops->timer_end(device, 3);
        device->ops->timer_begin(device, 5);
        device->ops->timer_end(device, 5);
    }
    *times = end(device);
    device->ops->pipeline_destroy(device, busy);
    device->ops->buffer_destroy(device, out);
    return times->timer_ns[3];
}

/* Work must be counted in its own interval: the empty one beside it stays short, and both agree
 * with the host's clock (half of it at least: the frame holds nothing else, but other processes may
 * run between). */
static void osmesa_timers_add_up_to_the_wall_clock(void **state)
{
    (void)state;
    const fm_device_desc plain = { .selector = NULL };
    fm_device *device = open_osmesa(&plain);
    fm_frame_times times;
    run_busy_frame(&times, device, 1); /* compiles */
    const uint64_t busy_ns = run_busy_frame(&times, device, 3);
    assert_true(busy_ns <= times.wall_ns);
    assert_true(busy_ns >= times.wall_ns / 2);
    assert_true(times.timer_ns[5] < busy_ns / 10);
    assert_int_equal(times.timer_ns[4], 0);
    device->ops->close(device);
}

static void osmesa_without_timers_reads_zero(void **state)
{
    (void)state;
    const fm_device_desc desc = { .no_timers = true };
    fm_device *device = open_osmesa(&desc);
    fm_frame_times times;
    assert_int_equal(run_busy_frame(&times, device, 1), 0);
    assert_true(times.wall_ns > 0);
    device->ops->close(device);
}

static void osmesa_keeps_two_devices_apart(void **state)
{
    (void)state;
    const fm_device_desc plain = { .selector = NULL };
    fm_device *devices[2] = { open_osmesa(&plain), open_osmesa(&plain) };
    fm_buffer *buffers[2];
    for (int i = 0; i < 2; i++)
        buffers[i] = make_buffer(devices[i], 4);
    for (uint32_t i = 0; i < 2; i++) {
        begin(devices[i]);
        devices[i]->ops->fill(devices[i], buffers[i], i + 40);
        end(devices[i]);
    }
    for (uint32_t i = 0; i < 2; i++) {
        uint32_t word = 0;
        read_words(devices[i], buffers[i], &word, 1);
        assert_int_equal(word, i + 40);
        devices[i]->ops->buffer_destroy(devices[i], buffers[i]);
        devices[i]->ops->close(devices[i]);
    }
}

static void osmesa_reports_opengl_errors_at_the_end_of_the_frame(void **state)
{
    (void)state;
    const fm_device_desc desc = { .validation = true };
    fm_device *device = open_osmesa(&desc);
    fm_buffer *small = make_buffer(device, 4);
    fm_pipeline *busy = make_pipeline(device, (fm_pipeline_desc){ .compute = busy_source });
    fm_frame_times times;
    fm_error err = { .message = "" };
    const char *first = NULL;
    assert_int_equal(device->ops->validation_errors(device, &first), 0);
    begin(device);
    /* Three words of group counts do not fit into the buffer. */
    dispatch(device, &(fm_dispatch){ .pipeline = busy, .indirect = small });
    assert_int_equal(device->ops->frame_end(device, &times, &err), FM_DEVICE_LOST);
    assert_non_null(strstr(err.message, "GL_INVALID_OPERATION"));
    assert_int_equal(device->ops->validation_errors(device, &first), 1);
    assert_non_null(strstr(first, "Dispatch"));
    device->ops->pipeline_destroy(device, busy);
    device->ops->buffer_destroy(device, small);
    device->ops->close(device);
}

static void osmesa_is_one_device_and_says_what_it_can(void **state)
{
    (void)state;
    const fm_device_desc plain = { .selector = NULL }, second = { .selector = "1" };
    fm_device_entry entries[2];
    size_t count = 2;
    fm_device *device = NULL;
    assert_int_equal(osmesa_device.list(entries, &count, NULL), FM_OK);
    assert_int_equal(count, 1);
    assert_string_equal(entries[0].selector, "osmesa");
    assert_int_equal(osmesa_device.open(&device, &second, NULL), FM_INVALID);
    assert_null(device);

    device = open_osmesa(&plain);
    assert_non_null(strstr(device->caps.api, "OpenGL 4.5 (core)"));
    assert_true((device->caps.colour_samples & 1u << 4) != 0);
    assert_true((device->caps.depth_samples & 1u << 4) != 0);
    assert_int_equal(device->caps.features & FM_FEATURE_BUFFER_ADDRESS, 0);
    assert_true(device->caps.subgroup_size >= 4); /* llvmpipe needs 128-bit vectors */
    assert_true(device->caps.storage_range_bytes >= 128u << 20);
    device->ops->close(device);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(osmesa_is_one_device_and_says_what_it_can),
        cmocka_unit_test(osmesa_refuses_a_buffer_above_its_range_with_both_numbers),
        cmocka_unit_test(osmesa_refuses_a_buffer_by_address),
        cmocka_unit_test(osmesa_refuses_samples_it_would_round_up),
        cmocka_unit_test(osmesa_refuses_an_image_above_its_limit_with_both_numbers),
        cmocka_unit_test(osmesa_quotes_the_line_that_does_not_compile),
        cmocka_unit_test(osmesa_refuses_a_shader_that_does_not_link),
        cmocka_unit_test(osmesa_refuses_a_binding_beyond_its_end),
        cmocka_unit_test(osmesa_refuses_more_storage_buffers_than_a_shader_can_have),
        cmocka_unit_test(osmesa_orders_commands_across_tiles_and_stages),
        cmocka_unit_test(osmesa_timers_add_up_to_the_wall_clock),
        cmocka_unit_test(osmesa_without_timers_reads_zero),
        cmocka_unit_test(osmesa_keeps_two_devices_apart),
        cmocka_unit_test(osmesa_reports_opengl_errors_at_the_end_of_the_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
