/* Fragment culling of the k+-buffer (section 3.2): what is farther than all k kept fragments is
 * discarded before the critical section; and by occupancy maps, before the shader. Counted by the
 * checked build, through the real shaders. On software rasterisers, where a pixel's fragments come
 * one after the other. */
#include <stdio.h>

#include "kit/scene_kit.h"

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

/* ---- occupancy maps ---- */

/* 33 layers from 1/64 to 33/64, farthest first: with one word each has a bucket of its own, but for
 * the last two. The far edge of the fourth is where the fifth begins, which arrives too, for the
 * edge is rounded up; all others do not. */
static void expect_arrivals_of(void **state, const kit_mistake *mistake, const kit_way *way,
                               uint64_t arrived)
{
    enum { LAYERS = 33 };
    unsigned depths[LAYERS];
    scene_kit kit;
    kit_scene scene;
    fm_measurement m;
    for (unsigned i = 0; i < LAYERS; i++)
        depths[i] = LAYERS - i;
    kit_open(&kit, device_of(state));
    if (mistake != NULL)
        kit_break(&kit, mistake);
    kit_scene_take(&scene, &kit, make_sequence(depths, LAYERS));
    assert_true(kit_measure(&m, &scene, way));
    assert_int_equal(m.arrived, PIXELS_COVERED * arrived);
    assert_int_equal(m.check.missing + m.check.extra + m.check.misordered + m.lost, 0);
    assert_int_equal(m.bytes_allocated, m.bytes_predicted);
    measurement_free(&m);
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void expect_arrivals(void **state, const char *method, const char *texts, uint64_t arrived)
{
    const kit_way way = { method, FM_FEED_RASTER, texts };
    expect_arrivals_of(state, NULL, &way, arrived);
}

#define OCCUPANCY "k=4 culling=occupancy cull_words=1 "

static void what_lies_behind_the_kth_bucket_does_not_arrive(void **state)
{
    expect_arrivals(state, "kplus-array", "k=4", 33);
    expect_arrivals(state, "kplus-array", OCCUPANCY, 5);
    expect_arrivals(state, "kplus-array", OCCUPANCY "cull_range=aabb", 5);
    expect_arrivals(state, "kplus-array", OCCUPANCY "cull_range=exact", 5);
    expect_arrivals(state, "kplus-array", OCCUPANCY "cull_memory=shared", 5);
}

static void tests_in_the_shader_cull_the_same(void **state)
{
    expect_arrivals(state, "kplus-array", OCCUPANCY "cull_test=shader", 5);
    expect_arrivals(state, "f2b-k", OCCUPANCY, 5); /* owns its depth buffer */
}

/* The last bucket has no edge. */
static void a_kth_bucket_that_is_the_last_culls_nothing(void **state)
{
    expect_arrivals(state, "kplus-array", "k=32 culling=occupancy cull_words=1", 33);
}

/* A body that begins in the middle of the scene, at 17/64: what lies before it is in the first
 * bucket with the layer there, and three more buckets are the next three layers'. None of the k
 * nearest is lost: the lemma does not depend on the body. Uncounted, they would leave one layer
 * more. */
static void what_lies_before_the_range_is_in_its_first_bucket(void **state)
{
    const kit_mistake late = { "cull_range.glsl", "vec2(-depth, depth)",
                               "vec2(-max(depth, 17.0 / 64.0), depth)" };
    const kit_way way = { "kplus-array", FM_FEED_RASTER, OCCUPANCY "cull_range=exact" };
    expect_arrivals_of(state, &late, &way, 20);
}

/* Without its own test the method takes a lock for each fragment that arrives. */
static void own_cull_off_takes_a_lock_for_each_arrival(void **state)
{
    static const unsigned depths[] = { 12, 5, 20, 9, 16, 3, 14, 7, 25, 10, 18 };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, software_device_of(state));
    kit_scene_take(&scene, &kit, make_sequence(depths, 11));
    for (size_t i = 0; i < METHOD_COUNT; i++) {
        fm_measurement m;
        const kit_way way = { methods[i], FM_FEED_RASTER, "k=8 own_cull=off" };
        assert_true(kit_measure(&m, &scene, &way));
        assert_int_equal(m.culled, 0);
        assert_int_equal(m.locked, PIXELS_COVERED * 11);
        assert_int_equal(m.check.missing + m.check.extra + m.check.misordered + m.lost, 0);
        measurement_free(&m);
    }
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(farther_fragments_are_culled_once_the_buffer_is_full),
        ON_VULKAN_AND_OSMESA(nothing_is_culled_while_there_is_room),
        ON_VULKAN_AND_OSMESA(equal_to_the_farthest_is_culled),
        ON_VULKAN_AND_OSMESA(ascending_order_takes_k_locks_a_pixel),
        ON_VULKAN_AND_OSMESA(descending_order_takes_n_locks_a_pixel),
        ON_VULKAN_AND_OSMESA(what_lies_behind_the_kth_bucket_does_not_arrive),
        { "what_lies_behind_the_kth_bucket_does_not_arrive [vulkan, validated]",
          what_lies_behind_the_kth_bucket_does_not_arrive, open_validated, close_opened, NULL },
        ON_VULKAN_AND_OSMESA(tests_in_the_shader_cull_the_same),
        { "tests_in_the_shader_cull_the_same [vulkan, validated]",
          tests_in_the_shader_cull_the_same, open_validated, close_opened, NULL },
        ON_VULKAN_AND_OSMESA(a_kth_bucket_that_is_the_last_culls_nothing),
        ON_VULKAN_AND_OSMESA(what_lies_before_the_range_is_in_its_first_bucket),
        ON_VULKAN_AND_OSMESA(own_cull_off_takes_a_lock_for_each_arrival),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
