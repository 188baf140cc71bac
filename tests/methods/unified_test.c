/* One method from the Z-buffer to the A-buffer, as the k+-buffer paper claims of its own: with k =
 * 1 the image of z-buffer, with k = n that of ab-array. */
#include <stdio.h>
#include <string.h>

#include "kit/scene_kit.h"
#include "model/feeds.h"

static const double image_tolerance = 1e-6;

static const char *const methods[] = { "kplus-array", "kplus-heap", "kplus-sb", "kplus-dynamic",
                                       "kplus-multipass" };
enum { METHOD_COUNT = sizeof methods / sizeof methods[0] };

/* No depth of a pixel occurs twice: of equal depths either may be the first. */
static const char *const scenes[] = {
    "width_px=37 height_px=23 n=0",
    "width_px=61 height_px=1 pixel_density=1 n=1 tessellation=2 alpha=1",
    "width_px=37 height_px=23 pixel_density=0.6 n=4 tessellation=3 order=random-cell "
    "depths=clustered alphas=random",
    "width_px=16 height_px=16 pixel_density=1 n=8 tessellation=4 order=descending depths=ulp",
    "width_px=29 height_px=31 pixel_density=0.5 n=40 tessellation=7 order=cell-major "
    "fragment_probability=0.5 seed=12",
    "width_px=33 height_px=9 pixel_density=0.7 n=64 tessellation=1 order=ascending",
};

/* The image of this way, to be destroyed; NULL: not supported. */
static fm_image *image_of(kit_scene *scene, const kit_way *way)
{
    fm_measurement m;
    kit_measure_times(&m, scene, way);
    fm_image *image = m.image;
    m.image = NULL;
    measurement_free(&m);
    return image;
}

/* Each method and feed on one of both devices, unless all is wanted. */
static bool has_turn(const scene_kit *kit, size_t method, uint32_t feed)
{
    const bool is_vulkan = strcmp(kit->device->ops->name, "vulkan") == 0;
    const bool is_even = feed == FM_FEED_RASTER || feed == FM_FEED_COMPUTE_PIXEL;
    return kit_wants_all() || (method % 2 == 0) == (is_even == is_vulkan);
}

static void expect_image_of(kit_scene *scene, const fm_image *as, const char *k, const char *what)
{
    for (size_t i = 0; i < METHOD_COUNT; i++)
        for (uint32_t feed = FM_FEED_RASTER; feed <= FM_FEED_COMPUTE_ADJACENT; feed <<= 1) {
            const kit_way way = { methods[i], feed, k };
            if (plugin_list_find(&scene->kit->plugins, methods[i]) == NULL ||
                !has_turn(scene->kit, i, feed))
                continue;
            fm_image *image = image_of(scene, &way);
            if (image != NULL && !(kit_apart(image, as) <= image_tolerance))
                fail_msg("%s, %s, %s: %.3g from the image of %s", methods[i], feed_name(feed), k,
                         kit_apart(image, as), what);
            image_destroy(image);
        }
}

typedef void scene_body(kit_scene *scene);

static void on_each_scene(void **state, scene_body *body)
{
    scene_kit kit;
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < METHOD_COUNT; i++)
        kit_has(&kit, methods[i]);
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        kit_scene scene;
        kit_scene_open(&scene, &kit, scenes[i]);
        assert_false(kit_has_ties(scene.truth));
        body(&scene);
        kit_scene_close(&scene);
    }
    kit_close(&kit);
}

static void expect_z_buffer(kit_scene *scene)
{
    fm_image *nearest = image_of(scene, &(kit_way){ "z-buffer", FM_FEED_RASTER, "" });
    assert_non_null(nearest);
    expect_image_of(scene, nearest, "k=1", "z-buffer");
    image_destroy(nearest);
}

static void one_kept_fragment_is_the_z_buffer(void **state)
{
    on_each_scene(state, expect_z_buffer);
}

static void expect_a_buffer(kit_scene *scene)
{
    char k[16];
    fm_image *all = image_of(scene, &(kit_way){ "ab-array", FM_FEED_RASTER, "" });
    assert_non_null(all);
    snprintf(k, sizeof k, "k=%u", scene->truth->n > 0 ? scene->truth->n : 1);
    expect_image_of(scene, all, k, "ab-array");
    image_destroy(all);
}

static void all_kept_fragments_are_the_a_buffer(void **state)
{
    on_each_scene(state, expect_a_buffer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(one_kept_fragment_is_the_z_buffer),
        ON_VULKAN_AND_OSMESA(all_kept_fragments_are_the_a_buffer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
