/* Truth as a device captures it, against the closed form of layer scenes, and its file. */
#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "kit/scene_kit.h"
#include "scene/layers.h"
#include "truth/kept_file.h"

#define SMALL "width_px=37 height_px=23 pixel_density=0.7 "

static const char *const orders[] = { "random", "random-cell", "ascending", "descending",
                                      "cell-major" };
static const char *const flat_depths[] = { "uniform", "clustered", "coplanar",
                                           "ulp",     "equal",     "step24",
                                           "ends",    "step32",    "projected depth=reversed" };
static const char *const probabilities[] = { "0", "0.5", "1" };

enum { LAYERS = 12 };
/* A rasteriser interpolates from terms near 1: its error does not shrink with the depth. */
static const double sloped_steps = 2;

static int by_depth_then_colour(const void *a, const void *b)
{
    const fm_fragment *left = a, *right = b;
    if (left->depth < right->depth || left->depth > right->depth)
        return left->depth > right->depth ? 1 : -1;
    return (left->colour > right->colour) - (left->colour < right->colour);
}

/* Representable steps between two depths, neither negative. */
static uint32_t ulps(float a, float b)
{
    uint32_t left, right;
    memcpy(&left, &a, sizeof left);
    memcpy(&right, &b, sizeof right);
    return left > right ? left - right : right - left;
}

/* How far captured depths of equal rank are from the closed form. */
typedef struct distance {
    uint32_t ulps;
    double steps; /* of 2^-24, the ulp of depths from 0.5 on */
} distance;

/* Compares all pixels. Colours must agree unless rounding may have swapped two depths. */
static void measure_distance(distance *most, const kit_scene *scene, const char *texts)
{
    const fm_truth *truth = scene->truth;
    for (uint32_t pixel = 0; pixel < truth->width_px * truth->height_px; pixel++) {
        fm_fragment expected[LAYERS], captured[LAYERS];
        const uint32_t count = layers_fragments(expected, scene->scene, pixel % truth->width_px,
                                                pixel / truth->width_px);
        const uint64_t first = truth->offsets[pixel];
        if (truth->offsets[pixel + 1] - first != count)
            fail_msg("%s: pixel %u has %u fragments, not %u", texts, pixel,
                     (unsigned)(truth->offsets[pixel + 1] - first), count);
        memcpy(captured, truth->fragments + first, count * sizeof captured[0]);
        qsort(expected, count, sizeof expected[0], by_depth_then_colour);
        qsort(captured, count, sizeof captured[0], by_depth_then_colour);
        for (uint32_t i = 0; i < count; i++) {
            const uint32_t apart = ulps(expected[i].depth, captured[i].depth);
            const double steps =
                fabs((double)expected[i].depth - (double)captured[i].depth) * (1 << 24);
            most->ulps = apart > most->ulps ? apart : most->ulps;
            most->steps = steps > most->steps ? steps : most->steps;
            if (apart == 0 && expected[i].colour != captured[i].colour)
                fail_msg("%s: pixel %u: colour %u is wrong", texts, pixel, i);
        }
    }
}

static void flat_layers_are_captured_as_the_closed_form_says(void **state)
{
    scene_kit kit;
    char texts[256];
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < sizeof orders / sizeof orders[0]; i++)
        for (size_t j = 0; j < sizeof flat_depths / sizeof flat_depths[0]; j++) {
            kit_scene scene;
            /* Each order and each distribution meet each probability. */
            snprintf(texts, sizeof texts,
                     SMALL "n=%d tessellation=%zu order=%s depths=%s fragment_probability=%s",
                     LAYERS, i + j + 1, orders[i], flat_depths[j], probabilities[(i + j) % 3]);
            kit_scene_open(&scene, &kit, texts);
            distance most = { .ulps = 0 };
            measure_distance(&most, &scene, texts);
            if (most.ulps != 0)
                fail_msg("%s: depths differ", texts);
            assert_null(scene.truth->arrival);
            kit_scene_close(&scene);
        }
    kit_close(&kit);
}

/* Bands after the first come from the closed form: a method that the device runs must find the same
 * fragments in them. */
