/* What the Vulkan device refuses, lists and derives; device_test.c holds what all devices share. */
#include "device_kit.h"

#include <stdio.h>
#include <stdlib.h>

#include "device/vulkan/vulkan.h"

static const char add_source[] = "#version 450\n"
                                 "layout(local_size_x = 64) in;\n"
                                 "layout(std430, binding = 0) buffer From { uint from[]; };\n"
                                 "layout(std430, binding = 1) buffer To { uint to[]; };\n"
                                 "void main() {\n"
                                 "  uint i = gl_GlobalInvocationID.x;\n"
                                 "  to[i] = from[i] + 1u;\n"
                                 "}\n";

static fm_pipeline *make_add(fm_device *device)
{
    return make_pipeline(device, (fm_pipeline_desc){ .compute = add_source,
                                                     .bindings = { { 0, FM_BINDING_STORAGE },
                                                                   { 1, FM_BINDING_STORAGE } },
                                                     .binding_count = 2 });
}

static void vulkan_lists_what_it_opens(void **state)
{
    fm_device *device = device_of(state), *again = NULL;
    fm_device_entry entries[8];
    size_t count = 8;
    assert_int_equal(vulkan_device.list(entries, &count, NULL), FM_OK);
    assert_true(count >= 1);
    assert_string_equal(entries[0].selector, "vulkan:0");
    assert_string_equal(entries[0].name, device->caps.name);
    count = 0;
    assert_int_equal(vulkan_device.list(entries, &count, NULL), FM_OK);
    assert_int_equal(count, 0);
    assert_int_equal(device_open(&again, &program_devices, "vulkan:0",
                                 &(fm_device_desc){ .selector = NULL }, NULL),
                     FM_OK);
    assert_string_equal(again->caps.name, device->caps.name);
    device_close(again);
}

static void vulkan_opens_by_part_of_a_name_in_any_case(void **state)
{
    fm_device *device = device_of(state), *again = NULL;
    char name[] = "vulkan:xxxx";
    for (size_t i = 0; i < 4; i++) {
        const char letter = device->caps.name[i + 1];
        name[7 + i] = (char)(letter >= 'a' && letter <= 'z' ? letter - 'a' + 'A' : letter);
    }
    assert_int_equal(
        device_open(&again, &program_devices, name, &(fm_device_desc){ .selector = NULL }, NULL),
        FM_OK);
    assert_string_equal(again->caps.name, device->caps.name);
    device_close(again);
}

static void vulkan_names_its_devices_when_asked_for_another(void **state)
{
    fm_device *device = device_of(state), *other = NULL;
    fm_error err = { .message = "" };
    const fm_device_desc plain = { .selector = NULL };
    assert_int_equal(device_open(&other, &program_devices, "vulkan:99", &plain, &err), FM_INVALID);
    assert_non_null(strstr(err.message, device->caps.name));
    assert_int_equal(device_open(&other, &program_devices, "vulkan:voodoo", &plain, &err),
                     FM_INVALID);
    assert_non_null(strstr(err.message, "vulkan:voodoo"));
    assert_null(other);
}

/* VK_ICD_FILENAMES is the older name of VK_DRIVER_FILES, for loaders that do not know the new. */
static void vulkan_without_a_driver_says_how_to_get_one(void **state)
{
    fm_device *device = NULL;
    fm_device_entry entry;
    fm_error err = { .message = "" };
    size_t count = 1;
    (void)state;
    setenv("VK_DRIVER_FILES", "/nonexistent.json", 1);
    setenv("VK_ICD_FILENAMES", "/nonexistent.json", 1);
    const fm_status listed = vulkan_device.list(&entry, &count, NULL);
    const fm_status opened = device_open(&device, &program_devices, "vulkan",
                                         &(fm_device_desc){ .selector = NULL }, &err);
    unsetenv("VK_DRIVER_FILES");
    unsetenv("VK_ICD_FILENAMES");
    assert_int_equal(listed, FM_OK);
    assert_int_equal(count, 0);
    assert_int_equal(opened, FM_IO);
    assert_non_null(strstr(err.message, "VK_DRIVER_FILES names: /nonexistent.json"));
    assert_null(device);
}

