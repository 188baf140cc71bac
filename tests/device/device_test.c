/* What every device does alike with buffers, compute shaders and time; device_draw_test.c has what
 * they draw. */
#include "device_kit.h"

#include <stdlib.h>

static const char copy_source[] =
    "#version 450\n"
    "layout(local_size_x = 64) in;\n"
    "layout(std430, binding = 0) readonly buffer From { uint from[]; };\n"
    "layout(std430, binding = 1) writeonly buffer To { uint to[]; };\n"
    "void main() {\n"
    "  uint i = gl_GlobalInvocationID.x;\n"
    "  if (i < uint(from.length())) to[i] = from[i] * 3u + 1u;\n"
    "}\n";

static fm_pipeline *make_copy(fm_device *device)
{
    return make_pipeline(device, (fm_pipeline_desc){ .compute = copy_source,
                                                     .bindings = { { 0, FM_BINDING_STORAGE },
                                                                   { 1, FM_BINDING_STORAGE } },
                                                     .binding_count = 2 });
}

static void copy(fm_device *device, const fm_pipeline *pipeline, fm_buffer *from, fm_buffer *to,
                 uint32_t count)
{
    const fm_bind binds[] = { bind_words(0, from, FM_ACCESS_READ),
                              bind_words(1, to, FM_ACCESS_WRITE) };
    dispatch(device, pipeline, binds, 2, (count + 63) / 64);
}

static void check_round_trip(fm_device *device, uint64_t bytes, uint64_t offset, bool host_reads)
{
    fm_buffer *buffer =
        make_buffer(device, (fm_buffer_desc){ .bytes = bytes + offset, .host_reads = host_reads });
    unsigned char *out = malloc(bytes), *in = calloc(1, bytes);
    assert_true(out != NULL && in != NULL);
    for (uint64_t i = 0; i < bytes; i++)
        out[i] = (unsigned char)(i * 7 + i / 251 + 1);
    assert_int_equal(device->ops->buffer_write(device, buffer, offset, out, bytes, NULL), FM_OK);
    assert_int_equal(device->ops->buffer_read(device, buffer, offset, in, bytes, NULL), FM_OK);
    assert_memory_equal(out, in, bytes);
    free(out);
    free(in);
    device->ops->buffer_destroy(device, buffer);
}

static void device_returns_the_bytes_that_were_written(void **state)
{
    static const uint64_t sizes[] = { 1, 3, 4, 63, 4097, 1 << 20, (40 << 20) + 5 };
    fm_device *device = device_of(state);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        check_round_trip(device, sizes[i], 0, false);
        check_round_trip(device, sizes[i], 12, true);
    }
}

static void device_computes(void **state)
{
    enum { COUNT = 1000 };
    fm_device *device = device_of(state);
    uint32_t words[COUNT];
    fm_buffer *from = make_words(device, COUNT), *to = make_words(device, COUNT);
    fm_pipeline *pipeline = make_copy(device);
    for (uint32_t i = 0; i < COUNT; i++)
        words[i] = i * i;
    write_words(device, from, words, COUNT);
    begin(device);
    copy(device, pipeline, from, to, COUNT);
    end(device);
    read_words(device, to, words, COUNT);
    for (uint32_t i = 0; i < COUNT; i++)
        assert_int_equal(words[i], i * i * 3 + 1);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->buffer_destroy(device, from);
    device->ops->buffer_destroy(device, to);
}

/* 100 dependent steps through two buffers: a lost barrier shows as a wrong power. */
static void device_orders_dependent_dispatches(void **state)
{
    enum { COUNT = 1 << 16, STEPS = 100 };
    fm_device *device = device_of(state);
    fm_buffer *buffers[] = { make_words(device, COUNT), make_words(device, COUNT) };
    fm_pipeline *pipeline = make_copy(device);
    uint32_t *words = malloc(COUNT * sizeof words[0]);
    uint32_t expected = 2;
    assert_non_null(words);
    begin(device);
    device->ops->fill(device, buffers[0], 2);
    for (uint32_t i = 0; i < STEPS; i++) {
        copy(device, pipeline, buffers[i % 2], buffers[1 - i % 2], COUNT);
        expected = expected * 3 + 1;
    }
    end(device);
    read_words(device, buffers[STEPS % 2], words, COUNT);
    for (uint32_t i = 0; i < COUNT; i++)
        assert_int_equal(words[i], expected);
    free(words);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->buffer_destroy(device, buffers[0]);
    device->ops->buffer_destroy(device, buffers[1]);
}

