/* Methods that pass over the scene again and again: how often, and what is handed over. */
#include <stdio.h>

#include "kit/scene_kit.h"

/* Flat layers of different depths, all over the viewport. */
#define SORTED   "width_px=19 height_px=11 pixel_density=1 tessellation=3 order=ascending"
#define SHUFFLED "width_px=19 height_px=11 pixel_density=1 tessellation=3 order=random-cell"

typedef struct expected {
    const char *scene, *method, *texts;
    uint32_t scene_passes;
} expected;

static void expect_passes(kit_scene *scene, const expected *e)
{
    fm_measurement m;
    char where[256];
    const kit_way way = { e->method, FM_FEED_RASTER, e->texts };
    kit_tell(where, &way);
    if (kit_measure(&m, scene, &way)) {
        if (m.check.missing + m.check.extra + m.check.misordered + m.lost != 0)
            fail_msg("%s, %s: missing %u, extra %u, misordered %u", e->scene, where,
                     (unsigned)m.check.missing, (unsigned)m.check.extra,
                     (unsigned)m.check.misordered);
        if (m.scene_passes != e->scene_passes)
            fail_msg("%s, %s: %u passes over the scene, not %u", e->scene, where, m.scene_passes,
                     e->scene_passes);
        assert_true(m.culled <= scene->truth->fragment_count);
        assert_int_equal(m.bytes_allocated, m.bytes_predicted);
        assert_true(m.bytes_used <= m.bytes_allocated);
    }
    measurement_free(&m);
}

/* Printed, for the test that is then skipped: its numbers are chance. */
static bool races_here(const scene_kit *kit, const char *method)
{
    const fm_plugin_entry *entry = plugin_list_find(&kit->plugins, method);
    const bool races = entry != NULL && entry->plugin != NULL &&
                       kit_races(kit, entry->plugin->method, FM_FEED_RASTER);
    if (races)
        print_message("skipped: %s races on %s\n", method, kit->device->caps.name);
    return races;
}

static void expect_all(void **state, const expected *cases, size_t count)
{
    scene_kit kit;
    kit_open(&kit, device_of(state));
    if (races_here(&kit, cases[0].method)) { /* a table has methods of one kind */
        kit_close(&kit);
        skip();
    }
    for (size_t i = 0; i < count; i++) {
        kit_scene scene;
        kit_scene_open(&scene, &kit, cases[i].scene);
        expect_passes(&scene, &cases[i]);
        kit_scene_close(&scene);
    }
    kit_close(&kit);
}

#define EXPECT_ALL(state, cases) expect_all(state, cases, sizeof(cases) / sizeof(cases)[0])

/* ceil(min(k, n) / slots), and one more to see that nothing is left where the last pass is full
 * though k would let more come. The S-buffer paper's 25 layers are four passes of eight. */
static void kb_takes_slots_in_each_pass(void **state)
{
    static const expected cases[] = {
        { SHUFFLED " n=25", "kb-multipass", "k=25", 4 },
        { SHUFFLED " n=25", "kb-multipass", "k=25 slots=16 layout=tile", 2 },
        { SHUFFLED " n=25", "kb-multipass", "k=64", 4 },
        { SHUFFLED " n=24", "kb-multipass", "k=24", 3 },
        { SHUFFLED " n=24", "kb-multipass", "k=64", 4 },
        { SHUFFLED " n=25", "kb-multipass", "k=10 slots=4 layout=layer", 3 },
        { SHUFFLED " n=25", "kb-multipass", "k=3", 1 },
        { SHUFFLED " n=5 fragment_probability=0.5", "kb-multipass", "k=5 slots=1", 5 },
        { SHUFFLED " n=0", "kb-multipass", "k=8", 1 },
    };
    EXPECT_ALL(state, cases);
}

/* The same of the k+-buffer, which keeps every pass apart from the next by a fragment and its
 * copies: none is lost where depths tie, or where fragments are copies of one another. */
