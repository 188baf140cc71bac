/* Short ways to drive any device in tests: what fails fails the test. */
#ifndef FM_TESTS_DEVICE_KIT_H
#define FM_TESTS_DEVICE_KIT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "devices.h"

#include "screen_kit.h"

/* Every test runs on a fresh device of each kind, *state, and once under Vulkan's validation, which
 * must find nothing wrong; without timers there, so that barriers come from accesses alone. */
#define ON_EACH_DEVICE(test)                                                                       \
    { #test " [vulkan]", test, open_vulkan, close_opened, NULL },                                  \
        { #test " [vulkan, validated]", test, open_validated, close_opened, NULL },                \
    {                                                                                              \
#test " [osmesa]", test, open_osmesa, close_opened, NULL                                   \
    }

#define WITH_TIMERS(test)                                                                          \
    { #test " [vulkan]", test, open_vulkan, close_opened, NULL },                                  \
    {                                                                                              \
#test " [osmesa]", test, open_osmesa, close_opened, NULL                                   \
    }

/* The fragment shader of stacked_vertex for a target of one uint: 10, 11, ... */
static const char instance_fragment[] __attribute__((unused)) =
    "#version 450\n"
    "layout(location = 0) flat in int instance;\n"
    "layout(location = 0) out uint target;\n"
    "void main() { target = uint(instance) + 10u; }\n";

/* Drivers and layers stay loaded, in place of the C library's function: a leak of theirs is
 * recognised, and suppressed, by the name of the library it comes from. Weak, for tests of several
 * files. */
int dlclose(void *library) __attribute__((weak));
int dlclose(void *library)
{
    (void)library;
    return 0;
}

static inline bool is_built(const char *name)
{
    return device_find(&program_devices, name) != NULL;
}

/* NULL: not on this machine, or not in this build; the reason is printed. */
static inline fm_device *open_if_there(const char *name, const fm_device_desc *desc)
{
    fm_device *device = NULL;
    fm_error err = { .message = "" };
    const fm_status status = device_open(&device, &program_devices, name, desc, &err);
    if (status == FM_UNSUPPORTED || !is_built(name))
        print_message("skipped: %s\n", err.message);
    else if (status != FM_OK)
        fail_msg("%s", err.message);
    return device;
}

static inline int open_vulkan(void **state)
{
    *state = open_if_there("vulkan", &(fm_device_desc){ .selector = NULL });
    return 0;
}

static inline int open_validated(void **state)
{
    *state = open_if_there("vulkan", &(fm_device_desc){ .validation = true, .no_timers = true });
    return 0;
}

static inline int open_osmesa(void **state)
{
    *state = open_if_there("osmesa", &(fm_device_desc){ .selector = NULL });
    return 0;
}

static inline int close_opened(void **state)
{
    fm_device *device = *state;
    const char *first = "";
    if (device != NULL && device->ops->validation_errors(device, &first) > 0)
        fail_msg("%s", first);
    device_close(device);
    return 0;
}

static inline fm_device *device_of(void **state)
{
    if (*state == NULL) {
        skip();
        abort(); /* skip() does not return, but is not declared so */
    }
    return *state;
}

static inline fm_buffer *make_buffer(fm_device *device, fm_buffer_desc desc)
{
    fm_buffer *buffer = NULL;
    fm_error err = { .message = "" };
    desc.name = "test";
    if (device->ops->buffer_create(&buffer, device, &desc, &err) != FM_OK)
        fail_msg("%s", err.message);
    return buffer;
}

static inline fm_buffer *make_words(fm_device *device, uint64_t count)
{
    return make_buffer(device, (fm_buffer_desc){ .bytes = count * 4 });
}

static inline fm_image_resource *make_layered_image(fm_device *device, fm_format format,
                                                    uint32_t samples, uint32_t layers)
{
    fm_image_resource *image = NULL;
    fm_error err = { .message = "" };
    const fm_image_desc desc = { .name = "test",
                                 .format = format,
                                 .width_px = SIDE_PX,
                                 .height_px = SIDE_PX,
                                 .samples = samples,
                                 .layers = layers };
    if (device->ops->image_create(&image, device, &desc, &err) != FM_OK)
        fail_msg("%s", err.message);
    return image;
}

static inline fm_image_resource *make_image(fm_device *device, fm_format format, uint32_t samples)
{
    return make_layered_image(device, format, samples, 1);
}

static inline fm_pipeline *make_pipeline(fm_device *device, fm_pipeline_desc desc)
{
    fm_pipeline *pipeline = NULL;
    fm_error err = { .message = "" };
    desc.name = "test";
    if (desc.fragment != NULL && desc.vertex == NULL)
        desc.vertex = stacked_vertex;
    if (device->ops->pipeline_create(&pipeline, device, &desc, &err) != FM_OK)
        fail_msg("%s", err.message);
    return pipeline;
}

/* Draws `instances` times, three vertices unless told, over the whole screen. */
static inline void draw(fm_device *device, fm_draw command, uint32_t instances)
{
    fm_error err = { .message = "" };
    command.width_px = SIDE_PX;
    command.height_px = SIDE_PX;
    command.query = command.query > 0 ? command.query : -1;
    command.vertex_count = command.vertex_count > 0 ? command.vertex_count : 3;
    command.instance_count = instances;
    if (device->ops->draw(device, &command, &err) != FM_OK)
        fail_msg("%s", err.message);
}

static inline void dispatch(fm_device *device, const fm_pipeline *pipeline, const fm_bind *binds,
                            uint32_t bind_count, uint32_t groups)
{
    fm_error err = { .message = "" };
    const fm_dispatch command = {
        .pipeline = pipeline, .binds = binds, .bind_count = bind_count, .groups = { groups, 1, 1 }
    };
    if (device->ops->dispatch(device, &command, &err) != FM_OK)
        fail_msg("%s", err.message);
}

static inline fm_bind bind_words(uint32_t binding, fm_buffer *buffer, uint32_t access)
{
    return (fm_bind){
        .binding = binding, .kind = FM_BINDING_STORAGE, .buffer = buffer, .access = access
    };
}

static inline fm_bind bind_sampled(uint32_t binding, fm_image_resource *image)
{
    return (fm_bind){
        .binding = binding, .kind = FM_BINDING_SAMPLED, .image = image, .access = FM_ACCESS_READ
    };
}

static inline void write_words(fm_device *device, fm_buffer *buffer, const uint32_t *words,
                               size_t count)
{
    assert_int_equal(device->ops->buffer_write(device, buffer, 0, words, count * 4, NULL), FM_OK);
}

static inline void read_words(fm_device *device, fm_buffer *buffer, uint32_t *words, size_t count)
{
    assert_int_equal(device->ops->buffer_read(device, buffer, 0, words, count * 4, NULL), FM_OK);
}

static inline float as_float(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

#endif
