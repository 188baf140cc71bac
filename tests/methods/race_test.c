/* What a method without a lock loses when fragments of a pixel are processed at once, on lavapipe:
 * there raster never shows it (a pixel belongs to one thread) and compute-adjacent always does. */
#include <stdio.h>

#include "kit/scene_kit.h"

enum { RUNS = 3 };

#define SCENE "width_px=64 height_px=48 pixel_density=1 n=32 tessellation=4"

/* NULL: no software Vulkan here. */
static fm_device *lavapipe_of(void **state)
{
    fm_device *device = device_of(state);
    if (!device->caps.is_software) {
        print_message("skipped: %s is no software rasteriser\n", device->caps.name);
        skip();
    }
    return device;
}

static uint64_t wrong_pixels_of(kit_scene *scene, const kit_way *way)
{
    fm_measurement m;
    assert_true(kit_measure(&m, scene, way));
    const uint64_t wrong = m.check.wrong_pixels;
    assert_int_equal(m.lost, 0);
    measurement_free(&m);
    return wrong;
}

static uint64_t wrong_pixels(kit_scene *scene, const char *method, uint32_t feed)
{
    return wrong_pixels_of(scene, &(kit_way){ method, feed, "k=8" });
}

static void k_buffers_err_in_most_pixels_when_neighbours_contend(void **state)
{
    static const char *const methods[] = { "kb", "kb-packed", "kb-multipass" };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, lavapipe_of(state));
    kit_scene_open(&scene, &kit, SCENE);
    for (size_t i = 0; i < RUNS * sizeof methods / sizeof methods[0]; i++) {
        const char *method = methods[i / RUNS];
        const uint64_t wrong = wrong_pixels(&scene, method, FM_FEED_COMPUTE_ADJACENT);
        print_message("%s: %u of %u covered pixels are wrong\n", method, (unsigned)wrong,
                      (unsigned)scene.truth->nonempty_pixels);
        assert_true(2 * wrong > scene.truth->nonempty_pixels);
    }
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void synchronised_methods_are_exact_when_neighbours_contend(void **state)
{
    static const char *const methods[] = { "kplus-array", "kplus-heap",     "kb-ps",    "kb-mdt64",
                                           "kb-mdt32",    "kb-ll",          "kb-multi", "loop32",
                                           "loop64",      "kplus-multipass" };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, lavapipe_of(state));
    kit_scene_open(&scene, &kit, SCENE);
    for (int run = 0; run < RUNS; run++)
        for (size_t i = 0; i < sizeof methods / sizeof methods[0]; i++)
            assert_int_equal(wrong_pixels(&scene, methods[i], FM_FEED_COMPUTE_ADJACENT), 0);
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* Other chains are under way while one looks for its slot. */
static void chains_may_begin_anywhere_when_neighbours_contend(void **state)
{
    static const char *const methods[] = { "kb-mdt32", "kb-mdt64" };
    static const char *const starts[] = { "k=17 start=front", "k=17 start=half",
                                          "k=17 start=binary" };
    enum { STARTS = sizeof starts / sizeof starts[0] };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, lavapipe_of(state));
    kit_scene_open(&scene, &kit, SCENE);
    for (size_t i = 0; i < 2 * STARTS; i++) {
        const kit_way way = { methods[i / STARTS], FM_FEED_COMPUTE_ADJACENT, starts[i % STARTS] };
        assert_int_equal(wrong_pixels_of(&scene, &way), 0);
    }
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void no_method_errs_on_raster(void **state)
{
    static const char *const methods[] = { "kb", "kplus-array", "kplus-heap", "kb-multi" };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, lavapipe_of(state));
    kit_scene_open(&scene, &kit, SCENE);
    for (int run = 0; run < RUNS; run++)
        for (size_t i = 0; i < sizeof methods / sizeof methods[0]; i++)
            assert_int_equal(wrong_pixels(&scene, methods[i], FM_FEED_RASTER), 0);
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(k_buffers_err_in_most_pixels_when_neighbours_contend,
                                        open_vulkan, close_opened),
        cmocka_unit_test_setup_teardown(synchronised_methods_are_exact_when_neighbours_contend,
                                        open_vulkan, close_opened),
        cmocka_unit_test_setup_teardown(chains_may_begin_anywhere_when_neighbours_contend,
                                        open_vulkan, close_opened),
        cmocka_unit_test_setup_teardown(no_method_errs_on_raster, open_vulkan, close_opened),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