static void vulkan_says_what_it_can(void **state)
{
    fm_device *device = device_of(state);
    const fm_device_caps *caps = &device->caps;
    assert_ptr_equal(strstr(caps->api, "Vulkan 1."), caps->api);
    assert_true(caps->driver[0] != '\0');
    assert_true(caps->storage_range_bytes >= 128u << 20);
    assert_true((caps->features & FM_FEATURE_BUFFER_ADDRESS) != 0);
    assert_true(caps->buffer_max_bytes >= 1u << 30);
    assert_true((caps->colour_samples & 1u << 1) != 0);
    assert_true((caps->depth_samples & 1u << 4) != 0);
    assert_true(caps->timestamp_ns > 0.0);
    assert_int_equal(caps->is_software, !caps->has_gpu_clock);
    assert_true(strstr(caps->name, "llvmpipe") == NULL || caps->loop_limit == 65535);
}

static void vulkan_reaches_buffers_by_address(void **state)
{
    static const char source[] =
        "#version 450\n"
        "#extension GL_EXT_buffer_reference : require\n"
        "layout(local_size_x = 64) in;\n"
        "layout(buffer_reference, std430, buffer_reference_align = 16) buffer Words { uint w[]; "
        "};\n"
        "layout(binding = 0) uniform Table { Words words; };\n"
        "void main() { atomicAdd(words.w[gl_GlobalInvocationID.x & 7u], 2u); }\n";
    fm_device *device = device_of(state);
    uint32_t words[8];
    fm_buffer *buffer = make_buffer(device, (fm_buffer_desc){ .bytes = 32, .by_address = true });
    fm_buffer *table = make_buffer(device, (fm_buffer_desc){ .bytes = 16, .is_uniform = true });
    const uint64_t addresses[2] = { device->ops->buffer_address(buffer), 0 };
    fm_pipeline *pipeline =
        make_pipeline(device, (fm_pipeline_desc){ .compute = source,
                                                  .bindings = { { 0, FM_BINDING_UNIFORM } },
                                                  .binding_count = 1 });
    const fm_bind binds[] = {
        { .kind = FM_BINDING_UNIFORM, .buffer = table, .access = FM_ACCESS_READ },
        { .kind = FM_BINDING_ADDRESS,
          .buffer = buffer,
          .access = FM_ACCESS_READ | FM_ACCESS_WRITE },
    };
    assert_true(addresses[0] != 0);
    assert_int_equal(device->ops->buffer_address(table), 0);
    begin(device);
    device->ops->fill(device, buffer, 100);
    device->ops->update(device, table, 0, addresses, sizeof addresses);
    dispatch(device, pipeline, binds, 2, 1);
    dispatch(device, pipeline, binds, 2, 1);
    end(device);
    read_words(device, buffer, words, 8);
    for (int i = 0; i < 8; i++)
        assert_int_equal(words[i], 100 + 2 * 2 * 64 / 8);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->buffer_destroy(device, buffer);
    device->ops->buffer_destroy(device, table);
}

static void vulkan_refuses_a_longer_buffer_by_address_with_both_numbers(void **state)
{
    fm_device *device = device_of(state);
    char number[32];
    fm_error err = { .message = "" };
    fm_buffer *buffer = NULL;
    const fm_buffer_desc desc = { .name = "heap",
                                  .bytes = device->caps.buffer_max_bytes + 4,
                                  .by_address = true };
    assert_int_equal(device->ops->buffer_create(&buffer, device, &desc, &err), FM_UNSUPPORTED);
    assert_null(buffer);
    snprintf(number, sizeof number, "%llu", (unsigned long long)desc.bytes);
    assert_non_null(strstr(err.message, number));
    snprintf(number, sizeof number, "%llu", (unsigned long long)device->caps.buffer_max_bytes);
    assert_non_null(strstr(err.message, number));
}

