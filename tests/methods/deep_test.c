/* Pixels with more fragments than a private array holds: A-buffers sort them where they lie. And
 * what compositing layer by layer, a pass each, rounds off. */
#include "kit/scene_kit.h"

/* Beyond SORT_PRIVATE_MAX of methods/common/sort_limit.glsl, and no multiple of a page or of two.
 */
#define DEEP "width_px=7 height_px=5 pixel_density=1 tessellation=1 n=701 "

static void expect_exact(kit_scene *scene, const kit_way *way)
{
    fm_measurement m;
    char where[256];
    kit_tell(where, way);
    if (kit_measure(&m, scene, way)) {
        const double allowed = image_rounding(scene->truth->n);
        if (m.check.missing + m.check.extra + m.check.misordered + m.lost != 0)
            fail_msg("%s: missing %u, extra %u, misordered %u, lost %u", where,
                     (unsigned)m.check.missing, (unsigned)m.check.extra,
                     (unsigned)m.check.misordered, (unsigned)m.lost);
        if (!(m.self_max_abs <= allowed))
            fail_msg("%s: the image is %.3g from its fragments, not %.3g", where, m.self_max_abs,
                     allowed);
        assert_int_equal(m.bytes_allocated, m.bytes_predicted);
    }
    measurement_free(&m);
}

static void a_buffers_sort_any_number_of_fragments(void **state)
{
    static const char *const scenes[] = {
        DEEP "order=descending fragment_probability=0.9 alpha=0.01",
        DEEP "order=random depths=coplanar alpha=0.01",
        DEEP "order=ascending alpha=0.01",
        DEEP "order=random alpha=0.01",
    };
    static const uint32_t feeds[] = { FM_FEED_RASTER, FM_FEED_COMPUTE_ADJACENT,
                                      FM_FEED_COMPUTE_LAYER, FM_FEED_TRIANGLES };
    _Static_assert(sizeof scenes / sizeof scenes[0] == sizeof feeds / sizeof feeds[0],
                   "a feed for each scene");
    scene_kit kit;
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        kit_scene scene;
        kit_scene_open(&scene, &kit, scenes[i]);
        for (size_t at = 0; at < kit.plugins.count; at++) {
            const fm_method_desc *method = kit_method(&kit, at);
            if (method->keeps == FM_KEEPS_ALL && (method->traits & FM_TRAIT_EXACT) != 0 &&
                (kit_feeds(method) & feeds[i]) != 0)
                expect_exact(&scene, &(kit_way){ method->id, feeds[i], "" });
        }
        kit_scene_close(&scene);
    }
    kit_close(&kit);
}

/* Within the iterations that Mesa's software rasterisers allow an invocation. */
static void three_thousand_fragments_are_sorted_where_they_lie(void **state)
{
    static const kit_way ways[] = { { "ab-array", FM_FEED_RASTER, "" },
                                    { "ab-ll-paged", FM_FEED_RASTER, "" },
                                    { "ab-ll", FM_FEED_RASTER, "node=split" },
                                    { "ab-ll", FM_FEED_RASTER, "node=whole" } };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit,
                   "width_px=2 height_px=1 pixel_density=1 tessellation=1 n=3000 alpha=0.005");
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++)
        expect_exact(&scene, &ways[i]);
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* 80 000 iterations in each fragment: a driver that ends them is told of, with its limit; one that
 * does not is right. */
static void loops_that_a_driver_ends_are_refused(void **state)
{
    static const kit_mistake mistakes[] = {
        { "raster_main.glsl", "bool is_alive = true;",
          "uint spent = 0u; FM_LOOP while (spent < fm_two * 40000u) ++spent;"
          "bool is_alive = spent > 0u;" },
        { "emit.glsl", "bool is_first = ",
          "uint spent = 0u; FM_LOOP while (spent < fm_two * 40000u) ++spent;"
          "bool is_first = spent > 0u && " },
    };
    static const char *const told[] = { "pass 'store'", "pass 'resolve'" };
    for (size_t i = 0; i < sizeof mistakes / sizeof mistakes[0]; i++) {
        scene_kit kit;
        kit_scene scene;
        fm_measurement m;
        fm_error err = { 0 };
        kit_open(&kit, device_of(state));
        kit_scene_open(&scene, &kit, "width_px=2 height_px=1 n=20 tessellation=1 k=700");
        kit_break(&kit, &mistakes[i]); /* not for the truth */
        const fm_status status =
            kit_try(&m, &scene, &(kit_way){ "kb", FM_FEED_RASTER, "" }, true, &err);
        if (kit.device->caps.loop_limit == 0) {
            assert_int_equal(status, FM_OK);
        } else {
            assert_int_equal(status, FM_UNSUPPORTED);
            assert_int_equal(err.reason, FM_REASON_LOOPS);
            assert_non_null(strstr(err.message, told[i]));
            assert_non_null(strstr(err.message, "n = 20, k = 700"));
            assert_non_null(strstr(err.message, "65535"));
        }
        measurement_free(&m);
        kit_scene_close(&scene);
        kit_close(&kit);
    }
}

/* Were A kept between passes and not 1 - A, what shows would never
 * fall below an ulp of 1, and each of the layers behind would still add to the picture. */
static void layers_behind_an_opaque_picture_add_nothing(void **state)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit,
                   "width_px=3 height_px=2 pixel_density=1 tessellation=1 n=400 alpha=0.3");
    expect_exact(&scene, &(kit_way){ "f2b", FM_FEED_RASTER, "" });
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(a_buffers_sort_any_number_of_fragments),
        ON_VULKAN_AND_OSMESA(three_thousand_fragments_are_sorted_where_they_lie),
        ON_VULKAN_AND_OSMESA(loops_that_a_driver_ends_are_refused),
        ON_VULKAN_AND_OSMESA(layers_behind_an_opaque_picture_add_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
