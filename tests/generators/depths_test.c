/* The depths of layers: of each distribution, and of a reversed projection. */
#include "layers_kit.h"

static void ulp_depths_are_neighbours(void **state)
{
    (void)state;
    fm_settings s = layers_settings(64);
    s.depths = FM_DEPTHS_ULP;
    fm_scene *scene = create(&s);
    assert_true(scene->layers[0].depth == 0.5f);
    for (uint32_t i = 1; i < 64; i++)
        assert_true(nextafterf(scene->layers[i - 1].depth, 1.0f) == scene->layers[i].depth);
    scene_destroy(scene);
}

static void step24_depths_are_multiples_of_two_to_the_minus_24(void **state)
{
    (void)state;
    fm_settings s = layers_settings(1000);
    s.depths = FM_DEPTHS_STEP24;
    fm_scene *scene = create(&s);
    for (uint32_t i = 0; i < 1000; i++)
        assert_true(ldexp((double)scene->layers[i].depth, 24) == i + 1.0);
    scene_destroy(scene);
}

static void small_depths_are_multiples_of_their_step(void **state)
{
    (void)state;
    static const struct {
        fm_depths depths;
        int exponent;
    } steps[] = { { FM_DEPTHS_STEP32, 32 }, { FM_DEPTHS_DENORMAL, 149 } };
    fm_settings s = layers_settings(1000);
    for (size_t k = 0; k < sizeof steps / sizeof steps[0]; k++) {
        s.depths = steps[k].depths;
        fm_scene *scene = create(&s);
        for (uint32_t i = 0; i < 1000; i++)
            assert_true(ldexp((double)scene->layers[i].depth, steps[k].exponent) == i + 1.0);
        scene_destroy(scene);
    }
}

/* A distance from its depth, the planes being at 1 and 10^7. */
static double distance_of(double depth)
{
    return 1e7 / (1e7 - depth * (1e7 - 1.0));
}

static void projected_depths_are_of_distances_in_equal_ratios(void **state)
{
    (void)state;
    fm_settings s = layers_settings(6);
    s.depths = FM_DEPTHS_PROJECTED;
    s.depth = FM_DEPTH_REVERSED;
    fm_scene *scene = create(&s);
    for (uint32_t i = 0; i < 6; i++) /* 10, 100, ..., 10^6 */
        assert_true(fabs(distance_of(1.0 - (double)scene->layers[i].depth) / pow(10, i + 1.0) -
                         1.0) < 1e-6);
    scene_destroy(scene);
    s.depth = FM_DEPTH_NORMAL;
    scene = create(&s);
    assert_true(fabs(distance_of((double)scene->layers[2].depth) / 1000 - 1.0) < 1e-4);
    assert_true(fabs(distance_of((double)scene->layers[5].depth) / 1e6 - 1.0) > 1e-3); /* rounded */
    scene_destroy(scene);
}

static void reversed_depths_fall_and_are_seen_to_rise(void **state)
{
    (void)state;
    fm_settings s = layers_settings(64);
    s.depth = FM_DEPTH_REVERSED;
    for (s.depths = FM_DEPTHS_UNIFORM; s.depths < FM_DEPTHS_COUNT; s.depths++) {
        if (layers_may_tie(&s))
            continue;
        fm_scene *scene = create(&s);
        fm_fragment fragments[64];
        assert_int_equal(layers_sorted(fragments, scene, 427, 240), 64);
        for (uint32_t i = 1; i < 64; i++) {
            assert_true(scene->layers[i].depth < scene->layers[i - 1].depth);
            assert_true(fragments[i].depth > fragments[i - 1].depth);
        }
        scene_destroy(scene);
    }
}

static void steps_that_a_reversed_projection_rounds_may_tie(void **state)
{
    (void)state;
    fm_settings s = layers_settings(4);
    s.depths = FM_DEPTHS_STEP32;
    assert_false(layers_may_tie(&s));
    s.depth = FM_DEPTH_REVERSED;
    assert_true(layers_may_tie(&s));
}

static void ends_depths_start_at_zero_and_end_at_one(void **state)
{
    (void)state;
    static const uint32_t counts[] = { 1, 2, 3, 8, 127, 128 };
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
        const uint32_t n = counts[c];
        fm_settings s = layers_settings(n);
        s.depths = FM_DEPTHS_ENDS;
        fm_scene *scene = create(&s);
        assert_true(scene->layers[0].depth == 0.0f);
        for (uint32_t i = 1; i < n; i++)
            assert_true(scene->layers[i - 1].depth < scene->layers[i].depth);
        assert_true(n == 1 || scene->layers[n - 1].depth == 1.0f);
        scene_destroy(scene);
    }
}

static void layers_share_depths_in_pairs_or_all_of_them(void **state)
{
    (void)state;
    fm_settings s = layers_settings(9);
    s.depths = FM_DEPTHS_COPLANAR;
    fm_scene *scene = create(&s);
    for (uint32_t i = 1; i < 9; i++)
        assert_true((scene->layers[i].depth == scene->layers[i - 1].depth) == (i % 2 == 1));
    scene_destroy(scene);
    s.depths = FM_DEPTHS_EQUAL;
    scene = create(&s);
    for (uint32_t i = 0; i < 9; i++)
        assert_true(scene->layers[i].depth == 0.5f);
    scene_destroy(scene);
}

static void clustered_depths_make_eight_clusters(void **state)
{
    (void)state;
    fm_settings s = layers_settings(100);
    s.depths = FM_DEPTHS_CLUSTERED;
    fm_scene *scene = create(&s);
    int jumps = 0;
    for (uint32_t i = 1; i < 100; i++) {
        const double step = (double)scene->layers[i].depth - (double)scene->layers[i - 1].depth;
        assert_true(step >= ldexp(1.0, -20));
        jumps += step > ldexp(1.0, -20);
    }
    assert_int_equal(jumps, 7);
    scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ulp_depths_are_neighbours),
        cmocka_unit_test(step24_depths_are_multiples_of_two_to_the_minus_24),
        cmocka_unit_test(small_depths_are_multiples_of_their_step),
        cmocka_unit_test(projected_depths_are_of_distances_in_equal_ratios),
        cmocka_unit_test(reversed_depths_fall_and_are_seen_to_rise),
        cmocka_unit_test(steps_that_a_reversed_projection_rounds_may_tie),
        cmocka_unit_test(ends_depths_start_at_zero_and_end_at_one),
        cmocka_unit_test(layers_share_depths_in_pairs_or_all_of_them),
        cmocka_unit_test(clustered_depths_make_eight_clusters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
