/* The scenes of scenes/hard/ are what they say: each has its reason and its answer as a text, and
 * the device's truth has the fragments that the answer names. Each scene meets one device, in turn,
 * and the largest none; FRAGMARK_TEST_ALL=1: all on all. */
#include <stdio.h>
#include <string.h>

#include "generators/generate.h"
#include "kit/scene_kit.h"
#include "scene/scene_file.h"

static const char folder[] = "hard/";
enum { SMALL_RECT = 30 * 19, FULL = 61 * 37, ANY = -1, LARGE_N = 3000 };

typedef enum ties { NO_TIES, SOME_TIES, ALL_TIES, ANY_TIES } ties;

/* What a scene's truth has. */
static const struct {
    const char *name;
    int n;       /* most fragments of a pixel */
    int covered; /* pixels with any; ANY: the silhouette's */
    ties ties;   /* of neighbours in a pixel's order */
} answers[] = {
    { "ascending", 40, SMALL_RECT, NO_TIES },
    { "coplanar", 12, SMALL_RECT, ALL_TIES },
    { "deep-10000", 10000, 1, NO_TIES },
    { "deep-65536", 65536, 1, NO_TIES },
    { "deep-pixel", 500, 1, NO_TIES },
    { "denormal", 24, SMALL_RECT, ANY_TIES },
    { "descending", 40, SMALL_RECT, NO_TIES },
    { "duplicates", 64, ANY, ALL_TIES },
    { "ends", 7, ANY, NO_TIES },
    { "ends-reversed", 7, ANY, NO_TIES },
    { "equal-pairs", 15, SMALL_RECT, SOME_TIES },
    { "faint", 2000, ANY, NO_TIES },
    { "far-origin", 12, ANY, ANY_TIES },
    { "far-plane", 96, SMALL_RECT, SOME_TIES },
    { "far-plane-reversed", 96, SMALL_RECT, NO_TIES },
    { "k-layers", 8, SMALL_RECT, NO_TIES },
    { "k-less-1", 7, SMALL_RECT, NO_TIES },
    { "k-plus-1", 9, SMALL_RECT, NO_TIES },
    { "mixed-alphas", 64, SMALL_RECT, NO_TIES },
    { "no-layers", 0, 0, NO_TIES },
    { "one-layer", 1, SMALL_RECT, NO_TIES },
    { "one-pixel", 40, 1, NO_TIES },
    { "opaque", 12, SMALL_RECT, NO_TIES },
    { "prime", 12, ANY, NO_TIES },
    { "shells", 12, ANY, ANY_TIES },
    { "shells-reversed", 12, ANY, ANY_TIES },
    { "slivers", 1, FULL, NO_TIES },
    { "sloped", 16, SMALL_RECT, ANY_TIES },
    { "step24", 24, SMALL_RECT, NO_TIES },
    { "step32", 24, SMALL_RECT, NO_TIES },
    { "transparent", 12, SMALL_RECT, NO_TIES },
    { "ulp", 24, SMALL_RECT, NO_TIES },
};

static void open_scene(kit_scene *scene, scene_kit *kit, const char *name, const char *path)
{
    fm_settings settings;
    fm_scene *made = NULL;
    fm_error err = { .message = "" };
    if (scene_file_read(&settings, path, &err) != FM_OK ||
        settings_finish(&settings, &err) != FM_OK || scene_create(&made, &settings, &err) != FM_OK)
        fail_msg("%s: %s", name, err.message);
    kit_scene_take(scene, kit, made);
}

/* Which pairs of neighbours in a pixel's order tie. */
static ties find_ties(const fm_truth *truth)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    uint64_t tied = 0, pairs = 0;
    for (uint64_t pixel = 0; pixel < pixels; pixel++)
        for (uint64_t i = truth->offsets[pixel] + 1; i < truth->offsets[pixel + 1]; i++) {
            tied += !(truth->fragments[i - 1].depth < truth->fragments[i].depth);
            pairs++;
        }
    return tied == 0 ? NO_TIES : tied < pairs ? SOME_TIES : ALL_TIES;
}

static void expect_answer(const fm_truth *truth, size_t answer)
{
    const char *name = answers[answer].name;
    if (truth->n != (uint32_t)answers[answer].n)
        fail_msg("%s: %u fragments in a pixel, not %d", name, truth->n, answers[answer].n);
    if (answers[answer].covered != ANY &&
        truth->nonempty_pixels != (uint64_t)answers[answer].covered)
        fail_msg("%s: %u pixels have fragments, not %d", name, (unsigned)truth->nonempty_pixels,
                 answers[answer].covered);
    if (answers[answer].ties != ANY_TIES && find_ties(truth) != answers[answer].ties)
        fail_msg("%s: ties are %d, not %d", name, (int)find_ties(truth), (int)answers[answer].ties);
}