static void kplus_takes_slots_in_each_pass(void **state)
{
    static const expected cases[] = {
        { SHUFFLED " n=25", "kplus-multipass", "k=25", 4 },
        { SHUFFLED " n=25 depths=coplanar", "kplus-multipass", "k=25 slots=16 layout=tile", 2 },
        { SHUFFLED " n=25 depths=coplanar colours=grey", "kplus-multipass", "k=64 slots=4", 7 },
        { SHUFFLED " n=24 depths=coplanar", "kplus-multipass", "k=24", 3 },
        { SHUFFLED " n=24", "kplus-multipass", "k=64", 4 },
        { SHUFFLED " n=8", "kplus-multipass", "k=64", 2 },
        { SHUFFLED " n=9", "kplus-multipass", "k=64", 2 },
        { SHUFFLED " n=25", "kplus-multipass", "k=10 slots=4 layout=layer", 3 },
        { SHUFFLED " n=25", "kplus-multipass", "k=3", 1 },
        { SHUFFLED " n=5 depths=coplanar", "kplus-multipass", "k=5 slots=1 layout=image", 5 },
        { SHUFFLED " n=1", "kplus-multipass", "k=1 slots=1", 1 },
        { SHUFFLED " n=0", "kplus-multipass", "k=8", 1 },
    };
    EXPECT_ALL(state, cases);
}

static void kb_packed_takes_one_pass(void **state)
{
    static const expected cases[] = {
        { SHUFFLED " n=25", "kb-packed", "k=1", 1 },
        { SHUFFLED " n=25", "kb-packed", "k=16", 1 },
        { SHUFFLED " n=25 fragment_probability=0.5", "kb-packed", "k=7 layout=tile", 1 },
        { SHUFFLED " n=5", "kb-packed", "k=8 layout=layer", 1 },
    };
    EXPECT_ALL(state, cases);
}

/* Right where layers arrive in order. */
static void routing_takes_samples_in_each_pass(void **state)
{
    static const expected cases[] = {
        { SORTED " n=25", "kb-sr-multipass", "k=25 samples=8", 4 },
        { SORTED " n=25", "kb-sr-multipass", "k=25", 7 },
        { SORTED " n=25 fragment_probability=0.5", "kb-sr-multipass", "k=6", 2 },
        { SORTED " n=12", "kb-sr-multipass", "k=64", 4 },
        { SORTED " n=3", "kb-sr-multipass", "k=3 samples=1", 3 },
        { SORTED " n=0", "kb-sr-multipass", "k=8", 1 },
    };
    EXPECT_ALL(state, cases);
}

/* One to find the ends; two layers in each, the nearest k in k; one to see that none is left. */
static void dual_stops_at_k(void **state)
{
    static const expected cases[] = {
        { SHUFFLED " n=25", "dual", "", 1 + 13 + 1 },
        { SHUFFLED " n=25", "dual-k", "k=4", 1 + 4 },
        { SHUFFLED " n=25", "dual-k", "k=1", 1 + 1 },
        { SHUFFLED " n=25", "dual-k", "k=20", 1 + 13 + 1 },
        { SHUFFLED " n=6", "dual-k", "k=4", 1 + 3 + 1 },
        { SHUFFLED " n=5", "dual-k", "k=4", 1 + 3 + 1 },
        { SHUFFLED " n=5", "dual-k", "k=5", 1 + 3 + 1 },
        { SHUFFLED " n=5", "dual-k", "k=3", 1 + 3 },
        { SHUFFLED " n=5", "dual-k", "k=8", 1 + 3 + 1 },
        { SHUFFLED " n=25", "f2b", "", 26 },
        { SHUFFLED " n=25", "f2b-k", "k=4", 4 },
    };
    EXPECT_ALL(state, cases);
}

