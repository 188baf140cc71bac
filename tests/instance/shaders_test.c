/* Every shader of every method compiles, for both APIs: each value of each option, each feed, k =
 * 1, 8, 64, the timed build and the checked one. Pipelines are built, no frame runs. */
#include <stdio.h>

#include "kit/scene_kit.h"

#define SCENE "width_px=3 height_px=2 pixel_density=1 n=2 fragment_probability=0.5"

typedef struct outcomes {
    unsigned built, not_supported, failed;
} outcomes;

static void build(outcomes *seen, kit_scene *scene, const kit_way *way, bool is_capture)
{
    fm_error err = { .message = "" };
    char where[256];
    const fm_status status = kit_build(scene, way, is_capture, &err);
    seen->built += status == FM_OK;
    seen->not_supported += status == FM_UNSUPPORTED;
    if (status == FM_OK || status == FM_UNSUPPORTED)
        return;
    seen->failed++;
    kit_tell(where, way);
    print_error("%s%s: %s\n", where, is_capture ? ", checked build" : "", err.message);
}

/* One option at a time; those of the runner that change shaders count as options. */
static void build_options(outcomes *seen, kit_scene *scene, const fm_method_desc *method,
                          uint32_t feed)
{
    static const char *const runner[] = { "k=8 lock=interlock", "k=8 buffers=bound",
                                          "k=8 buffers=address", "k=8 full_screen=fragment" };
    char texts[160];
    for (size_t i = 0; i < sizeof runner / sizeof runner[0]; i++)
        build(seen, scene, &(kit_way){ method->id, feed, runner[i] }, false);
    for (int i = 0; i < FM_MAX_OPTIONS && method->options[i].name != NULL; i++) {
        const fm_option *option = &method->options[i];
        for (int j = 1; j < FM_MAX_OPTION_VALUES && option->values[j] != NULL; j++) {
            snprintf(texts, sizeof texts, "k=8 %s=%s", option->name, option->values[j]);
            build(seen, scene, &(kit_way){ method->id, feed, texts }, false);
            build(seen, scene, &(kit_way){ method->id, feed, texts }, true);
        }
    }
}

static void build_ks(outcomes *seen, kit_scene *scene, const fm_method_desc *method, uint32_t feed)
{
    static const char *const ks[] = { "k=8", "k=1", "k=64" };
    const size_t count = plugin_has_k(method) ? sizeof ks / sizeof ks[0] : 1;
    for (size_t i = 0; i < count; i++) {
        build(seen, scene, &(kit_way){ method->id, feed, ks[i] }, false);
        build(seen, scene, &(kit_way){ method->id, feed, ks[i] }, true);
    }
}

static void every_shader_compiles(void **state)
{
    scene_kit kit;
    kit_scene scene;
    outcomes seen = { 0 };
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, SCENE);
    for (size_t i = 0; i < kit.plugins.count; i++) {
        const fm_method_desc *method = kit_method(&kit, i);
        for (uint32_t feed = FM_FEED_RASTER; feed <= FM_FEED_TRIANGLES; feed <<= 1) {
            if ((kit_feeds(method) & feed) == 0)
                continue;
            build_ks(&seen, &scene, method, feed);
            build_options(&seen, &scene, method, feed);
        }
    }
    kit_scene_close(&scene);
    kit_close(&kit);
    print_message("%u built, %u not supported, %u failed\n", seen.built, seen.not_supported,
                  seen.failed);
    assert_int_equal(seen.failed, 0);
    assert_true(seen.built > 0); /* else nothing was shown */
}

static bool takes_locks(const fm_method_desc *method)
{
    for (size_t i = 0; i < FM_MAX_PASSES && method->passes[i].name != NULL; i++)
        if (method->passes[i].exclusive)
            return true;
    return false;
}

static void build_locks(outcomes *seen, scene_kit *kit, kit_scene *scene)
{
    static const char *const texts[] = {
        "k=8 release=auto",
        "k=8 release=exchange buffers=bound",
        "k=8 release=store buffers=address",
    };
    for (size_t i = 0; i < kit->plugins.count; i++) {
        const fm_method_desc *method = kit_method(kit, i);
        const fm_option *layout = option_find(method, "layout");
        if (!takes_locks(method))
            continue;
        for (size_t j = 0; j < sizeof texts / sizeof texts[0]; j++) {
            char with_image[96];
            snprintf(with_image, sizeof with_image, "%s layout=image", texts[j]);
            build(seen, scene, &(kit_way){ method->id, FM_FEED_RASTER, texts[j] }, false);
            build(seen, scene, &(kit_way){ method->id, FM_FEED_COMPUTE_ADJACENT, texts[j] }, true);
            if (layout != NULL && option_has_value(layout, "image"))
                build(seen, scene, &(kit_way){ method->id, FM_FEED_RASTER, with_image }, false);
        }
    }
}

/* As on devices that need them, which this one may not be. Not by OSMesa: Mesa's OpenGL crashes
 * where it compiles barriers in branches of compute shaders, and never has them. */
static void every_lock_compiles_with_barriers_and_with_the_memory_model(void **state)
{
    fm_device *device = device_of(state);
    const fm_device_caps own = device->caps;
    scene_kit kit;
    kit_scene scene;
    outcomes seen = { 0 };
    kit_open(&kit, device);
    kit_scene_open(&scene, &kit, SCENE);
    device->caps.needs_lock_barriers = true;
    build_locks(&seen, &kit, &scene);
    device->caps.has_memory_model = false;
    build_locks(&seen, &kit, &scene);
    device->caps = own;
    kit_scene_close(&scene);
    kit_close(&kit);
    print_message("%u built, %u not supported, %u failed\n", seen.built, seen.not_supported,
                  seen.failed);
    assert_int_equal(seen.failed, 0);
    assert_true(seen.built > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(every_shader_compiles),
        cmocka_unit_test_setup_teardown(every_lock_compiles_with_barriers_and_with_the_memory_model,
                                        open_vulkan, close_opened),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
