/* How resolve sorts, by the options `sort` and `select`, must not change what is handed over:
 * pixels of every number of fragments around the sizes of registers, blocks and windows. Which
 * methods have the options is read from their descriptors. */
#include <stdio.h>

#include "kit/scene_kit.h"
#include "random_kit.h"

enum { HEIGHT = 3, COLUMNS = 16 };

/* Fragments of a column's pixels; the last one has n. */
static const uint32_t counts[COLUMNS - 1] = {
    0, 1, 2, 7, 8, 9, 15, 16, 17, 31, 32, 33, 63, 64, 65
};

static uint32_t count_of(uint32_t column, uint32_t n)
{
    return column < COLUMNS - 1 && counts[column] < n ? counts[column] : n;
}

/* Quad i covers the columns with more than i fragments. Some depths are equal. */
static fm_scene *make_columns(uint32_t n)
{
    fm_scene *scene = kit_quads_create(COLUMNS, HEIGHT, n);
    uint64_t random = n;
    for (uint32_t i = 0; i < n; i++) {
        uint32_t first = 0;
        while (count_of(first, n) <= i)
            first++;
        kit_quad(scene, i, (fm_rect){ first, 0, COLUMNS, HEIGHT },
                 (float)draw_in(&random, 0, 512) / 512.0f, 0x01020304u * (i % 60 + 1));
    }
    return scene;
}

static void expect_exact(kit_scene *scene, const fm_method_desc *method, const char *texts)
{
    const kit_way way = { method->id, FM_FEED_RASTER, texts };
    fm_measurement m;
    if (kit_measure(&m, scene, &way) &&
        m.check.missing + m.check.extra + m.check.misordered + m.lost != 0)
        fail_msg("%s, n = %u, %s: missing %u, extra %u, misordered %u, lost %u", method->id,
                 scene->scene->n, texts, (unsigned)m.check.missing, (unsigned)m.check.extra,
                 (unsigned)m.check.misordered, (unsigned)m.lost);
    measurement_free(&m);
}

static const fm_option *option_of(const fm_method_desc *method, const char *name)
{
    for (int i = 0; i < FM_MAX_OPTIONS && method->options[i].name != NULL; i++)
        if (strcmp(method->options[i].name, name) == 0)
            return &method->options[i];
    return NULL;
}

/* All values of the option but the default, which other tests have: each with the other keys, on
 * one of both devices. */
static size_t expect_values(kit_scene *scene, const char *option, const char *keys, uint32_t traits)
{
    const size_t is_vulkan = strcmp(scene->kit->device->ops->name, "vulkan") == 0;
    size_t found = 0;
    for (size_t i = 0; i < scene->kit->plugins.count; i++) {
        const fm_method_desc *method = kit_method(scene->kit, i);
        const fm_option *has = option_of(method, option);
        if (has == NULL || (method->traits & traits) != traits)
            continue;
        found++;
        for (size_t v = 1; v < FM_MAX_OPTION_VALUES && has->values[v] != NULL; v++) {
            const size_t number = found + v + scene->scene->n;
            char given[64], texts[96];
            snprintf(given, sizeof given, "%s=%s %s", option, has->values[v], keys);
            kit_memory_in_turn(texts, given, method, number);
            if (kit_wants_all() || number % 2 == is_vulkan)
                expect_exact(scene, method, texts);
        }
    }
    return found;
}

static void on_columns(void **state, uint32_t n, const char *option, const char *keys,
                       uint32_t traits)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_take(&scene, &kit, make_columns(n));
    assert_int_equal(scene.truth->fragment_count % HEIGHT, 0);
    assert_true(expect_values(&scene, option, keys, traits) > 0);
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* The last two are beyond what blocks merge, and beyond private arrays. */
static void every_sort_hands_over_all_in_order(void **state)
{
    static const uint32_t some[] = { 8, 33, 100 };
    static const uint32_t all[] = { 1, 8, 9, 16, 17, 31, 32, 33, 65, 200, 640, 641, 1024, 1025 };
    const uint32_t *n = kit_wants_all() ? all : some;
    for (size_t i = 0; i < (kit_wants_all() ? sizeof all : sizeof some) / sizeof *n; i++)
        on_columns(state, n[i], "sort", "", 0);
}

static void every_sort_hands_over_from_the_back_too(void **state)
{
    on_columns(state, 70, "sort", "composite=back-to-front", FM_TRAIT_EMITS_EITHER);
}

static void every_selection_has_the_k_nearest(void **state)
{
    static const char *const some[] = { "k=1", "k=7", "k=17" };
    static const char *const all[] = { "k=1",  "k=2",  "k=15", "k=16", "k=17",
                                       "k=63", "k=64", "k=65", "k=100" };
    const char *const *k = kit_wants_all() ? all : some;
    for (size_t i = 0; i < (kit_wants_all() ? sizeof all : sizeof some) / sizeof *k; i++)
        on_columns(state, 80, "select", k[i], 0);
}

static void every_selection_hands_over_from_the_back_too(void **state)
{
    on_columns(state, 70, "select", "k=9 composite=back-to-front", FM_TRAIT_EMITS_EITHER);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(every_sort_hands_over_all_in_order),
        ON_VULKAN_AND_OSMESA(every_sort_hands_over_from_the_back_too),
        ON_VULKAN_AND_OSMESA(every_selection_has_the_k_nearest),
        ON_VULKAN_AND_OSMESA(every_selection_hands_over_from_the_back_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
