/* Every method on every scene of scenes/hard/: exact where it says so, or lacking what its traits
 * say. Each scene meets every seventh method, in turn, on one feed, in turn, and scenes of many
 * layers are left out, since compiling takes the time; FRAGMARK_TEST_ALL=1: all on all feeds, but
 * peeling thousands of layers, a pass over all of them for each. */
#include <stdio.h>
#include <string.h>

#include "generators/generate.h"
#include "kit/scene_kit.h"
#include "scene/scene_file.h"

enum { LARGE_N = 100, PEELED_MAX = 2000, FEEDS = 4, METHODS_APART = 7 };
static const char folder[] = "hard/";

/* Feed `turn`, or the next that the method takes; none for methods that rasterise by themselves,
 * which take longest to compile: soup_test has scenes for them. */
static uint32_t feed_in_turn(const fm_method_desc *method, size_t turn)
{
    uint32_t feed = 0;
    for (size_t i = turn; i < turn + FEEDS && feed == 0; i++)
        feed = kit_feeds(method) & (uint32_t)FM_FEED_RASTER << i % FEEDS;
    return feed;
}

/* Of a pixel's truth, what goes with depth 1 or with ties. */
static uint64_t excusable(const fm_truth *truth, uint32_t traits)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    uint64_t count = 0;
    for (uint64_t pixel = 0; pixel < pixels; pixel++)
        for (uint64_t i = truth->offsets[pixel]; i < truth->offsets[pixel + 1]; i++) {
            const float depth = truth->fragments[i].depth;
            const bool is_tie =
                i > truth->offsets[pixel] && !(truth->fragments[i - 1].depth < depth);
            if (((traits & FM_TRAIT_LOSES_DEPTH_ONE) != 0 && depth >= 1.0f) ||
                ((traits & FM_TRAIT_LOSES_TIES) != 0 && is_tie))
                count++;
        }
    return count;
}

/* Exact, but for what the traits excuse: depth 1 and ties may be missing, and the colour of
 * fragments that were merged into one is nobody's. */
static void expect_declared(const fm_measurement *m, const fm_method_desc *method,
                            const fm_truth *truth, const char *where)
{
    const uint64_t excused = excusable(truth, method->traits);
    const bool merges = (method->traits & FM_TRAIT_LOSES_TIES) != 0;
    if (m->check.missing > excused || m->check.extra > (merges ? excused : 0) ||
        m->check.misordered + m->lost != 0)
        fail_msg("%s: missing %u and extra %u of %u excused, misordered %u, lost %u", where,
                 (unsigned)m->check.missing, (unsigned)m->check.extra, (unsigned)excused,
                 (unsigned)m->check.misordered, (unsigned)m->lost);
}

static bool is_judged(const fm_method_desc *method)
{
    const uint32_t free = FM_TRAIT_SORTED_INPUT | FM_TRAIT_RACY | FM_TRAIT_APPROXIMATE;
    return (method->traits & (FM_TRAIT_EXACT | FM_TRAIT_LOSES_TIES)) != 0 &&
           (method->traits & free) == 0;
}

/* The number says how fragments lie. */
static void check_method(kit_scene *scene, const fm_method_desc *method, uint32_t feeds,
                         size_t number, const char *name)
{
    for (uint32_t feed = FM_FEED_RASTER; feed <= FM_FEED_TRIANGLES; feed <<= 1, number++) {
        char texts[96];
        kit_memory_in_turn(texts, "k=8", method, number);
        const kit_way way = { method->id, feed, texts };
        fm_measurement m;
        char where[256], at[320];
        if ((feeds & feed) == 0 || !is_judged(method))
            continue;
        kit_tell(where, &way);
        snprintf(at, sizeof at, "%s: %s", name, where);
        if (kit_measure(&m, scene, &way)) {
            expect_declared(&m, method, kit_truth(scene, feed), at);
            if (m.bytes_allocated != m.bytes_predicted)
                fail_msg("%s: %llu bytes allocated, %llu predicted", at,
                         (unsigned long long)m.bytes_allocated,
                         (unsigned long long)m.bytes_predicted);
        }
        measurement_free(&m);
    }
}

static void check_scene(scene_kit *kit, size_t number, const char *name, const char *path)
{
    fm_settings settings;
    fm_scene *made = NULL;
    kit_scene scene;
    fm_error err = { .message = "" };
    if (scene_file_read(&settings, path, &err) != FM_OK ||
        settings_finish(&settings, &err) != FM_OK)
        fail_msg("%s", err.message);
    if (settings.n > LARGE_N && !kit_wants_all())
        return;
    if (scene_create(&made, &settings, &err) != FM_OK)
        fail_msg("%s: %s", name, err.message);
    kit_scene_take(&scene, kit, made);
    for (size_t i = 0; i < kit->plugins.count; i++) {
        const fm_method_desc *method = kit_method(kit, i);
        if (((number + i) % METHODS_APART != 0 && !kit_wants_all()) ||
            (method->family == FM_FAMILY_PEELING && settings.n > PEELED_MAX))
            continue;
        check_method(&scene, method,
                     kit_wants_all() ? kit_feeds(method) : feed_in_turn(method, number + i),
                     number + i / METHODS_APART, name);
    }
    kit_scene_close(&scene);
}

static void methods_are_as_declared_on_hard_scenes(void **state)
{
    scene_kit kit;
    fm_scene_names names = { 0 };
    fm_error err = { .message = "" };
    size_t found = 0;
    kit_open(&kit, device_of(state));
    if (scene_names_list(&names, &err) != FM_OK)
        fail_msg("%s", err.message);
    for (size_t i = 0; i < names.count; i++) {
        if (strncmp(names.names[i], folder, sizeof folder - 1) != 0)
            continue;
        found++;
        check_scene(&kit, i, names.names[i], names.paths[i]);
    }
    assert_true(found > 0);
    scene_names_free(&names);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(methods_are_as_declared_on_hard_scenes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
