/* Fragment culling of the k+-buffer (section 3.2): what is farther than all k kept fragments is
 * discarded before the critical section. Counted by the checked build, through the real shaders. On
 * software rasterisers, where a pixel's fragments come one after the other. */
#include <stdio.h>

#include "scene_kit.h"

static const char *const methods[] = { "kplus-array", "kplus-heap" };
enum { METHOD_COUNT = sizeof methods / sizeof methods[0], SIDE = 5, PIXELS_COVERED = SIDE * SIDE };

static fm_device *software_device_of(void **state)
{
    fm_device *device = device_of(state);
    if (!device->caps.is_software) {
        print_message("skipped: %s takes fragments of a pixel in any order\n", device->caps.name);
        skip();
    }
    return device;
}

/* Layers over the whole viewport, in this order of arrival; depths in 64ths. */
static fm_scene *make_sequence(const unsigned *depths, uint32_t count)
{
    fm_scene *scene = kit_quads_create(SIDE, SIDE, count);
    for (uint32_t i = 0; i < count; i++)
        kit_quad(scene, i, (fm_rect){ 0, 0, SIDE, SIDE }, (float)depths[i] / 64.0f,
                 0x40000000u + i);
    return scene;
}

static void expect_events(void **state, const unsigned *depths, uint32_t count, uint64_t culled)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, software_device_of(state));
    kit_scene_take(&scene, &kit, make_sequence(depths, count));
    for (size_t i = 0; i < METHOD_COUNT; i++) {
        fm_measurement m;
        const kit_way way = { methods[i], FM_FEED_RASTER, "k=8" };
        assert_true(kit_measure(&m, &scene, &way));
        assert_int_equal(m.culled, PIXELS_COVERED * culled);
        assert_int_equal(m.locked, PIXELS_COVERED * (count - culled));
        assert_int_equal(m.check.missing + m.check.extra + m.check.misordered + m.lost, 0);
        measurement_free(&m);
    }
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* Its Fig. 3: eight fragments fill the buffer, f8 with z = 25 is farther than all of them, f9 takes
 * the place of the farthest, and f10 with z = 18 is culled too. The paper's text names the depths
 * of f8 and f10 alone; the others are ours, in the roles that it describes. */
static void farther_fragments_are_culled_once_the_buffer_is_full(void **state)
{
    static const unsigned depths[] = { 12, 5, 20, 9, 16, 3, 14, 7, 25, 10, 18 };
    expect_events(state, depths, 11, 2);
}

/* Before the buffer is full nothing is culled, however far. */
static void nothing_is_culled_while_there_is_room(void **state)
{
    static const unsigned depths[] = { 1, 2, 3, 4, 5, 6, 7, 60 };
    expect_events(state, depths, 8, 0);
}

/* A fragment as far as the farthest kept one finds no place either. */
static void equal_to_the_farthest_is_culled(void **state)
{
    static const unsigned depths[] = { 8, 7, 6, 5, 4, 3, 2, 1, 8, 7, 7 };
    expect_events(state, depths, 11, 2);
}

static void locks_of(void **state, const char *texts, uint64_t locks_a_pixel)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, software_device_of(state));
    kit_scene_open(&scene, &kit, texts);
    for (size_t i = 0; i < METHOD_COUNT; i++) {
        fm_measurement m;
        const kit_way way = { methods[i], FM_FEED_RASTER, "k=8" };
        assert_true(kit_measure(&m, &scene, &way));
        assert_int_equal(m.locked, locks_a_pixel * scene.truth->nonempty_pixels);
        assert_int_equal(m.locked + m.culled, scene.truth->fragment_count);
        measurement_free(&m);
    }
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* "Best for ascending order, useless for descending order." */
static void ascending_order_takes_k_locks_a_pixel(void **state)
{
    locks_of(state, "width_px=37 height_px=23 n=40 tessellation=3 order=ascending", 8);
}

static void descending_order_takes_n_locks_a_pixel(void **state)
{
    locks_of(state, "width_px=37 height_px=23 n=40 tessellation=3 order=descending", 40);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(farther_fragments_are_culled_once_the_buffer_is_full),
        ON_VULKAN_AND_OSMESA(nothing_is_culled_while_there_is_room),
        ON_VULKAN_AND_OSMESA(equal_to_the_farthest_is_culled),
        ON_VULKAN_AND_OSMESA(ascending_order_takes_k_locks_a_pixel),
        ON_VULKAN_AND_OSMESA(descending_order_takes_n_locks_a_pixel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
