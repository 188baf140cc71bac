#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "device/dummy/dummy.h"
#include "device/registry.h"

static const fm_device_ops *const built[] = { &dummy_device };
static const fm_device_list dummy_alone = { .devices = built, .count = 1 };

static fm_device *open_dummy(const char *name)
{
    fm_device *device = NULL;
    const fm_device_desc desc = { .no_timers = false };
    assert_int_equal(device_open(&device, &dummy_alone, name, &desc, NULL), FM_OK);
    return device;
}

static fm_buffer *make_buffer(fm_device *device, uint64_t bytes)
{
    fm_buffer *buffer = NULL;
    const fm_buffer_desc desc = { .name = "test", .bytes = bytes, .owner = FM_OWNER_METHOD };
    assert_int_equal(device->ops->buffer_create(&buffer, device, &desc, NULL), FM_OK);
    return buffer;
}

static void dummy_buffers_keep_what_is_written(void **state)
{
    (void)state;
    fm_device *device = open_dummy("dummy");
    fm_buffer *buffer = make_buffer(device, 16);
    const uint32_t word = 7, other = 9;
    uint32_t words[4];
    device->ops->frame_begin(device, NULL);
    device->ops->fill(device, buffer, 5);
    device->ops->update(device, buffer, 4, &word, 4);
    device->ops->buffer_write(device, buffer, 12, &other, 4, NULL);
    device->ops->buffer_read(device, buffer, 0, words, sizeof words, NULL);
    assert_memory_equal(words, ((const uint32_t[]){ 5, 7, 5, 9 }), sizeof words);
    device->ops->buffer_destroy(device, buffer);
    device_close(device);
}

static void dummy_books_what_each_owner_holds(void **state)
{
    (void)state;
    fm_device *device = open_dummy("dummy");
    fm_buffer *buffer = make_buffer(device, 100);
    fm_image_resource *image = NULL;
    const fm_image_desc desc = { .name = "image",
                                 .format = FM_FORMAT_RG32F,
                                 .width_px = 3,
                                 .height_px = 2,
                                 .layers = 5,
                                 .samples = 4 };
    assert_int_equal(device->ops->image_create(&image, device, &desc, NULL), FM_OK);
    assert_int_equal(device->ledger.bytes[FM_OWNER_METHOD], 100);
    assert_int_equal(device->ledger.bytes[FM_OWNER_RUNNER], 3 * 2 * 5 * 4 * 8);
    device->ops->buffer_destroy(device, buffer);
    device->ops->image_destroy(device, image);
    assert_int_equal(device->ledger.bytes[FM_OWNER_METHOD], 0);
    assert_int_equal(device->ledger.bytes[FM_OWNER_RUNNER], 0);
    assert_int_equal(device->ledger.peak_bytes[FM_OWNER_METHOD], 100);
    device_close(device);
}

static void dummy_time_is_synthetic_and_adds_up(void **state)
{
    (void)state;
    fm_device *device = open_dummy("dummy");
    fm_pipeline *pipeline = NULL;
    const fm_pipeline_desc desc = { .name = "test", .compute = "void main() {}" };
    assert_int_equal(device->ops->pipeline_create(&pipeline, device, &desc, NULL), FM_OK);
    fm_frame_times times;
    device->ops->frame_begin(device, NULL);
    device->ops->timer_begin(device, 0);
    device->ops->timer_end(device, 0);
    for (int i = 0; i < 2; i++) {
        device->ops->timer_begin(device, 1);
        for (int j = 0; j < 3; j++)
            device->ops->dispatch(device, &(fm_dispatch){ .pipeline = pipeline }, NULL);
        device->ops->timer_end(device, 1);
    }
    assert_int_equal(device->ops->frame_end(device, &times, NULL), FM_OK);
    assert_int_equal(times.timer_ns[0], DUMMY_TIMER_NS);
    assert_int_equal(times.timer_ns[1], 2 * (DUMMY_TIMER_NS + 3 * DUMMY_COMMAND_NS));
    assert_int_equal(times.wall_ns, times.timer_ns[0] + times.timer_ns[1]);
    assert_int_equal(dummy_counts_of(device).dispatches, 6);
    assert_int_equal(dummy_counts_of(device).frames, 1);
    device->ops->pipeline_destroy(device, pipeline);
    device_close(device);
}

static void dummy_refuses_a_source_that_says_error(void **state)
{
    (void)state;
    fm_device *device = open_dummy("dummy");
    fm_pipeline *pipeline = NULL;
    fm_error err = { .message = "" };
    const fm_pipeline_desc desc = { .name = "kb: store",
                                    .vertex = "void main() {}\n",
                                    .fragment =
                                        "#version 450\n\n#error no room\nvoid main() {}\n" };
    assert_int_equal(device->ops->pipeline_create(&pipeline, device, &desc, &err), FM_SHADER);
    assert_null(pipeline);
    assert_string_equal(err.message, "kb: store: fragment shader, line 3: '#error no room'");
    device_close(device);
}

static void dummy_lost_loses_every_frame(void **state)
{
    (void)state;
    fm_device *device = open_dummy("dummy:lost");
    fm_frame_times times;
    assert_int_equal(device->ops->frame_begin(device, NULL), FM_OK);
    assert_int_equal(device->ops->frame_end(device, &times, NULL), FM_DEVICE_LOST);
    device_close(device);
}

static void dummy_tiny_refuses_large_buffers_with_both_numbers(void **state)
{
    (void)state;
    fm_device *device = open_dummy("dummy:tiny");
    fm_buffer *buffer = make_buffer(device, DUMMY_TINY_BYTES), *large = NULL;
    fm_error err = { .message = "" };
    const fm_buffer_desc desc = { .name = "fragments", .bytes = DUMMY_TINY_BYTES + 1 };
    assert_int_equal(device->ops->buffer_create(&large, device, &desc, &err), FM_UNSUPPORTED);
    assert_int_equal(err.reason, FM_REASON_DEVICE_LIMIT);
    assert_null(large);
    assert_string_equal(err.message, "buffer 'fragments': 1025 bytes, bound buffers of this device "
                                     "end at 1024 bytes");
    device->ops->buffer_destroy(device, buffer);
    device_close(device);
}

static void dummy_out_of_memory_has_no_room(void **state)
{
    (void)state;
    fm_device *device = open_dummy("dummy:out-of-memory");
    fm_buffer *buffer = NULL;
    const fm_buffer_desc desc = { .name = "fragments", .bytes = 4 };
    assert_int_equal(device->ops->buffer_create(&buffer, device, &desc, NULL), FM_NO_MEMORY);
    assert_null(buffer);
    device_close(device);
}

static void dummy_names_the_nearest_fault(void **state)
{
    (void)state;
    fm_device *device = NULL;
    fm_error err = { .message = "" };
    const fm_device_desc desc = { .no_timers = false };
    assert_int_equal(device_open(&device, &dummy_alone, "dummy:tinny", &desc, &err), FM_INVALID);
    assert_null(device);
    assert_non_null(strstr(err.message, "'dummy:tiny'"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dummy_buffers_keep_what_is_written),
        cmocka_unit_test(dummy_books_what_each_owner_holds),
        cmocka_unit_test(dummy_time_is_synthetic_and_adds_up),
        cmocka_unit_test(dummy_refuses_a_source_that_says_error),
        cmocka_unit_test(dummy_lost_loses_every_frame),
        cmocka_unit_test(dummy_tiny_refuses_large_buffers_with_both_numbers),
        cmocka_unit_test(dummy_out_of_memory_has_no_room),
        cmocka_unit_test(dummy_names_the_nearest_fault),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