/* The second copy overwrites what the first reads, and nothing else orders the two. */
static void device_orders_a_write_after_a_read(void **state)
{
    enum { COUNT = 1 << 16 };
    fm_device *device = device_of(state);
    fm_buffer *buffers[3];
    fm_pipeline *pipeline = make_copy(device);
    uint32_t word = 0;
    for (int i = 0; i < 3; i++)
        buffers[i] = make_words(device, COUNT);
    begin(device);
    device->ops->fill(device, buffers[0], 2);
    device->ops->fill(device, buffers[2], 9);
    copy(device, pipeline, buffers[0], buffers[1], COUNT);
    copy(device, pipeline, buffers[2], buffers[0], COUNT);
    end(device);
    read_words(device, buffers[1], &word, 1);
    assert_int_equal(word, 7);
    read_words(device, buffers[0], &word, 1);
    assert_int_equal(word, 28);
    device->ops->pipeline_destroy(device, pipeline);
    for (int i = 0; i < 3; i++)
        device->ops->buffer_destroy(device, buffers[i]);
}

static void device_fills_and_updates_in_order(void **state)
{
    fm_device *device = device_of(state);
    const uint32_t two[] = { 70, 80 };
    uint32_t words[8];
    fm_buffer *buffer = make_words(device, 8);
    begin(device);
    device->ops->fill(device, buffer, 1);
    device->ops->fill(device, buffer, 0xABCDEF01u);
    device->ops->update(device, buffer, 8, two, sizeof two);
    end(device);
    read_words(device, buffer, words, 8);
    assert_int_equal(words[1], 0xABCDEF01u);
    assert_int_equal(words[2], 70);
    assert_int_equal(words[3], 80);
    assert_int_equal(words[7], 0xABCDEF01u);
    device->ops->buffer_destroy(device, buffer);
}

static void device_takes_group_counts_from_a_buffer(void **state)
{
    fm_device *device = device_of(state);
    const uint32_t groups[] = { 2, 1, 1 };
    uint32_t words[256];
    fm_buffer *from = make_words(device, 256), *to = make_words(device, 256);
    fm_buffer *indirect =
        make_buffer(device, (fm_buffer_desc){ .bytes = sizeof groups, .is_indirect = true });
    fm_pipeline *pipeline = make_copy(device);
    const fm_bind binds[] = { bind_words(0, from, FM_ACCESS_READ),
                              bind_words(1, to, FM_ACCESS_WRITE) };
    const fm_dispatch command = {
        .pipeline = pipeline, .binds = binds, .bind_count = 2, .indirect = indirect
    };
    begin(device);
    device->ops->fill(device, from, 5);
    device->ops->fill(device, to, 0);
    device->ops->update(device, indirect, 0, groups, sizeof groups);
    assert_int_equal(device->ops->dispatch(device, &command, NULL), FM_OK);
    end(device);
    read_words(device, to, words, 256);
    assert_int_equal(words[127], 16);
    assert_int_equal(words[128], 0);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->buffer_destroy(device, from);
    device->ops->buffer_destroy(device, to);
    device->ops->buffer_destroy(device, indirect);
}

static void device_refuses_more_groups_than_it_can(void **state)
{
    fm_device *device = device_of(state);
    fm_error err = { .message = "" };
    fm_buffer *buffer = make_words(device, 4), *other = make_words(device, 4);
    fm_pipeline *pipeline = make_copy(device);
    const fm_bind binds[] = { bind_words(0, buffer, FM_ACCESS_READ),
                              bind_words(1, other, FM_ACCESS_WRITE) };
    const fm_dispatch command = { .pipeline = pipeline,
                                  .binds = binds,
                                  .bind_count = 2,
                                  .groups = { 1, device->caps.max_groups[1] + 1, 1 } };
    begin(device);
    assert_int_equal(device->ops->dispatch(device, &command, &err), FM_UNSUPPORTED);
    end(device);
    assert_non_null(strstr(err.message, "groups"));
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->buffer_destroy(device, buffer);
    device->ops->buffer_destroy(device, other);
}

static const char busy_source[] = "#version 450\n"
                                  "layout(local_size_x = 64) in;\n"
                                  "layout(std430, binding = 0) buffer Out { uint o[]; };\n"
                                  "void main() {\n"
                                  "  uint x = gl_GlobalInvocationID.x;\n"
                                  "  for (int i = 0; i < 60000; i++) x = x * 1664525u + 1u;\n"
                                  "  o[gl_GlobalInvocationID.x] = x;\n"
                                  "}\n";

static fm_frame_times run_busy(fm_device *device, uint32_t rounds, uint32_t groups)
{
    fm_buffer *out = make_words(device, (uint64_t)groups * 64);
    fm_pipeline *busy =
        make_pipeline(device, (fm_pipeline_desc){ .compute = busy_source,
                                                  .bindings = { { 0, FM_BINDING_STORAGE } },
                                                  .binding_count = 1 });
    const fm_bind bind = bind_words(0, out, FM_ACCESS_WRITE);
    begin(device);
    for (uint32_t i = 0; i < rounds; i++) {
        device->ops->timer_begin(device, 3);
        dispatch(device, busy, &bind, 1, groups);
        device->ops->timer_end(device, 3);
        device->ops->timer_begin(device, 5);
        device->ops->timer_end(device, 5);
    }
    const fm_frame_times times = end(device);
    device->ops->pipeline_destroy(device, busy);
    device->ops->buffer_destroy(device, out);
    return times;
}

