/* Pools of exactly the right size, one element short, and empty. A pool that grows ends with every
 * fragment, and is too small for nobody in silence; an array that cannot grow counts what it lost.
 * Which methods have which is read from their descriptors. */
#include <stdio.h>

#include "kit/scene_kit.h"

/* Every pixel has all layers, so that each size is a number. */
#define SCENE "width_px=16 height_px=12 pixel_density=1 tessellation=1 n=6 alpha=0.4 k=4"
enum { ALL_PIXELS = 16 * 12, LAYERS = 6, FRAGMENTS = ALL_PIXELS * LAYERS };

static bool grows(const fm_resource *resource)
{
    return resource->name != NULL && resource->sizing == FM_SIZE_GROW;
}

/* What a frame of the scene needs; 0: only the frame can tell. */
static uint64_t needed(const fm_resource *resource)
{
    const fm_extent *grown = &resource->grown;
    return grown->total != NULL
               ? 0
               : grown->constant + grown->per_pixel * ALL_PIXELS + grown->per_fragment * FRAGMENTS;
}

static void start_with(fm_method_desc *method, uint64_t missing, bool empty)
{
    for (size_t i = 0; i < FM_MAX_RESOURCES; i++) {
        fm_resource *resource = &method->resources[i];
        const uint64_t all = grows(resource) ? needed(resource) : 0;
        if (grows(resource))
            resource->extent = (fm_extent){ .constant = empty || all == 0 ? 0 : all - missing };
    }
}

static void make_exact(fm_method_desc *method)
{
    start_with(method, 0, false);
}

static void make_one_short(fm_method_desc *method)
{
    start_with(method, 1, false);
}

static void make_empty(fm_method_desc *method)
{
    start_with(method, 0, true);
}

static const struct {
    const char *name;
    void (*edit)(fm_method_desc *);
    bool is_enough;
} pools[] = { { "exact", make_exact, true },
              { "one short", make_one_short, false },
              { "empty", make_empty, false } };

/* The method's pool that grows; NULL: it has none. */
static const fm_resource *pool_of(const fm_method_desc *method)
{
    for (size_t i = 0; i < FM_MAX_RESOURCES; i++)
        if (grows(&method->resources[i]))
            return &method->resources[i];
    return NULL;
}

static void expect_growth(kit_scene *scene, const fm_method_desc *method, size_t pool,
                          const char *texts)
{
    fm_measurement m;
    const bool is_enough = pools[pool].is_enough && needed(pool_of(method)) != 0;
    scene->edit = pools[pool].edit;
    if (kit_measure(&m, scene, &(kit_way){ method->id, FM_FEED_RASTER, texts })) {
        if (m.check.missing + m.check.extra + m.check.misordered + m.lost != 0)
            fail_msg("%s, %s, pool %s: missing %u, lost %u", method->id, texts, pools[pool].name,
                     (unsigned)m.check.missing, (unsigned)m.lost);
        if ((m.frames_redone == 0) != is_enough)
            fail_msg("%s, %s, pool %s: %u frames were run again", method->id, texts,
                     pools[pool].name, (unsigned)m.frames_redone);
    }
    measurement_free(&m);
}

/* With each kind of nodes, where the method has a choice. */
static void expect_all_growth(kit_scene *scene, const fm_method_desc *method, size_t pool)
{
    const fm_option *node = option_find(method, "node");
    if (node == NULL)
        expect_growth(scene, method, pool, "");
    for (size_t i = 0; node != NULL && i < FM_MAX_OPTION_VALUES && node->values[i] != NULL; i++) {
        char texts[64];
        snprintf(texts, sizeof texts, "node=%s", node->values[i]);
        expect_growth(scene, method, pool, texts);
    }
}

static void pools_grow_until_no_fragment_is_missing(void **state)
{
    scene_kit kit;
    kit_scene scene;
    size_t found = 0;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, SCENE);
    for (size_t i = 0; i < kit.plugins.count; i++) {
        const fm_method_desc *method = kit_method(&kit, i);
        if (pool_of(method) == NULL)
            continue;
        found++;
        for (size_t pool = 0; pool < sizeof pools / sizeof pools[0]; pool++)
            expect_all_growth(&scene, method, pool);
    }
    assert_true(found > 0);
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* It has a place for each of n fragments of a pixel, and that n is a guess. */
static bool has_arrays_of_n(const fm_method_desc *method)
{
    for (size_t i = 0; i < FM_MAX_RESOURCES; i++)
        if (method->resources[i].name != NULL && method->resources[i].extent.per_pixel_n != 0)
            return true;
    return false;
}

/* Of an array of so many places, each pixel loses the others, and says so. */
static void expect_losses(kit_scene *scene, const fm_method_desc *method, uint32_t places)
{
    const uint32_t feed =
        (kit_feeds(method) & FM_FEED_RASTER) != 0 ? FM_FEED_RASTER : FM_FEED_TRIANGLES;
    fm_measurement m;
    scene->told_n = places;
    if (kit_measure(&m, scene, &(kit_way){ method->id, feed, "" })) {
        if (m.lost != (uint64_t)ALL_PIXELS * (LAYERS - places))
            fail_msg("%s, %u places: %u fragments lost", method->id, places, (unsigned)m.lost);
        if (m.check.missing > m.lost || (m.lost == 0 && m.check.extra + m.check.misordered != 0))
            fail_msg("%s, %u places: missing %u, lost %u", method->id, places,
                     (unsigned)m.check.missing, (unsigned)m.lost);
    }
    measurement_free(&m);
}

static void arrays_count_what_finds_no_room(void **state)
{
    scene_kit kit;
    kit_scene scene;
    size_t found = 0;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, SCENE);
    for (size_t i = 0; i < kit.plugins.count; i++) {
        const fm_method_desc *method = kit_method(&kit, i);
        if (!has_arrays_of_n(method))
            continue;
        found++;
        expect_losses(&scene, method, LAYERS);
        expect_losses(&scene, method, LAYERS - 1);
        expect_losses(&scene, method, 1);
    }
    assert_true(found > 0);
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(pools_grow_until_no_fragment_is_missing),
        ON_VULKAN_AND_OSMESA(arrays_count_what_finds_no_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
