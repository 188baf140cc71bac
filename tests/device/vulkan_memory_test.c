/* What the Vulkan device says when memory is refused. The driver here always has some, so that its
 * allocations go through this file first, which refuses those that the environment names. */
#include "device_kit.h"

#include <dlfcn.h>
#include <stdio.h>
#include <vulkan/vulkan.h>

#define REFUSED_FROM "FRAGMARK_TEST_REFUSED_BYTES" /* this many bytes and more; unset: none */

/* In place of the loader's, which it calls. */
VkResult vkAllocateMemory(VkDevice device, const VkMemoryAllocateInfo *info,
                          const VkAllocationCallbacks *callbacks, VkDeviceMemory *memory)
{
    const char *refused = getenv(REFUSED_FROM);
    PFN_vkAllocateMemory allocate = NULL;
    void *const symbol = dlsym(RTLD_NEXT, "vkAllocateMemory");
    if (refused != NULL && info->allocationSize >= strtoull(refused, NULL, 10))
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    memcpy(&allocate, &symbol, sizeof allocate); /* ISO C has no cast to a pointer to a function */
    return allocate(device, info, callbacks, memory);
}

static void expect_no_room(const char *message, const char *subject)
{
    char expected[256];
    snprintf(expected, sizeof expected, "%s: no room for ", subject);
    if (strstr(message, expected) != message)
        fail_msg("'%s' does not begin with '%s'", message, expected);
    assert_non_null(strstr(message, " bytes: out of device memory (VkResult -2)"));
    assert_null(strstr(message, "::"));
    assert_null(strstr(message, ": :"));
}

static void vulkan_names_the_buffer_that_finds_no_room(void **state)
{
    fm_device *device = device_of(state);
    fm_error err = { .message = "" };
    fm_buffer *buffer = NULL;
    const fm_buffer_desc desc = { .name = "heap", .bytes = 1000 };
    setenv(REFUSED_FROM, "1000", 1);
    const fm_status status = device->ops->buffer_create(&buffer, device, &desc, &err);
    const fm_status untold = device->ops->buffer_create(&buffer, device, &desc, NULL);
    unsetenv(REFUSED_FROM);
    assert_int_equal(status, FM_NO_MEMORY);
    assert_int_equal(untold, FM_NO_MEMORY);
    assert_null(buffer);
    expect_no_room(err.message, "buffer 'heap'");
    assert_int_equal(device->ledger.peak_bytes[FM_OWNER_RUNNER], 0);
}

static void vulkan_names_the_image_that_finds_no_room(void **state)
{
    fm_device *device = device_of(state);
    fm_error err = { .message = "" };
    fm_image_resource *image = NULL;
    const fm_image_desc desc = {
        .name = "slots", .format = FM_FORMAT_R32UI, .width_px = SIDE_PX, .height_px = SIDE_PX
    };
    setenv(REFUSED_FROM, "1024", 1);
    const fm_status status = device->ops->image_create(&image, device, &desc, &err);
    const fm_status untold = device->ops->image_create(&image, device, &desc, NULL);
    unsetenv(REFUSED_FROM);
    assert_int_equal(status, FM_NO_MEMORY);
    assert_int_equal(untold, FM_NO_MEMORY);
    assert_null(image);
    expect_no_room(err.message, "image 'slots'");
    assert_int_equal(device->ledger.peak_bytes[FM_OWNER_RUNNER], 0);
}

static void vulkan_does_not_open_without_room_for_its_staging_buffer(void **state)
{
    fm_device *other = NULL;
    fm_error err = { .message = "" };
    (void)device_of(state); /* there is a driver */
    setenv(REFUSED_FROM, "1", 1);
    const fm_status status = device_open(&other, &program_devices, "vulkan",
                                         &(fm_device_desc){ .selector = NULL }, &err);
    unsetenv(REFUSED_FROM);
    assert_int_equal(status, FM_NO_MEMORY);
    assert_null(other);
    expect_no_room(err.message, "vulkan: staging buffer");
}

#define ON_VULKAN(test)                                                                            \
    {                                                                                              \
#test, test, open_vulkan, close_opened, NULL                                               \
    }

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN(vulkan_names_the_buffer_that_finds_no_room),
        ON_VULKAN(vulkan_names_the_image_that_finds_no_room),
        ON_VULKAN(vulkan_does_not_open_without_room_for_its_staging_buffer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