static void truth_of_several_bands_is_what_methods_capture(void **state)
{
    const uint64_t band = 8 << 20;
    const kit_way way = { "kplus-array", FM_FEED_RASTER, "k=4" };
    scene_kit kit;
    kit_scene scene;
    fm_measurement m;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit,
                   "width_px=61 height_px=97 pixel_density=1 n=3200 tessellation=3 "
                   "fragment_probability=0.5 order=random-cell");
    assert_true(scene.truth->fragment_count > band);
    if (kit_measure(&m, &scene, &way)) {
        assert_int_equal(m.check.captured, truth_kept(scene.truth, 4));
        assert_int_equal(m.check.missing + m.check.extra + m.check.misordered, 0);
    }
    measurement_free(&m);
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* What was forgotten is read from the file again. */
static void forgotten_fragments_come_back(void **state)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, SMALL "n=64");
    const uint64_t before = truth_digest(scene.truth);
    truth_forget(scene.truth, 0, 37ull * 23);
    truth_forget(scene.truth, 100, 101);
    assert_true(truth_digest(scene.truth) == before);
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void sloped_layers_are_captured_within_two_steps(void **state)
{
    scene_kit kit;
    char texts[256];
    distance most = { .ulps = 0 };
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < sizeof orders / sizeof orders[0]; i++) {
        kit_scene scene;
        snprintf(texts, sizeof texts,
                 SMALL "n=%d tessellation=%zu order=%s depths=sloped fragment_probability=%s",
                 LAYERS, 1 + 2 * i, orders[i], probabilities[1 + i % 2]);
        kit_scene_open(&scene, &kit, texts);
        measure_distance(&most, &scene, texts);
        assert_non_null(scene.truth->arrival);
        kit_scene_close(&scene);
    }
    print_message("sloped layers: at most %.3g steps of 2^-24 (%u ulp) from the closed form\n",
                  most.steps, most.ulps);
    assert_true(most.steps <= sloped_steps);
    kit_close(&kit);
}

static void sums_of_a_truth_agree_with_its_lists(void **state)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, SMALL "n=12 fragment_probability=0.5");
    uint64_t nonempty = 0, kept = 0;
    uint32_t n = 0;
    for (uint32_t pixel = 0; pixel < 37 * 23; pixel++) {
        const uint32_t count =
            (uint32_t)(scene.truth->offsets[pixel + 1] - scene.truth->offsets[pixel]);
        nonempty += count > 0;
        kept += count < 5 ? count : 5;
        n = count > n ? count : n;
    }
    assert_int_equal(scene.truth->nonempty_pixels, nonempty);
    assert_int_equal(scene.truth->n, n);
    assert_int_equal(truth_kept(scene.truth, 5), kept);
    assert_int_equal(truth_kept(scene.truth, 0), scene.truth->fragment_count);
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void vulkan_and_osmesa_capture_the_same_flat_layers(void **state)
{
    static const char texts[] = SMALL "n=12 tessellation=5 order=random-cell "
                                      "depths=coplanar fragment_probability=0.5";
    const fm_device_desc desc = { .selector = NULL };
    fm_device *vulkan = open_if_there("vulkan", &desc), *osmesa = open_if_there("osmesa", &desc);
    (void)state;
    if (vulkan == NULL || osmesa == NULL) {
        device_close(vulkan);
        device_close(osmesa);
        skip();
    }
    scene_kit one, other;
    kit_scene left, right;
    kit_open(&one, vulkan);
    kit_open(&other, osmesa);
    kit_scene_open(&left, &one, texts);
    kit_scene_open(&right, &other, texts);
    assert_int_equal(left.truth->map_bytes, right.truth->map_bytes);
    assert_memory_equal(left.truth->map, right.truth->map, left.truth->map_bytes);
    kit_scene_close(&left);
    kit_scene_close(&right);
    kit_close(&one);
    kit_close(&other);
    device_close(vulkan);
    device_close(osmesa);
}

/* ---- the file ---- */

/* A small truth file, as bytes to damage. */
typedef struct truth_bytes {
    char bytes[8192];
    size_t count;
    char path[32];
} truth_bytes;

enum { FILE_PIXELS = 12 };

/* 4 x 3 px, i fragments in pixel i, and their ranks of arrival. */
static void make_file(truth_bytes *file)
{
    kept_header header = { .magic = "fmkept1",
                           .kind = KEPT_TRUTH,
                           .width_px = 4,
                           .height_px = 3,
                           .n = FILE_PIXELS - 1,
                           .list_count = FILE_PIXELS,
                           .nonempty = FILE_PIXELS - 1 };
    uint64_t offsets[FILE_PIXELS + 1] = { 0 };
    for (uint32_t i = 0; i < FILE_PIXELS; i++)
        offsets[i + 1] = offsets[i] + i;
    header.item_count = header.word_count = offsets[FILE_PIXELS];
    *file = (truth_bytes){ .path = "/tmp/fm-truth-XXXXXX" };
    memcpy(file->bytes, &header, sizeof header);
    memcpy(file->bytes + sizeof header, offsets, sizeof offsets);
    file->count = sizeof header + sizeof offsets;
    for (uint32_t i = 0; i < FILE_PIXELS; i++)
        for (uint32_t j = 0; j < i; j++) {
            const fm_fragment fragment = { (float)j / 16, j };
            memcpy(file->bytes + file->count, &fragment, sizeof fragment);
            file->count += sizeof fragment;
        }
    for (uint32_t i = 0; i < FILE_PIXELS; i++)
        for (uint32_t j = 0; j < i; j++) {
            memcpy(file->bytes + file->count, &j, sizeof j);
            file->count += sizeof j;
        }
    const int fd = mkstemp(file->path);
    assert_true(fd >= 0);
    close(fd);
}