/* Work must be counted in its own interval: the empty one beside it stays short, and both agree
 * with the host's clock (half of it at least: the frame holds nothing else, but other processes may
 * run between, and a GPU's first frames are clocked low). */
static void device_timers_add_up_to_the_wall_clock(void **state)
{
    fm_device *device = device_of(state);
    const uint32_t groups = device->caps.is_software ? 256 : 32768;
    run_busy(device, 1, groups); /* compiles */
    const fm_frame_times times = run_busy(device, 3, groups);
    assert_true(times.timer_ns[3] <= times.wall_ns);
    assert_true(times.timer_ns[3] >= times.wall_ns / 2);
    assert_true(times.timer_ns[5] < times.timer_ns[3] / 10);
    assert_int_equal(times.timer_ns[4], 0);
}

static void device_quotes_the_line_that_does_not_compile(void **state)
{
    fm_device *device = device_of(state);
    fm_error err = { .message = "" };
    fm_pipeline *pipeline = NULL;
    const fm_pipeline_desc desc = { .name = "kb: store",
                                    .compute = "#version 450\n"
                                               "layout(local_size_x = 1) in;\n"
                                               "void main() {\n"
                                               "    uint slot = fragmets[0];\n"
                                               "}\n" };
    assert_int_equal(device->ops->pipeline_create(&pipeline, device, &desc, &err), FM_SHADER);
    assert_null(pipeline);
    assert_ptr_equal(strstr(err.message, "kb: store: compute shader, line 4: "
                                         "'uint slot = fragmets[0];'\n"),
                     err.message);
    assert_non_null(strstr(err.message + 60, "fragmets"));
}

static void device_refuses_a_buffer_above_its_range(void **state)
{
    fm_device *device = device_of(state);
    fm_error err = { .message = "" };
    fm_buffer *buffer = NULL;
    const fm_buffer_desc desc = { .name = "fragments",
                                  .bytes = device->caps.storage_range_bytes + 1 };
    assert_int_equal(device->ops->buffer_create(&buffer, device, &desc, &err), FM_UNSUPPORTED);
    assert_null(buffer);
    assert_non_null(strstr(err.message, "'fragments'"));
    assert_int_equal(device->ledger.peak_bytes[FM_OWNER_RUNNER], 0);
}

static void device_ledger_adds_up(void **state)
{
    fm_device *device = device_of(state);
    fm_image_resource *image = NULL;
    const fm_image_desc desc = { .name = "slots",
                                 .format = FM_FORMAT_D32F_S8,
                                 .width_px = 7,
                                 .height_px = 3,
                                 .samples = 4,
                                 .owner = FM_OWNER_METHOD };
    fm_buffer *one =
        make_buffer(device, (fm_buffer_desc){ .bytes = 1001, .owner = FM_OWNER_METHOD });
    fm_buffer *two = make_buffer(device, (fm_buffer_desc){ .bytes = 10 });
    assert_int_equal(device->ops->image_create(&image, device, &desc, NULL), FM_OK);
    assert_int_equal(device->ledger.bytes[FM_OWNER_METHOD], 1001 + 7 * 3 * 4 * 5);
    assert_int_equal(device->ledger.bytes[FM_OWNER_RUNNER], 10);
    device->ops->image_destroy(device, image);
    device->ops->buffer_destroy(device, one);
    device->ops->buffer_destroy(device, two);
    device->ops->buffer_destroy(device, NULL);
    device->ops->image_destroy(device, NULL);
    device->ops->pipeline_destroy(device, NULL);
    assert_int_equal(device->ledger.bytes[FM_OWNER_METHOD], 0);
    assert_int_equal(device->ledger.peak_bytes[FM_OWNER_METHOD], 1001 + 7 * 3 * 4 * 5);
}

static void device_open_names_what_there_is(void **state)
{
    fm_device *device = NULL;
    fm_error err = { .message = "" };
    (void)state;
    assert_int_equal(device_open(&device, &program_devices, "vulcan",
                                 &(fm_device_desc){ .selector = NULL }, &err),
                     FM_INVALID);
    assert_non_null(strstr(err.message, "vulkan"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_EACH_DEVICE(device_returns_the_bytes_that_were_written),
        ON_EACH_DEVICE(device_computes),
        ON_EACH_DEVICE(device_orders_dependent_dispatches),
        ON_EACH_DEVICE(device_orders_a_write_after_a_read),
        ON_EACH_DEVICE(device_fills_and_updates_in_order),
        ON_EACH_DEVICE(device_takes_group_counts_from_a_buffer),
        ON_EACH_DEVICE(device_refuses_more_groups_than_it_can),
        WITH_TIMERS(device_timers_add_up_to_the_wall_clock),
        ON_EACH_DEVICE(device_quotes_the_line_that_does_not_compile),
        ON_EACH_DEVICE(device_refuses_a_buffer_above_its_range),
        ON_EACH_DEVICE(device_ledger_adds_up),
        cmocka_unit_test(device_open_names_what_there_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
