/* Weighted blending: equation 6 of its paper, worked out in double, and where it is exact. */
#include <math.h>
#include <stdio.h>

#include "kit/scene_kit.h"

/* Float sums of few layers. */
static const double tolerance = 1e-5;

static double channel(uint32_t colour, int i)
{
    return (double)(colour >> (8 * i) & 0xFFu) / 255.0;
}

static void equation_6(double rgba[4], const fm_fragment *fragments, size_t count)
{
    double sums[4] = { 0 }, revealage = 1;
    for (size_t i = 0; i < count; i++) {
        const double alpha = channel(fragments[i].colour, 3);
        const double weight = alpha * fmax(1e-2, 3e3 * pow(1.0 - (double)fragments[i].depth, 3));
        for (int j = 0; j < 4; j++)
            sums[j] += channel(fragments[i].colour, j) * weight;
        revealage *= 1.0 - alpha;
    }
    for (int j = 0; j < 4; j++)
        rgba[j] = sums[3] > 0 ? sums[j] / sums[3] * (1.0 - revealage) : 0;
}

static void expect_equation(const fm_image *image, const fm_truth *truth)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    for (uint64_t pixel = 0; pixel < pixels; pixel++) {
        double rgba[4];
        const uint64_t first = truth->offsets[pixel];
        equation_6(rgba, &truth->fragments[first], truth->offsets[pixel + 1] - first);
        for (size_t j = 0; j < 4; j++)
            if (!(fabs(rgba[j] - (double)image->rgba[4 * pixel + j]) <= tolerance))
                fail_msg("pixel %u channel %u is %.9g, not %.9g", (unsigned)pixel, (unsigned)j,
                         (double)image->rgba[4 * pixel + j], rgba[j]);
    }
}

/* Returns the error of the image against all fragments, composited in order. */
static double measured_rmse(void **state, const char *texts)
{
    scene_kit kit;
    kit_scene scene;
    fm_measurement m;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, texts);
    assert_true(kit_measure(&m, &scene, &(kit_way){ "wboit", FM_FEED_RASTER, "" }));
    expect_equation(m.image, scene.truth);
    assert_int_equal(m.check.captured + m.check.extra + m.lost, 0);
    assert_int_equal(m.check.missing, scene.truth->fragment_count);
    const double rmse = m.error.region[FM_REGION_VIEWPORT].difference.rmse;
    print_message("%s: rmse %.3g\n", texts, rmse);
    measurement_free(&m);
    kit_scene_close(&scene);
    kit_close(&kit);
    return rmse;
}

static void blending_follows_the_equation(void **state)
{
    assert_true(measured_rmse(state, "width_px=37 height_px=23 pixel_density=0.7 n=9 "
                                     "tessellation=3 alphas=random alpha=0.9 order=random-cell "
                                     "fragment_probability=0.6") > 0.01);
}

static void one_layer_is_exact(void **state)
{
    assert_true(measured_rmse(state, "width_px=31 height_px=11 n=1 alpha=0.4") < 1e-6);
}

static void layers_of_one_colour_are_exact(void **state)
{
    assert_true(measured_rmse(state, "width_px=31 height_px=11 n=6 colours=grey") < 1e-6);
}

static void invisible_layers_and_none_show_nothing(void **state)
{
    assert_true(measured_rmse(state, "width_px=31 height_px=11 n=3 alpha=0") == 0.0);
    assert_true(measured_rmse(state, "width_px=31 height_px=11 n=0") == 0.0);
}

/* Of one scene with and without: everything that is compared is eight times as bright. */
static void exposure_scales_the_error_and_no_verdict(void **state)
{
    scene_kit kit;
    kit_scene scene;
    fm_measurement plain, exposed;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, "width_px=16 height_px=9 n=12 alpha=0.5 tessellation=1");
    assert_true(kit_measure(&plain, &scene, &(kit_way){ "wboit", FM_FEED_RASTER, "" }));
    assert_true(kit_measure(&exposed, &scene, &(kit_way){ "wboit", FM_FEED_RASTER, "exposure=3" }));
    const fm_difference *seen = &plain.error.region[FM_REGION_VIEWPORT].difference;
    const fm_difference *brighter = &exposed.error.region[FM_REGION_VIEWPORT].difference;
    assert_true(seen->max_abs > 1e-3);
    assert_true(fabs(brighter->max_abs - 8 * seen->max_abs) < 1e-5);
    assert_true(brighter->rmse > 7.9 * seen->rmse);
    assert_true(kit_apart(exposed.image, plain.image) > 1);
    assert_true(fabs(exposed.self_max_abs - plain.self_max_abs) <= 0);
    measurement_free(&plain);
    measurement_free(&exposed);
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(exposure_scales_the_error_and_no_verdict),
        ON_VULKAN_AND_OSMESA(blending_follows_the_equation),
        ON_VULKAN_AND_OSMESA(one_layer_is_exact),
        ON_VULKAN_AND_OSMESA(layers_of_one_colour_are_exact),
        ON_VULKAN_AND_OSMESA(invisible_layers_and_none_show_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
