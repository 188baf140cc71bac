/* Stencil routing: the first k arrivals, whatever their depths, by the stencil and by a counter. */
#include "kit/scene_kit.h"

static const char *const routed_methods[] = { "kb-sr", "kb-sr-counter" };
enum { ROUTED_COUNT = sizeof routed_methods / sizeof routed_methods[0] };

/* Which fragments of truth the first k arrivals are is known where layers arrive in order. */
static void expect_exact(kit_scene *scene, const kit_way *way)
{
    fm_measurement m;
    char where[256];
    kit_tell(where, way);
    if (kit_measure(&m, scene, way)) {
        if (m.check.missing + m.check.extra + m.check.misordered + m.lost != 0)
            fail_msg("%s: missing %u, extra %u, misordered %u, lost %u", where,
                     (unsigned)m.check.missing, (unsigned)m.check.extra,
                     (unsigned)m.check.misordered, (unsigned)m.lost);
        assert_int_equal(m.bytes_allocated, m.bytes_predicted);
    }
    measurement_free(&m);
}

static void sorted_arrivals_are_the_nearest_ones(void **state)
{
    static const char *const scenes[] = {
        "width_px=37 height_px=23 n=0",
        ("width_px=37 height_px=23 pixel_density=0.6 n=9 tessellation=3 order=ascending "
         "fragment_probability=0.5"),
        "width_px=31 height_px=17 pixel_density=1 n=5 tessellation=7 order=ascending depths=ulp",
        "width_px=19 height_px=11 pixel_density=0.8 n=12 order=ascending depths=coplanar",
        /* more arrivals than a stencil of 8 bits counts */
        "width_px=9 height_px=7 pixel_density=1 n=300 tessellation=2 order=ascending",
    };
    static const char *const ks[] = { "k=1", "k=2", "k=4", "k=8" };
    scene_kit kit;
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        kit_scene scene;
        kit_scene_open(&scene, &kit, scenes[i]);
        for (size_t j = 0; j < ROUTED_COUNT * sizeof ks / sizeof ks[0]; j++)
            expect_exact(&scene, &(kit_way){ routed_methods[j % ROUTED_COUNT], FM_FEED_RASTER,
                                             ks[j / ROUTED_COUNT] });
        expect_exact(&scene, &(kit_way){ "kb-sr-counter", FM_FEED_COMPUTE_PIXEL, "k=3" });
        kit_scene_close(&scene);
    }
    kit_close(&kit);
}

/* With room for all of them the order of arrival does not matter. */
static void all_fragments_are_kept_where_there_is_room(void **state)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit,
                   "width_px=37 height_px=23 pixel_density=0.6 n=4 tessellation=3 "
                   "order=random-cell fragment_probability=0.7");
    expect_exact(&scene, &(kit_way){ "kb-sr", FM_FEED_RASTER, "k=4" });
    for (uint32_t feed = FM_FEED_RASTER; feed <= FM_FEED_COMPUTE_ADJACENT; feed <<= 1)
        expect_exact(&scene, &(kit_way){ "kb-sr-counter", feed, "k=4 layout=layer" });
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* Twelve layers arrive farthest first: of four kept none is among the four nearest. */
static void the_first_arrivals_are_kept_though_farther(void **state)
{
    scene_kit kit;
    kit_scene scene;
    fm_image *images[ROUTED_COUNT];
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit,
                   "width_px=33 height_px=21 pixel_density=0.5 n=12 order=descending");
    for (size_t i = 0; i < ROUTED_COUNT; i++) {
        fm_measurement m;
        assert_true(
            kit_measure(&m, &scene, &(kit_way){ routed_methods[i], FM_FEED_RASTER, "k=4" }));
        assert_int_equal(m.check.captured, 4 * scene.truth->nonempty_pixels);
        assert_int_equal(m.check.missing, 4 * scene.truth->nonempty_pixels);
        assert_int_equal(m.check.extra + m.check.misordered + m.lost, 0);
        images[i] = m.image;
        m.image = NULL;
        measurement_free(&m);
    }
    assert_true(kit_apart(images[0], images[1]) <= 1e-6);
    for (size_t i = 0; i < ROUTED_COUNT; i++)
        image_destroy(images[i]);
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(sorted_arrivals_are_the_nearest_ones),
        ON_VULKAN_AND_OSMESA(all_fragments_are_kept_where_there_is_room),
        ON_VULKAN_AND_OSMESA(the_first_arrivals_are_kept_though_farther),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