static void vulkan_refuses_samples_and_sizes_it_lacks(void **state)
{
    fm_device *device = device_of(state);
    fm_error err = { .message = "" };
    fm_image_resource *image = NULL;
    fm_image_desc desc = {
        .name = "slots", .format = FM_FORMAT_RG32F, .width_px = 4, .height_px = 4, .samples = 32
    };
    assert_int_equal(device->ops->image_create(&image, device, &desc, &err), FM_UNSUPPORTED);
    assert_non_null(strstr(err.message, "'slots': 32 samples"));
    desc.samples = 1;
    desc.width_px = 1u << 20;
    assert_int_equal(device->ops->image_create(&image, device, &desc, &err), FM_UNSUPPORTED);
    assert_non_null(strstr(err.message, "1048576 x 4"));
    assert_null(image);
    assert_int_equal(device->ledger.peak_bytes[FM_OWNER_RUNNER], 0);
}

/* No shader stores into a depth image: the same way as into a format that this device lacks for it.
 */
static void vulkan_refuses_to_bind_an_image_that_it_cannot_store_into(void **state)
{
    static const char source[] = "#version 450\n"
                                 "layout(local_size_x = 1) in;\n"
                                 "layout(binding = 0, r32f) uniform image2D to;\n"
                                 "void main() { imageStore(to, ivec2(0), vec4(0.5)); }\n";
    fm_device *device = device_of(state);
    fm_error err = { .message = "" };
    fm_image_resource *image = make_image(device, FM_FORMAT_D32F, 1);
    fm_pipeline *pipeline =
        make_pipeline(device, (fm_pipeline_desc){ .compute = source,
                                                  .bindings = { { 0, FM_BINDING_STORAGE_IMAGE } },
                                                  .binding_count = 1 });
    const fm_bind bind = { .kind = FM_BINDING_STORAGE_IMAGE,
                           .image = image,
                           .access = FM_ACCESS_WRITE };
    begin(device);
    const fm_dispatch stores = {
        .pipeline = pipeline, .binds = &bind, .bind_count = 1, .groups = { 1, 1, 1 }
    };
    assert_int_equal(device->ops->dispatch(device, &stores, &err), FM_UNSUPPORTED);
    assert_non_null(strstr(err.message, "cannot store"));
    end(device);
    device->ops->pipeline_destroy(device, pipeline);
    device->ops->image_destroy(device, image);
}

/* More sets than a descriptor pool holds, in one frame and then in another. */
static void vulkan_binds_more_sets_than_a_pool_holds(void **state)
{
    enum { STEPS = 1000 };
    fm_device *device = device_of(state);
    uint32_t words[64];
    fm_buffer *buffers[] = { make_words(device, 64), make_words(device, 64) };
    fm_pipeline *add = make_add(device);
    for (uint32_t frame = 0; frame < 2; frame++) {
        begin(device);
        device->ops->fill(device, buffers[0], 0);
        for (uint32_t i = 0; i < STEPS; i++) {
            const fm_bind binds[] = { bind_words(0, buffers[i % 2], FM_ACCESS_READ),
                                      bind_words(1, buffers[1 - i % 2], FM_ACCESS_WRITE) };
            dispatch(device, add, binds, 2, 1);
        }
        end(device);
    }
    read_words(device, buffers[0], words, 64);
    assert_int_equal(words[63], STEPS);
    device->ops->pipeline_destroy(device, add);
    device->ops->buffer_destroy(device, buffers[0]);
    device->ops->buffer_destroy(device, buffers[1]);
}

static void vulkan_says_when_a_frame_has_too_many_intervals(void **state)
{
    fm_device *device = device_of(state);
    fm_error err = { .message = "" };
    fm_frame_times times;
    begin(device);
    for (int i = 0; i < 5000; i++) {
        device->ops->timer_begin(device, 1);
        device->ops->timer_end(device, 1);
    }
    assert_int_equal(device->ops->frame_end(device, &times, &err), FM_UNSUPPORTED);
    assert_non_null(strstr(err.message, "4096"));
    begin(device); /* and the next frame is well again */
    device->ops->timer_begin(device, 1);
    device->ops->timer_end(device, 1);
    end(device);
}

