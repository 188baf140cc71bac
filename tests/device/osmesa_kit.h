/* Short ways to drive the OpenGL device in tests: what fails fails the test. */
#ifndef FM_TESTS_OSMESA_KIT_H
#define FM_TESTS_OSMESA_KIT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "device/osmesa/osmesa.h"

#include "screen_kit.h"

static inline fm_device *open_osmesa(const fm_device_desc *desc)
{
    fm_device *device = NULL;
    fm_error err = { .message = "" };
    if (osmesa_device.open(&device, desc, &err) != FM_OK)
        fail_msg("%s", err.message);
    return device;
}

static inline fm_buffer *make_buffer(fm_device *device, uint64_t bytes)
{
    fm_buffer *buffer = NULL;
    fm_error err = { .message = "" };
    const fm_buffer_desc desc = { .name = "test", .bytes = bytes };
    if (device->ops->buffer_create(&buffer, device, &desc, &err) != FM_OK)
        fail_msg("%s", err.message);
    return buffer;
}

static inline fm_image_resource *make_image(fm_device *device, fm_format format, uint32_t samples)
{
    fm_image_resource *image = NULL;
    fm_error err = { .message = "" };
    const fm_image_desc desc = { .name = "test",
                                 .format = format,
                                 .width_px = SIDE_PX,
                                 .height_px = SIDE_PX,
                                 .samples = samples };
    if (device->ops->image_create(&image, device, &desc, &err) != FM_OK)
        fail_msg("%s", err.message);
    return image;
}

static inline fm_pipeline *make_pipeline(fm_device *device, fm_pipeline_desc desc)
{
    fm_pipeline *pipeline = NULL;
    fm_error err = { .message = "" };
    desc.name = "test";
    if (desc.fragment != NULL)
        desc.vertex = desc.vertex != NULL ? desc.vertex : stacked_vertex;
    if (device->ops->pipeline_create(&pipeline, device, &desc, &err) != FM_OK)
        fail_msg("%s", err.message);
    return pipeline;
}

static inline void draw(fm_device *device, const fm_draw *command)
{
    fm_error err = { .message = "" };
    if (device->ops->draw(device, command, &err) != FM_OK)
        fail_msg("%s", err.message);
}

static inline void dispatch(fm_device *device, const fm_dispatch *command)
{
    fm_error err = { .message = "" };
    if (device->ops->dispatch(device, command, &err) != FM_OK)
        fail_msg("%s", err.message);
}

static inline void read_words(fm_device *device, fm_buffer *buffer, uint32_t *words, size_t count)
{
    assert_int_equal(device->ops->buffer_read(device, buffer, 0, words, count * 4, NULL), FM_OK);
}

#endif
