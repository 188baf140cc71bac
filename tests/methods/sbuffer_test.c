/* The worked example of the S-buffer paper (Fig. 1) through the method's own shaders: three pixels
 * a row, three shared counters, so that the hash is the column. */
#include <stdio.h>

#include "instance/instance.h"
#include "kit/scene_kit.h"

enum { WIDTH = 3, HEIGHT = 6, EXAMPLE_PIXELS = WIDTH * HEIGHT, S = 3, F = 11 };

/* Fragments of each pixel, row by row. */
static const uint32_t counts[EXAMPLE_PIXELS] = { 0, 0, 0, 0, 2, 0, 0, 3, 2,
                                                 1, 1, 1, 0, 0, 1, 0, 0, 0 };
static const uint32_t sums[S] = { 1, 6, 4 }; /* C: fragments of each column */

/* One of the two mappings: C_pr, and where each used pixel's records begin; with inverse mapping
 * those of the last column go on downward. */
typedef struct example {
    const char *mapping;
    uint32_t prefix[S];
    uint32_t begins[EXAMPLE_PIXELS];
} example;

static const example forward = { "forward",
                                 { 0, 1, 7 },
                                 { 0, 0, 0, 0, 1, 0, 0, 3, 7, 0, 6, 9, 0, 0, 10, 0, 0, 0 } };
static const example inverse = { "inverse",
                                 { 0, 1, 0 },
                                 { 0, 0, 0, 0, 1, 0, 0, 3, 10, 0, 6, 8, 0, 0, 7, 0, 0, 0 } };

/* A quad of one pixel for each fragment. Its colour is the pixel's number, its depth tells it
 * apart. */
static fm_scene *make_scene(void)
{
    fm_scene *scene = kit_quads_create(WIDTH, HEIGHT, F);
    uint32_t quad = 0;
    for (uint32_t i = 0; i < EXAMPLE_PIXELS; i++)
        for (uint32_t layer = 0; layer < counts[i]; layer++) {
            const uint32_t x = i % WIDTH, y = i / WIDTH;
            kit_quad(scene, quad++, (fm_rect){ x, y, x + 1, y + 1 }, 0.75f - 0.125f * (float)layer,
                     0xFF000000u | i);
        }
    assert_int_equal(quad, F);
    return scene;
}

static void read_slot(void *words, size_t bytes, fm_device *device, fm_instance *instance,
                      const char *name)
{
    fm_error err = { .message = "" };
    const fm_slot *slot = instance_slot(instance, name);
    assert_non_null(slot);
    if (device->ops->buffer_read(device, slot->buffer, 0, words, bytes, &err) != FM_OK)
        fail_msg("%s", err.message);
}

/* Reading the pool downward for pixels of the second group. */
static void expect_records(uint32_t (*records)[2], const example *as, uint32_t pixel)
{
    const bool is_downward = strcmp(as->mapping, "inverse") == 0 && pixel % WIDTH == 2;
    for (uint32_t i = 0; i < counts[pixel]; i++) {
        const uint32_t at = is_downward ? as->begins[pixel] - i : as->begins[pixel] + i;
        assert_in_range(at, 0, F - 1);
        assert_int_equal(records[at][1], 0xFF000000u | pixel);
    }
}

/* What the last frame left: counters, shared counters, addresses behind the pixels' last records.
 */
static void expect_example(fm_device *device, fm_instance *instance, const example *as)
{
    uint32_t counters[EXAMPLE_PIXELS], addresses[EXAMPLE_PIXELS], bins[2 * S], records[F][2];
    assert_int_equal(instance_slot(instance, "fragments")->length, F);
    read_slot(counters, sizeof counters, device, instance, "counters");
    read_slot(addresses, sizeof addresses, device, instance, "addresses");
    read_slot(bins, sizeof bins, device, instance, "bins");
    read_slot(records, sizeof records, device, instance, "fragments");
    assert_memory_equal(counters, counts, sizeof counts);
    assert_memory_equal(bins, sums, sizeof sums);
    assert_memory_equal(bins + S, as->prefix, sizeof as->prefix);
    for (uint32_t i = 0; i < EXAMPLE_PIXELS; i++) {
        const bool is_downward = strcmp(as->mapping, "inverse") == 0 && i % WIDTH == 2;
        if (counts[i] == 0)
            continue;
        const uint32_t local = addresses[i] - counts[i];
        const uint32_t at = bins[S + i % WIDTH] + local;
        assert_int_equal(is_downward ? F - 1 - at : at, as->begins[i]);
        expect_records(records, as, i);
    }
}

static void check_example(fm_device *device, const example *as)
{
    scene_kit kit;
    kit_scene scene;
    fm_stage *stage = NULL;
    fm_instance *instance = NULL;
    fm_frame_result result;
    fm_error err = { .message = "" };
    fm_choice choices[] = { { .name = "counters", .value = "3" },
                            { .name = "mapping" },
                            { .name = "hash", .value = "paper" },
                            { .name = "per_pixel", .value = "rows" } };
    snprintf(choices[1].value, sizeof choices[1].value, "%s", as->mapping);
    kit_open(&kit, device);
    kit_scene_take(&scene, &kit, make_scene());
    assert_int_equal(scene.truth->fragment_count, F);
    const fm_plugin_entry *entry = plugin_list_find(&kit.plugins, "s-buffer");
    assert_true(entry != NULL && entry->plugin != NULL);
    fm_instance_desc desc = { .method = entry->plugin->method,
                              .folders = { entry->plugin->folder, kit.plugins.common_folder },
                              .settings = &scene.scene->settings,
                              .choices = choices,
                              .choice_count = sizeof choices / sizeof choices[0],
                              .fragments = F };
    fm_status status = stage_create(&stage, device, scene.scene, scene.truth, FM_FEED_RASTER, &err);
    desc.stage = stage;
    if (status == FM_OK)
        status = instance_create(&instance, &desc, &err);
    if (status == FM_OK)
        status = instance_frame(&result, instance, NULL, &err);
    if (status != FM_OK)
        fail_msg("%s", err.message);
    expect_example(device, instance, as);
    instance_destroy(instance);
    stage_destroy(stage);
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* The figure's addresses are those of row-major arrival, which software devices have: one
 * workgroup, lane by lane. Elsewhere a column's pixels may come in another order. */
static bool arrives_row_by_row(const fm_device *device)
{
    return device->caps.loop_limit > 0;
}

static void forward_mapping_places_as_in_the_paper(void **state)
{
    if (!arrives_row_by_row(device_of(state)))
        skip();
    check_example(device_of(state), &forward);
}

static void inverse_mapping_places_as_in_the_paper(void **state)
{
    if (!arrives_row_by_row(device_of(state)))
        skip();
    check_example(device_of(state), &inverse);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(forward_mapping_places_as_in_the_paper),
        ON_VULKAN_AND_OSMESA(inverse_mapping_places_as_in_the_paper),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
