/* Methods that are not exact fail as published, and by as much. Stencil routing is in arrival_test,
 * the races of kb in race_test. */
#include "kit/scene_kit.h"

enum { SIDE = 7, COVERED = SIDE * SIDE, LAYERS_MAX = 8 };

static fm_scene *make_layers(const float *depths, uint32_t count)
{
    fm_scene *scene = kit_quads_create(SIDE, SIDE, count);
    for (uint32_t i = 0; i < count; i++)
        kit_quad(scene, i, (fm_rect){ 0, 0, SIDE, SIDE }, depths[i], 0x40000001u + i);
    return scene;
}

/* Fragments that kb-mdt32 does not hand over as they are, a pixel. */
static uint64_t not_kept(kit_scene *scene, uint32_t feed, const char *texts)
{
    fm_measurement m;
    assert_true(kit_measure(&m, scene, &(kit_way){ "kb-mdt32", feed, texts }));
    const uint64_t missing = m.check.missing;
    assert_int_equal(m.lost, 0);
    assert_int_equal(missing % COVERED, 0);
    measurement_free(&m);
    return missing / COVERED;
}

/* How many of these layers are lost with the published quantisation; with all bits none is. */
static void expect_merged(void **state, const float *depths, uint32_t count, uint64_t at_least,
                          uint64_t at_most)
{
    static const uint32_t feeds[] = { FM_FEED_RASTER, FM_FEED_COMPUTE_PIXEL };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    if (!kit_has(&kit, "kb-mdt32")) {
        kit_close(&kit);
        skip();
    }
    kit_scene_take(&scene, &kit, make_layers(depths, count));
    for (size_t i = 0; i < sizeof feeds / sizeof feeds[0]; i++) {
        const uint64_t merged = not_kept(&scene, feeds[i], "k=8 depth_bits=published");
        if (merged < at_least || merged > at_most)
            fail_msg("%u of %u layers are lost, not %u to %u", (unsigned)merged, count,
                     (unsigned)at_least, (unsigned)at_most);
        assert_int_equal(not_kept(&scene, feeds[i], "k=8 depth_bits=exact"), 0);
    }
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* (z - 0.001) / 50 in float: above z = 0.78 its step is larger than that of z. */
static void published_quantisation_merges_neighbouring_depths(void **state)
{
    float depths[LAYERS_MAX];
    for (uint32_t i = 0; i < LAYERS_MAX; i++)
        depths[i] = 0.9f + (float)i * 0x1p-24f;
    expect_merged(state, depths, LAYERS_MAX, 2, LAYERS_MAX - 2);
}

/* What lies before the near plane is all at the near plane. */
static void published_quantisation_merges_all_before_its_near_plane(void **state)
{
    static const float depths[] = { 0x1p-12f, 0x1p-11f, 0x1p-13f };
    expect_merged(state, depths, 3, 2, 3);
}

/* Each key goes back to a depth within one step: a device that does not round divisions correctly
 * (2.5 ULP are its right) may give neighbouring floats one key, of which the first is handed over.
 */
static void published_quantisation_keeps_distant_depths_apart(void **state)
{
    float depths[LAYERS_MAX];
    scene_kit kit;
    kit_scene scene;
    fm_measurement m;
    kit_open(&kit, device_of(state));
    if (!kit_has(&kit, "kb-mdt32")) {
        kit_close(&kit);
        skip();
    }
    for (uint32_t i = 0; i < LAYERS_MAX; i++)
        depths[i] = 0.5f + (float)i * 0x1p-6f;
    kit_scene_take(&scene, &kit, make_layers(depths, LAYERS_MAX));
    assert_true(kit_measure(&m, &scene,
                            &(kit_way){ "kb-mdt32", FM_FEED_RASTER, "k=8 depth_bits=published" }));
    assert_int_equal(m.check.captured, LAYERS_MAX * COVERED);
    assert_in_range(m.check.depth_ulp_max, 0, 1);
    assert_int_equal(m.check.misordered + m.lost, 0);
    measurement_free(&m);
    kit_scene_close(&scene);
    kit_close(&kit);
}

static uint64_t above(const fm_truth *truth, uint64_t room)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    uint64_t sum = 0;
    for (uint64_t pixel = 0; pixel < pixels; pixel++) {
        const uint64_t count = truth->offsets[pixel + 1] - truth->offsets[pixel];
        sum += count > room ? count - room : 0;
    }
    return sum;
}

/* Arrays of n, where n was guessed too small: what finds no room is counted, one by one. */
static void short_arrays_lose_exactly_what_is_counted(void **state)
{
    static const uint32_t rooms[] = { 1, 4, 7 };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit,
                   "width_px=37 height_px=23 pixel_density=0.6 n=9 tessellation=3 "
                   "order=random-cell fragment_probability=0.7");
    for (size_t i = 0; i < sizeof rooms / sizeof rooms[0]; i++)
        for (uint32_t feed = FM_FEED_RASTER; feed <= FM_FEED_COMPUTE_ADJACENT; feed <<= 1) {
            fm_measurement m;
            scene.told_n = rooms[i];
            assert_true(kit_measure(&m, &scene, &(kit_way){ "ab-array", feed, "" }));
            assert_int_equal(m.lost, above(scene.truth, rooms[i]));
            assert_int_equal(m.check.missing, m.lost);
            assert_int_equal(m.check.extra + m.check.misordered, 0);
            assert_int_equal(m.bytes_allocated, m.bytes_predicted);
            measurement_free(&m);
        }
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(published_quantisation_merges_neighbouring_depths),
        ON_VULKAN_AND_OSMESA(published_quantisation_merges_all_before_its_near_plane),
        ON_VULKAN_AND_OSMESA(published_quantisation_keeps_distant_depths_apart),
        ON_VULKAN_AND_OSMESA(short_arrays_lose_exactly_what_is_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