static void vulkan_without_timers_reads_zero(void **state)
{
    fm_device *device = device_of(state);
    begin(device);
    device->ops->timer_begin(device, 1);
    device->ops->timer_end(device, 1);
    const fm_frame_times times = end(device);
    assert_int_equal(times.timer_ns[1], 0);
    assert_true(times.wall_ns > 0);
}

/* Writes a buffer, then reads it, with the accesses that are told for it. */
static void write_then_read(fm_device *device, uint32_t told_write, uint32_t told_read)
{
    fm_buffer *buffers[3];
    fm_pipeline *add = make_add(device);
    for (int i = 0; i < 3; i++)
        buffers[i] = make_words(device, 64);
    const fm_bind first[] = { bind_words(0, buffers[0], FM_ACCESS_READ),
                              bind_words(1, buffers[1], told_write) };
    const fm_bind second[] = { bind_words(0, buffers[1], told_read),
                               bind_words(1, buffers[2], FM_ACCESS_WRITE) };
    begin(device);
    dispatch(device, add, first, 2, 1);
    dispatch(device, add, second, 2, 1);
    end(device);
    device->ops->pipeline_destroy(device, add);
    for (int i = 0; i < 3; i++)
        device->ops->buffer_destroy(device, buffers[i]);
}

static void vulkan_validation_accepts_right_accesses(void **state)
{
    fm_device *device = device_of(state);
    const char *first = NULL;
    write_then_read(device, FM_ACCESS_WRITE, FM_ACCESS_READ);
    assert_int_equal(device->ops->validation_errors(device, &first), 0);
    assert_string_equal(first, "");
}

static void vulkan_validation_reports_a_missing_barrier(void **state)
{
    fm_device *device = device_of(state);
    const char *first = NULL;
    write_then_read(device, FM_ACCESS_READ, FM_ACCESS_READ); /* the write is not told */
    assert_true(device->ops->validation_errors(device, &first) > 0);
    assert_non_null(strstr(first, "SYNC-HAZARD-READ-AFTER-WRITE"));
}

static int close_without_look(void **state)
{
    device_close(*state);
    return 0;
}

#define ON_VULKAN(test)                                                                            \
    {                                                                                              \
#test, test, open_vulkan, close_opened, NULL                                               \
    }
#define ON_VALIDATED(test)                                                                         \
    {                                                                                              \
#test " [validated]", test, open_validated, close_opened, NULL                             \
    }

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN(vulkan_lists_what_it_opens),
        ON_VULKAN(vulkan_opens_by_part_of_a_name_in_any_case),
        ON_VULKAN(vulkan_names_its_devices_when_asked_for_another),
        cmocka_unit_test(vulkan_without_a_driver_says_how_to_get_one),
        ON_VULKAN(vulkan_says_what_it_can),
        ON_VULKAN(vulkan_reaches_buffers_by_address),
        ON_VALIDATED(vulkan_reaches_buffers_by_address),
        ON_VULKAN(vulkan_refuses_a_longer_buffer_by_address_with_both_numbers),
        ON_VALIDATED(vulkan_refuses_samples_and_sizes_it_lacks),
        ON_VULKAN(vulkan_refuses_to_bind_an_image_that_it_cannot_store_into),
        ON_VULKAN(vulkan_binds_more_sets_than_a_pool_holds),
        ON_VALIDATED(vulkan_binds_more_sets_than_a_pool_holds),
        ON_VULKAN(vulkan_says_when_a_frame_has_too_many_intervals),
        ON_VALIDATED(vulkan_without_timers_reads_zero),
        ON_VALIDATED(vulkan_validation_accepts_right_accesses),
        { "vulkan_validation_reports_a_missing_barrier",
          vulkan_validation_reports_a_missing_barrier, open_validated, close_without_look, NULL },
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
