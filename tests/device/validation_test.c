/* Every method under Vulkan's validation layer with synchronization checks, without timers, so that
 * barriers come from what passes declare; and a method that declares too little. */
#include <stdio.h>

#include "device/vulkan/vulkan.h"
#include "kit/scene_kit.h"

static fm_device *validated_of(void **state)
{
    const char *first;
    fm_device *device = device_of(state);
    if (device->ops->validation_errors(device, &first) != 0)
        fail_msg("before anything ran: %s", first);
    return device;
}

static void expect_silence(fm_device *device, const char *where)
{
    const char *first = "";
    const uint32_t count = device->ops->validation_errors(device, &first);
    if (count != 0)
        fail_msg("%s: %u messages, first: %s", where, count, first);
}

/* Two frames of the timed build and one of the checked one, on each of these feeds that the method
 * has; if it has none of them, on all that it has. */
static void run_method(kit_scene *scene, const fm_method_desc *method, uint32_t feeds,
                       const char *texts)
{
    const uint32_t all = kit_feeds(method), own = (all & feeds) != 0 ? all & feeds : all;
    for (uint32_t feed = FM_FEED_RASTER; feed <= FM_FEED_TRIANGLES; feed <<= 1) {
        const kit_way way = { method->id, feed, texts };
        fm_measurement m;
        char where[256];
        if ((own & feed) == 0)
            continue;
        kit_tell(where, &way);
        kit_measure(&m, scene, &way);
        measurement_free(&m);
        expect_silence(scene->kit->device, where);
    }
}

/* All feeds, or another one for each method: what differs then is in passes that know no feed. */
static uint32_t feeds_of(size_t method, bool all)
{
    return all || kit_wants_all() ? ~0u : (uint32_t)FM_FEED_RASTER << method % 4;
}

static void run_methods_on(void **state, const char *scene_texts, const char *texts, bool all)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, validated_of(state));
    kit_scene_open(&scene, &kit, scene_texts);
    expect_silence(kit.device, "truth");
    for (size_t i = 0; i < kit.plugins.count; i++)
        run_method(&scene, kit_method(&kit, i), feeds_of(i, all), texts);
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void run_methods(void **state, const char *scene_texts, const char *texts)
{
    run_methods_on(state, scene_texts, texts, true);
}

#define LAYERS "width_px=24 height_px=16 pixel_density=1 tessellation=2 n=6 "

static void bound_buffers_are_valid(void **state)
{
    run_methods(state, LAYERS "order=random-cell", "k=4 buffers=bound");
}

static void buffer_addresses_are_valid(void **state)
{
    run_methods(state, LAYERS, "k=4 buffers=address");
}

static void replayed_fragments_are_valid(void **state)
{
    run_methods(state, LAYERS "depths=sloped", "k=2 buffers=bound");
}

static void full_screen_triangles_are_valid(void **state)
{
    run_methods_on(state, LAYERS, "k=2 buffers=bound full_screen=fragment pool=per-frame", false);
}