/* Ten layers, five depths twice: the second of a pair at the boundary is lost, others are kept. */
static void ties_are_lost_at_the_boundary_only(void **state)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    if (races_here(&kit, "kb-multipass")) {
        kit_close(&kit);
        skip();
    }
    fm_scene *made = kit_quads_create(3, 2, 10);
    for (uint32_t i = 0; i < 10; i++)
        kit_quad(made, i, (fm_rect){ 0, 0, 3, 2 }, 0.125f + 0.125f * (float)(i / 2),
                 0x40000001u + i);
    kit_scene_take(&scene, &kit, made);
    static const struct {
        const char *texts;
        uint64_t missing; /* of a pixel */
    } cases[] = { { "k=10 slots=2", 0 }, { "k=10 slots=1", 5 }, { "k=10 slots=16", 0 } };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        fm_measurement m;
        assert_true(
            kit_measure(&m, &scene, &(kit_way){ "kb-multipass", FM_FEED_RASTER, cases[i].texts }));
        assert_int_equal(m.check.missing, cases[i].missing * 6);
        assert_int_equal(m.check.extra + m.check.misordered, 0);
        measurement_free(&m);
    }
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* Twelve layers: nearer and farther ones, and between them eight at one depth, of which some are
 * copies of one another. Whatever a pass has room for, none is lost and none comes twice. */
static void kplus_keeps_ties_and_copies_at_every_boundary(void **state)
{
    static const uint8_t depth[] = { 6, 4, 4, 2, 4, 4, 6, 4, 4, 2, 4, 4 };
    static const uint8_t colour[] = { 1, 7, 5, 1, 5, 7, 2, 5, 9, 1, 5, 0 };
    static const char *const slots[] = { "1", "2", "4", "8", "16" };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    fm_scene *made = kit_quads_create(3, 2, 12);
    for (uint32_t i = 0; i < 12; i++)
        kit_quad(made, i, (fm_rect){ 0, 0, 3, 2 }, 0.125f * (float)depth[i],
                 0x40000000u + colour[i]);
    kit_scene_take(&scene, &kit, made);
    for (size_t i = 0; i < sizeof slots / sizeof slots[0]; i++)
        for (uint32_t k = 5; k <= 13; k += 4) {
            const uint32_t feed = (i + k / 4) % 2 == 0 ? FM_FEED_RASTER : FM_FEED_COMPUTE_ADJACENT;
            char texts[32];
            fm_measurement m;
            snprintf(texts, sizeof texts, "k=%u slots=%s", (unsigned)k, slots[i]);
            if (kit_measure(&m, &scene, &(kit_way){ "kplus-multipass", feed, texts }) &&
                m.check.missing + m.check.extra + m.check.misordered + m.lost != 0)
                fail_msg("%s, feed %u: missing %u, extra %u, lost %u", texts, (unsigned)feed,
                         (unsigned)m.check.missing, (unsigned)m.check.extra, (unsigned)m.lost);
            measurement_free(&m);
        }
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* Ten layers, farthest first, by four samples: each pass keeps the first arrivals, the farthest of
 * which are then the boundary, and what is nearer never comes. */
static void routing_loses_what_arrives_behind_its_turn(void **state)
{
    scene_kit kit;
    kit_scene scene;
    fm_measurement m;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, "width_px=9 height_px=7 pixel_density=1 n=10 order=descending");
    assert_true(kit_measure(&m, &scene, &(kit_way){ "kb-sr-multipass", FM_FEED_RASTER, "k=10" }));
    assert_int_equal(m.check.captured, 4 * 63);
    assert_int_equal(m.check.missing, 6 * 63);
    assert_int_equal(m.scene_passes, 2);
    measurement_free(&m);
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(kb_takes_slots_in_each_pass),
        ON_VULKAN_AND_OSMESA(kplus_takes_slots_in_each_pass),
        ON_VULKAN_AND_OSMESA(kplus_keeps_ties_and_copies_at_every_boundary),
        ON_VULKAN_AND_OSMESA(kb_packed_takes_one_pass),
        ON_VULKAN_AND_OSMESA(routing_takes_samples_in_each_pass),
        ON_VULKAN_AND_OSMESA(dual_stops_at_k),
        ON_VULKAN_AND_OSMESA(ties_are_lost_at_the_boundary_only),
        ON_VULKAN_AND_OSMESA(routing_loses_what_arrives_behind_its_turn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
