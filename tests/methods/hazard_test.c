/* What kb-mha finds and repairs of the damage that racing fragments do: forged damage, of which it
 * is known what it is, and that of feed compute-adjacent on Mesa's software, where it comes by
 * itself. */
#include <stdio.h>
#include <string.h>

#include "kit/scene_kit.h"

/* Eight different fragments in each of 2560 pixels. */
#define WHOLE "width_px=64 height_px=40 pixel_density=1 n=8 tessellation=4 order=random-cell"

typedef struct outcome {
    uint64_t wrong, repaired, unrepaired; /* pixels */
} outcome;

static bool measured(outcome *seen, kit_scene *scene, const kit_way *way)
{
    fm_measurement m;
    const bool is_there = kit_measure(&m, scene, way);
    if (is_there)
        *seen = (outcome){ m.check.wrong_pixels, m.repaired, m.unrepaired };
    measurement_free(&m);
    return is_there;
}

/* On feeds where fragments of a pixel do not race, so that all damage is forged. */
static const struct calm {
    const char *id;
    uint32_t feed;
} methods[] = { { "kb-mha", FM_FEED_COMPUTE_PIXEL }, { "kb-mha-blend", FM_FEED_RASTER } };

/* Each on one of both devices, unless all is wanted. */
static bool has_turn(const scene_kit *kit, size_t i)
{
    return kit_wants_all() || (strcmp(kit->device->ops->name, "vulkan") == 0) == (i % 2 == 0);
}

static void expect_forged(void **state, const char *const *texts, size_t count, bool is_repaired)
{
    scene_kit kit;
    kit_scene scene;
    size_t cases = 0;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, WHOLE);
    for (size_t i = 0; i < 2 * count; i++) {
        const kit_way way = { methods[i % 2].id, methods[i % 2].feed, texts[i / 2] };
        const uint64_t all = scene.truth->nonempty_pixels;
        outcome seen;
        if (!has_turn(&kit, i / 2 + i))
            continue;
        if ((way.feed == FM_FEED_RASTER && !kit.device->caps.is_software) ||
            !measured(&seen, &scene, &way))
            continue; /* there fragments race */
        cases++;
        print_message("%s, %s: wrong %u, repaired %u, not repaired %u of %u pixels\n", way.method,
                      way.texts, (unsigned)seen.wrong, (unsigned)seen.repaired,
                      (unsigned)seen.unrepaired, (unsigned)all);
        assert_int_equal(seen.wrong, is_repaired ? 0 : all);
        assert_int_equal(seen.repaired, is_repaired ? all : 0);
        assert_int_equal(seen.unrepaired, is_repaired ? 0 : all);
    }
    assert_true(cases > 0 || !kit.device->caps.is_software);
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void one_and_two_damaged_records_are_repaired(void **state)
{
    static const char *const texts[] = { "k=8 forge=1", "k=8 forge=2", "k=12 forge=1",
                                         "k=12 forge=2 layout=image" };
    expect_forged(state, texts, sizeof texts / sizeof texts[0], true);
}

static void three_and_four_damaged_records_are_found(void **state)
{
    static const char *const texts[] = { "k=8 forge=3", "k=8 forge=4", "k=12 forge=3",
                                         "k=12 forge=4 layout=layer" };
    expect_forged(state, texts, sizeof texts / sizeof texts[0], false);
}

/* No sum misses a record that was pushed out: it is nearer than others that are there, or there is
 * room for it. */
static void a_record_that_was_wrongly_pushed_out_is_found(void **state)
{
    static const char *const texts[] = { "k=8 forge=evict", "k=5 forge=evict", "k=12 forge=evict" };
    expect_forged(state, texts, sizeof texts / sizeof texts[0], false);
}

/* Scenes and k: with and without more fragments than places. */
static const struct contended {
    const char *scene, *k;
} contended[] = {
    { "n=2", "8" },
    { "n=3", "8" },
    { "n=4", "8" },
    { "n=6 fragment_probability=0.4 seed=3", "8" },
    { "n=8 depths=coplanar", "8" },
    { "n=16 fragment_probability=0.25 seed=5", "2" },
    { "n=32 fragment_probability=0.1 seed=7", "3" },
    { "n=32", "8" },
    { "n=9", "1" },
};

/* What is not repaired is dropped: so pixels are wrong that were not repaired, and if there were
 * another one, a repair that was accepted would be wrong. */
static void no_repair_is_wrong_when_neighbours_contend(void **state)
{
    uint64_t repaired = 0, unrepaired = 0;
    scene_kit kit;
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < sizeof contended / sizeof contended[0]; i++) {
        char texts[160];
        kit_scene scene;
        outcome kb, seen;
        if (!has_turn(&kit, i))
            continue;
        snprintf(texts, sizeof texts,
                 "width_px=64 height_px=40 pixel_density=1 tessellation=4 order=random-cell %s",
                 contended[i].scene);
        kit_scene_open(&scene, &kit, texts);
        snprintf(texts, sizeof texts, "k=%s", contended[i].k);
        assert_true(measured(&kb, &scene, &(kit_way){ "kb", FM_FEED_COMPUTE_ADJACENT, texts }));
        snprintf(texts, sizeof texts, "k=%s unrepaired=drop", contended[i].k);
        assert_true(
            measured(&seen, &scene, &(kit_way){ "kb-mha", FM_FEED_COMPUTE_ADJACENT, texts }));
        print_message("%s, k=%s: of %u pixels kb has %u wrong; %u are repaired, %u found only\n",
                      contended[i].scene, contended[i].k, (unsigned)scene.truth->nonempty_pixels,
                      (unsigned)kb.wrong, (unsigned)seen.repaired, (unsigned)seen.unrepaired);
        assert_int_equal(seen.wrong, seen.unrepaired);
        repaired += seen.repaired;
        unrepaired += seen.unrepaired;
        kit_scene_close(&scene);
    }
    assert_true(!kit.device->caps.is_software || (repaired > 0 && unrepaired > 0));
    kit_close(&kit);
}

/* Mesa's software takes the fragments of a pixel one after the other. */
static void nothing_is_found_where_nothing_races(void **state)
{
    static const char *const texts[] = { "k=1", "k=5", "k=64" };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit,
                   "width_px=37 height_px=23 pixel_density=0.9 n=40 tessellation=7 "
                   "order=random-cell depths=coplanar fragment_probability=0.5");
    for (size_t i = 0; i < 6 && kit.device->caps.is_software; i++) {
        const kit_way way = { methods[i % 2].id, FM_FEED_RASTER, texts[i / 2] };
        outcome seen;
        assert_true(measured(&seen, &scene, &way));
        assert_int_equal(seen.wrong + seen.repaired + seen.unrepaired, 0);
    }
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(one_and_two_damaged_records_are_repaired),
        ON_VULKAN_AND_OSMESA(three_and_four_damaged_records_are_found),
        ON_VULKAN_AND_OSMESA(a_record_that_was_wrongly_pushed_out_is_found),
        ON_VULKAN_AND_OSMESA(no_repair_is_wrong_when_neighbours_contend),
        ON_VULKAN_AND_OSMESA(nothing_is_found_where_nothing_races),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