/* Storage images of many layers, in methods that have them. */
static void images_are_valid(void **state)
{
    scene_kit kit;
    kit_scene scene;
    unsigned run = 0;
    kit_open(&kit, validated_of(state));
    kit_scene_open(&scene, &kit, LAYERS "order=random-cell");
    for (size_t i = 0; i < kit.plugins.count; i++) {
        const fm_method_desc *method = kit_method(&kit, i);
        const fm_option *layout = option_find(method, "layout");
        if (layout == NULL || !option_has_value(layout, "image"))
            continue;
        run_method(&scene, method, ~0u, "k=4 layout=image buffers=bound");
        run_method(&scene, method, feeds_of(i, false),
                   "k=1 layout=image buffers=bound full_screen=fragment");
        run++;
    }
    assert_true(run > 0 || kit.plugins.count < 8); /* a build of few methods may have none */
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void an_empty_scene_is_valid(void **state)
{
    run_methods_on(state, "width_px=24 height_px=16 n=0", "k=2 buffers=bound", false);
}

/* ---- a missing barrier ---- */

/* A resolve pass that does not declare what it reads never gets as far as a missing barrier: its
 * shader has no name for the buffer. */
static void an_undeclared_read_is_a_shader_error(void **state)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, validated_of(state));
    kit_scene_open(&scene, &kit, LAYERS);
    const fm_plugin *plugin = plugin_list_find(&kit.plugins, "kb-ab-array")->plugin;
    fm_method_desc method = *plugin->method;
    assert_string_equal(method.passes[2].reads[1], "fragments");
    method.passes[2].reads[1] = NULL;
    fm_instance *instance = NULL;
    fm_stage *stage = NULL;
    fm_error err = { .message = "" };
    assert_int_equal(
        stage_create(&stage, kit.device, scene.scene, scene.truth, FM_FEED_RASTER, &err), FM_OK);
    const fm_instance_desc desc = { .stage = stage,
                                    .method = &method,
                                    .folders = { plugin->folder, kit.plugins.common_folder },
                                    .settings = &scene.scene->settings };
    assert_int_equal(instance_create(&instance, &desc, &err), FM_SHADER);
    assert_non_null(strstr(err.message, "kb-ab-array: pass 'resolve'"));
    assert_non_null(strstr(err.message, "fragments"));
    stage_destroy(stage);
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* Vulkan's own, but what shaders of compute passes access is forgotten: no barrier follows. */
static fm_status dispatch_without(fm_device *device, const fm_dispatch *dispatch, bool images,
                                  fm_error *err)
{
    fm_bind binds[FM_MAX_BINDINGS];
    fm_dispatch forgetful = *dispatch;
    for (uint32_t i = 0; i < dispatch->bind_count; i++) {
        binds[i] = dispatch->binds[i];
        if ((binds[i].image != NULL) == images)
            binds[i].access = 0;
    }
    forgetful.binds = binds;
    return vulkan_device.dispatch(device, &forgetful, err);
}

static fm_status dispatch_without_buffers(fm_device *device, const fm_dispatch *dispatch,
                                          fm_error *err)
{
    return dispatch_without(device, dispatch, false, err);
}

static fm_status dispatch_without_images(fm_device *device, const fm_dispatch *dispatch,
                                         fm_error *err)
{
    return dispatch_without(device, dispatch, true, err);
}

static void expect_report(void **state, const char *method, const char *texts,
                          fm_status (*forgetting)(fm_device *, const fm_dispatch *, fm_error *))
{
    scene_kit kit;
    kit_scene scene;
    fm_measurement m;
    const char *first = "";
    kit_open(&kit, validated_of(state));
    kit_scene_open(&scene, &kit, LAYERS);
    const fm_device_ops *ops = kit.device->ops;
    fm_device_ops forgetful = *ops;
    forgetful.dispatch = forgetting;
    kit.device->ops = &forgetful;
    kit_measure_times(&m, &scene, &(kit_way){ method, FM_FEED_RASTER, texts });
    kit.device->ops = ops;
    measurement_free(&m);
    const uint32_t count = ops->validation_errors(kit.device, &first);
    print_message("reported: %u messages, first: %.80s\n", count, first);
    assert_true(count > 0);
    assert_non_null(strstr(first, "SYNC-HAZARD"));
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void a_missing_barrier_is_reported(void **state)
{
    expect_report(state, "ab-array", "buffers=bound", dispatch_without_buffers);
}

/* What follows for the counters does not order reads through a sampler. */
static void a_missing_barrier_of_an_image_is_reported(void **state)
{
    expect_report(state, "kb", "layout=image buffers=bound", dispatch_without_images);
}

static int close_without_look(void **state)
{
    device_close(*state);
    return 0;
}

#define ON_VALIDATED(test)                                                                         \
    {                                                                                              \
#test, test, open_validated, close_without_look, NULL                                      \
    }

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VALIDATED(bound_buffers_are_valid),
        ON_VALIDATED(buffer_addresses_are_valid),
        ON_VALIDATED(replayed_fragments_are_valid),
        ON_VALIDATED(full_screen_triangles_are_valid),
        ON_VALIDATED(images_are_valid),
        ON_VALIDATED(an_empty_scene_is_valid),
        ON_VALIDATED(an_undeclared_read_is_a_shader_error),
        ON_VALIDATED(a_missing_barrier_is_reported),
        ON_VALIDATED(a_missing_barrier_of_an_image_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