static size_t answer_of(const char *name)
{
    size_t i = 0;
    while (i < sizeof answers / sizeof answers[0] && strcmp(answers[i].name, name) != 0)
        i++;
    if (i == sizeof answers / sizeof answers[0])
        fail_msg("%s: this test has no answer for it", name);
    return i;
}

static void expect_texts(const char *name, const char *path)
{
    char *bytes = NULL;
    size_t count;
    assert_int_equal(text_read_file(&bytes, &count, path, 1 << 16, NULL), FM_OK);
    if (strstr(bytes, "\nwhy: ") == NULL || strstr(bytes, "\nanswer: ") == NULL)
        fail_msg("%s: no reason ('why') or no answer", name);
    free(bytes);
}

static void check_scene(scene_kit *kit, size_t turn, const char *name, const char *path)
{
    const size_t answer = answer_of(name), device = strcmp(kit->device->ops->name, "osmesa") == 0;
    kit_scene scene;
    expect_texts(name, path);
    if (!kit_wants_all() && (turn % 2 != device || answers[answer].n > LARGE_N))
        return;
    open_scene(&scene, kit, name, path);
    expect_answer(scene.truth, answer);
    kit_scene_close(&scene);
}

static void each_scene_is_what_its_answer_says(void **state)
{
    scene_kit kit;
    fm_scene_names names = { 0 };
    size_t found = 0;
    kit_open(&kit, device_of(state));
    assert_int_equal(scene_names_list(&names, NULL), FM_OK);
    for (size_t i = 0; i < names.count; i++)
        if (strncmp(names.names[i], folder, sizeof folder - 1) == 0)
            check_scene(&kit, found++, names.names[i] + sizeof folder - 1, names.paths[i]);
    assert_int_equal(found, sizeof answers / sizeof answers[0]);
    scene_names_free(&names);
    kit_close(&kit);
}

static void open_named(kit_scene *scene, scene_kit *kit, const char *name)
{
    fm_scene_names names = { 0 };
    assert_int_equal(scene_names_list(&names, NULL), FM_OK);
    for (size_t i = 0; i < names.count; i++)
        if (strcmp(names.names[i], name) == 0)
            open_scene(scene, kit, name, names.paths[i]);
    scene_names_free(&names);
}

/* Two scenes on one feed: as many fragments in each pixel, of the same colours in the same order
 * but for ties; with `with_depths` of the same depths. */
static void expect_alike(scene_kit *kit, const char *first, const char *second, uint32_t feed,
                         bool with_depths)
{
    kit_scene a = { .kit = NULL }, b = { .kit = NULL };
    open_named(&a, kit, first);
    open_named(&b, kit, second);
    const fm_truth *left = kit_truth(&a, feed), *right = kit_truth(&b, feed);
    assert_int_equal(left->fragment_count, right->fragment_count);
    assert_true(left->fragment_count > 0);
    assert_memory_equal(left->offsets, right->offsets, ((uint64_t)FULL + 1) * 8);
    for (uint64_t i = 0; i < left->fragment_count; i++) {
        if (left->fragments[i].colour != right->fragments[i].colour)
            fail_msg("%s, %s: fragment %u", first, second, (unsigned)i);
        if (with_depths)
            assert_memory_equal(&left->fragments[i], &right->fragments[i], sizeof(fm_fragment));
    }
    kit_scene_close(&a);
    kit_scene_close(&b);
}

/* Whatever is rasterised of them is the truth; Mesa's software flushes them. */
static void denormal_depths_are_flushed_by_software(void **state)
{
    scene_kit kit;
    kit_scene scene = { .kit = NULL };
    kit_open(&kit, device_of(state));
    open_named(&scene, &kit, "hard/denormal");
    assert_int_equal(find_ties(scene.truth), kit.device->caps.is_software ? ALL_TIES : NO_TIES);
    assert_int_equal(find_ties(kit_truth(&scene, FM_FEED_TRIANGLES)), ALL_TIES);
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void far_from_the_origin_nothing_changes(void **state)
{
    scene_kit kit;
    kit_open(&kit, device_of(state));
    expect_alike(&kit, "hard/shells", "hard/far-origin", FM_FEED_RASTER, true);
    expect_alike(&kit, "hard/shells", "hard/far-origin", FM_FEED_TRIANGLES, true);
    kit_close(&kit);
}

static void a_reversed_projection_keeps_the_order(void **state)
{
    scene_kit kit;
    kit_open(&kit, device_of(state));
    expect_alike(&kit, "hard/shells", "hard/shells-reversed", FM_FEED_RASTER, false);
    expect_alike(&kit, "hard/shells", "hard/shells-reversed", FM_FEED_TRIANGLES, false);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(each_scene_is_what_its_answer_says),
        ON_VULKAN_AND_OSMESA(denormal_depths_are_flushed_by_software),
        ON_VULKAN_AND_OSMESA(far_from_the_origin_nothing_changes),
        ON_VULKAN_AND_OSMESA(a_reversed_projection_keeps_the_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