static fm_status open_with(const truth_bytes *file, size_t count, fm_error *err)
{
    fm_truth *truth = NULL;
    FILE *out = fopen(file->path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(file->bytes, 1, count, out), count);
    assert_int_equal(fclose(out), 0);
    const fm_status status = truth_open(&truth, file->path, err);
    assert_true((truth != NULL) == (status == FM_OK));
    truth_close(truth);
    return status;
}

static void refuse(const truth_bytes *file, size_t count)
{
    fm_error err = { .message = "" };
    assert_int_equal(open_with(file, count, &err), FM_IO);
    assert_non_null(strstr(err.message, file->path));
}

static void truth_open_takes_a_whole_file(void **state)
{
    truth_bytes file;
    fm_error err;
    (void)state;
    make_file(&file);
    assert_int_equal(open_with(&file, file.count, &err), FM_OK);
    unlink(file.path);
}

static void truth_open_refuses_truncated_files(void **state)
{
    truth_bytes file;
    (void)state;
    make_file(&file);
    for (size_t count = 0; count < file.count; count++)
        refuse(&file, count);
    refuse(&file, file.count + 1);
    unlink(file.path);
}

static void damage(size_t offset, uint64_t value, size_t bytes)
{
    truth_bytes file;
    make_file(&file);
    memcpy(file.bytes + offset, &value, bytes);
    refuse(&file, file.count);
    unlink(file.path);
}

static void truth_open_refuses_damaged_headers(void **state)
{
    (void)state;
    damage(offsetof(kept_header, magic), 'F', 1);
    damage(offsetof(kept_header, width_px), 5, 4);
    damage(offsetof(kept_header, width_px), UINT32_MAX, 4);
    damage(offsetof(kept_header, height_px), 0, 4);
    damage(offsetof(kept_header, kind), KEPT_FRAGMENTS, 4);
    damage(offsetof(kept_header, kind), KEPT_KIND_COUNT, 4);
    damage(offsetof(kept_header, reserved), 1, 4);
    damage(offsetof(kept_header, word_count), 0, 8);
    damage(offsetof(kept_header, word_count), UINT64_MAX, 8);
    damage(offsetof(kept_header, item_count), UINT64_MAX, 8);
    damage(offsetof(kept_header, item_count), 1, 8);
    damage(offsetof(kept_header, list_count), UINT64_MAX, 8);
}

static void truth_open_refuses_offsets_that_lead_astray(void **state)
{
    (void)state;
    damage(sizeof(kept_header), 1, 8);                       /* the first is not 0 */
    damage(sizeof(kept_header) + 8 * 5, UINT64_MAX / 16, 8); /* beyond the fragments */
    damage(sizeof(kept_header) + 8 * 5, 0, 8);               /* falling */
    damage(sizeof(kept_header) + 8 * FILE_PIXELS, 65, 8);    /* the last is not F */
    damage(offsetof(kept_header, n), 3, 4);                  /* a pixel has more than n */
}

static void truth_open_refuses_a_missing_file(void **state)
{
    fm_truth *truth = NULL;
    fm_error err = { .message = "" };
    (void)state;
    assert_int_equal(truth_open(&truth, "/tmp/fm-truth-that-is-not-there", &err), FM_IO);
    assert_null(truth);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(flat_layers_are_captured_as_the_closed_form_says),
        ON_VULKAN_AND_OSMESA(sloped_layers_are_captured_within_two_steps),
        { "truth_of_several_bands_is_what_methods_capture [vulkan]",
          truth_of_several_bands_is_what_methods_capture, open_vulkan, close_opened, NULL },
        { "forgotten_fragments_come_back [vulkan]", forgotten_fragments_come_back, open_vulkan,
          close_opened, NULL },
        ON_VULKAN_AND_OSMESA(sums_of_a_truth_agree_with_its_lists),
        cmocka_unit_test(vulkan_and_osmesa_capture_the_same_flat_layers),
        cmocka_unit_test(truth_open_takes_a_whole_file),
        cmocka_unit_test(truth_open_refuses_truncated_files),
        cmocka_unit_test(truth_open_refuses_damaged_headers),
        cmocka_unit_test(truth_open_refuses_offsets_that_lead_astray),
        cmocka_unit_test(truth_open_refuses_a_missing_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
