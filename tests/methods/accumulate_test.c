/* Keys `accumulate` and `composite` on devices: images hold what the compositor of accumulate_kit.h
 * says of truth's fragments. */
#include <stdio.h>

#include "kit/accumulate_kit.h"
#include "kit/scene_kit.h"
#include "worker/verdict.h"

#define SCENE "width_px=9 height_px=7 pixel_density=1 tessellation=1 depths=uniform "
#define FAINT SCENE "n=300 alpha=0.02 order=random"
#define MIXED SCENE "n=12 alphas=random alpha=1 order=random fragment_probability=0.8"

static const char *const formats[] = { "float32", "float16", "unorm8" };
static const char *const directions[] = { "front-to-back", "back-to-front" };

/* Quotients by 255 may differ in their last bit, and so may all that float32 does. */
static double apart_allowed(fm_accumulate format, uint32_t n)
{
    return format == FM_ACCUMULATE_FLOAT16 ? 0 : image_rounding(n);
}

static void expect_accumulated(const fm_measurement *m, const kit_scene *scene,
                               fm_rounding rounding, const char *where)
{
    const fm_truth *truth = scene->truth;
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    float rgba[4];
    for (uint64_t pixel = 0; pixel < pixels; pixel++) {
        const uint64_t first = truth->offsets[pixel];
        accumulate_pixel(rgba, rounding, &truth->fragments[first],
                         (uint32_t)(truth->offsets[pixel + 1] - first));
        for (uint64_t c = 0; c < 4; c++) {
            const double is = (double)m->image->rgba[4 * pixel + c];
            if (!(fabs(is - (double)rgba[c]) <= apart_allowed(rounding.accumulate, truth->n)))
                fail_msg("%s: pixel %u, channel %u: %.9g, not %.9g", where, (unsigned)pixel,
                         (unsigned)c, is, (double)rgba[c]);
        }
    }
}

static void tell_way(char texts[64], fm_rounding rounding)
{
    snprintf(texts, 64, "accumulate=%s composite=%s", formats[rounding.accumulate],
             directions[rounding.composite]);
}

/* With its fragments checked, which compiles the method once more, and the verdict on them. */
static void expect_way(kit_scene *scene, const char *method, uint32_t feed, fm_rounding rounding,
                       bool with_verdict)
{
    char texts[64], where[256];
    fm_measurement m;
    fm_error err = { .message = "" };
    tell_way(texts, rounding);
    const kit_way way = { .method = method, .feed = feed, .texts = texts };
    kit_tell(where, &way);
    if (with_verdict ? kit_measure(&m, scene, &way) : kit_measure_times(&m, scene, &way)) {
        expect_accumulated(&m, scene, rounding, where);
        if (with_verdict && verdict_is_wrong(&err, &m, FM_TRAIT_EXACT, scene->truth->n))
            fail_msg("%s: %s", where, err.message);
    }
    measurement_free(&m);
}

/* In one pass, and a layer a pass, where what is kept lies in memory between them. */
static void images_hold_what_the_host_accumulates(void **state)
{
    scene_kit kit;
    kit_scene faint, mixed;
    kit_open(&kit, device_of(state));
    kit_scene_open(&faint, &kit, FAINT);
    kit_scene_open(&mixed, &kit, MIXED);
    for (unsigned format = 0; format < FM_ACCUMULATE_COUNT; format++) {
        const fm_rounding front = { format, FM_COMPOSITE_FRONT_TO_BACK };
        const fm_rounding back = { format, FM_COMPOSITE_BACK_TO_FRONT };
        expect_way(&faint, "exact", FM_FEED_RASTER, front, true);
        expect_way(&mixed, "exact", FM_FEED_COMPUTE_LAYER, back, true);
        expect_way(&mixed, "f2b", FM_FEED_RASTER, front, false);
    }
    kit_scene_close(&faint);
    kit_scene_close(&mixed);
    kit_close(&kit);
}

/* Whoever has the trait hands over the far ones first: else back to front gives another picture. A
 * part of the methods, unless all are asked for. */
static void methods_with_the_trait_emit_back_to_front(void **state)
{
    const fm_rounding back = { FM_ACCUMULATE_FLOAT16, FM_COMPOSITE_BACK_TO_FRONT };
    scene_kit kit;
    kit_scene scene;
    unsigned seen = 0;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, SCENE "n=6 alphas=random alpha=1 order=ascending");
    for (size_t i = 0; i < kit.plugins.count; i++) {
        const fm_method_desc *method = kit_method(&kit, i);
        if ((method->traits & FM_TRAIT_EMITS_EITHER) == 0 || (i % 4 != 1 && !kit_wants_all()))
            continue;
        expect_way(&scene, method->id,
                   (method->feeds & FM_FEED_TRIANGLES) != 0 ? FM_FEED_TRIANGLES : FM_FEED_RASTER,
                   back, false);
        seen++;
    }
    assert_true(seen >= (kit_wants_all() ? 16 : 3));
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* From both ends: three roundings meet, and what is left is a half. */
static void both_ends_and_their_sum_are_rounded(void **state)
{
    const kit_way way = { "dual", FM_FEED_RASTER, "accumulate=float16" };
    scene_kit kit;
    kit_scene scene;
    fm_measurement m;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, MIXED);
    if (kit_measure(&m, &scene, &way)) {
        for (uint64_t i = 0; i < 4ull * m.image->width_px * m.image->height_px; i++) {
            const float kept = i % 4 == 3 ? 1 - m.image->rgba[i] : m.image->rgba[i];
            if (kept < round_half(kept) || kept > round_half(kept))
                fail_msg("float %u is %.9g", (unsigned)i, (double)kept);
        }
        assert_true(m.self_max_abs > 1e-6 && m.self_max_abs < 0.01);
    }
    measurement_free(&m);
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* Three bits behind the first one in place of ten. */
static void coarser_rounding_is_a_wrong_image(void **state)
{
    static const kit_mistake mistake = { "accumulate.glsl", "0xFFFFE000u", "0xFFF00000u" };
    const kit_way way = { "exact", FM_FEED_RASTER, "accumulate=float16" };
    scene_kit kit;
    kit_scene scene;
    fm_measurement m;
    fm_error err = { .message = "" };
    kit_open(&kit, device_of(state));
    kit_break(&kit, &mistake);
    kit_scene_open(&scene, &kit, SCENE "n=3 alpha=0.5");
    if (kit_measure(&m, &scene, &way)) {
        assert_true(verdict_is_wrong(&err, &m, FM_TRAIT_EXACT, 3));
        assert_non_null(strstr(err.message, "from its own fragments"));
    }
    measurement_free(&m);
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(images_hold_what_the_host_accumulates),
        cmocka_unit_test_setup_teardown(methods_with_the_trait_emit_back_to_front, open_vulkan,
                                        close_opened),
        ON_VULKAN_AND_OSMESA(both_ends_and_their_sum_are_rounded),
        cmocka_unit_test_setup_teardown(coarser_rounding_is_a_wrong_image, open_vulkan,
                                        close_opened),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
