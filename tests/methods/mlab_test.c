/* Multi-layer alpha blending: exact while the layers of a pixel fit, and nearly so if what is too
 * many arrives front to back. */
#include <stdio.h>

#include "kit/scene_kit.h"

/* Half a step of RGBA8 for each merge, and float compositing. */
static double rounding(int merges)
{
    return merges * 0.5 / 255.0 + 1e-6;
}

typedef struct outcome {
    uint64_t missing, extra, lost;
    double max_abs;
} outcome;

static outcome measured(void **state, const char *texts, uint32_t feed, const char *k)
{
    scene_kit kit;
    kit_scene scene;
    fm_measurement m;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, texts);
    assert_true(kit_measure(&m, &scene, &(kit_way){ "mlab", feed, k }));
    assert_int_equal(m.check.misordered, 0);
    assert_int_equal(m.bytes_allocated, m.bytes_predicted);
    const outcome seen = { m.check.missing, m.check.extra, m.lost,
                           m.error.region[FM_REGION_VIEWPORT].difference.max_abs };
    measurement_free(&m);
    kit_scene_close(&scene);
    kit_close(&kit);
    return seen;
}

static void mlab_is_exact_while_the_layers_fit(void **state)
{
    for (uint32_t feed = FM_FEED_RASTER; feed <= FM_FEED_COMPUTE_ADJACENT; feed <<= 1) {
        const outcome seen = measured(state,
                                      "width_px=23 height_px=17 pixel_density=1 n=9 tessellation=3 "
                                      "order=random-cell fragment_probability=0.5",
                                      feed, "k=9");
        assert_int_equal(seen.missing + seen.extra + seen.lost, 0);
        assert_true(seen.max_abs <= 1e-6);
    }
}

static void mlab_only_rounds_what_arrives_front_to_back(void **state)
{
    const outcome seen =
        measured(state, "width_px=16 height_px=16 pixel_density=1 n=9 order=ascending",
                 FM_FEED_RASTER, "k=4");
    print_message("ascending: at most %.3g off\n", seen.max_abs);
    assert_int_equal(seen.missing, 5 * 16 * 16); /* merged into the last of four */
    assert_true(seen.max_abs <= rounding(9 - 4));
}

static void mlab_errs_where_merged_layers_belong_between(void **state)
{
    const outcome seen =
        measured(state, "width_px=16 height_px=16 pixel_density=1 n=24 order=random-cell",
                 FM_FEED_RASTER, "k=2");
    print_message("random: at most %.3g off\n", seen.max_abs);
    assert_true(seen.max_abs > rounding(24 - 2));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(mlab_is_exact_while_the_layers_fit),
        ON_VULKAN_AND_OSMESA(mlab_only_rounds_what_arrives_front_to_back),
        ON_VULKAN_AND_OSMESA(mlab_errs_where_merged_layers_belong_between),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
