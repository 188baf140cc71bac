/* Accesses of methods' memory, counted: small cases that are counted by hand here, and elements
 * that are not there. */
#include <stdio.h>

#include "kit/frame_kit.h"

typedef struct expected {
    const char *method, *texts;
    uint64_t loaded, stored, atomics;
} expected;

static void expect(kit_scene *scene, const expected *row, uint32_t feed)
{
    fm_measurement m;
    char where[256];
    const kit_way way = { row->method, feed, row->texts };
    kit_tell(where, &way);
    if (!kit_measure(&m, scene, &way))
        return;
    const fm_accesses all = measure_accesses(&m);
    if (m.accesses_count == 0 || all.loaded != row->loaded || all.stored != row->stored ||
        all.atomics != row->atomics || all.outside != 0)
        fail_msg("%s: %zu resources (%s), loaded %llu, stored %llu, atomics %llu, outside %llu",
                 where, m.accesses_count, m.uncounted, (unsigned long long)all.loaded,
                 (unsigned long long)all.stored, (unsigned long long)all.atomics,
                 (unsigned long long)all.outside);
    measurement_free(&m);
}

static void expect_rows(fm_device *device, const char *texts, const expected *rows, size_t count)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device);
    kit_scene_open(&scene, &kit, texts);
    for (size_t i = 0; i < count; i++) {
        expect(&scene, &rows[i], FM_FEED_RASTER);
        expect(&scene, &rows[i], FM_FEED_COMPUTE_PIXEL);
    }
    kit_scene_close(&scene);
    kit_close(&kit);
}

/* Two layers at one pixel, the nearer first.
 *
 * kplus-array, k = 2. clear: the word (4) and slot 0 (8) are stored. store, both times: the cull
 * loads the depth of slot 0 (4), the lock is taken (4 and 4, an atomic), which brings the word, and
 * released (4), which stores it; the fragment is stored (8). The second one also compares with slot
 * 1 (8). resolve loads the word (4) and two fragments (16).
 *   loaded   2 (4 + 4) + 8 + 20 = 44         stored   12 + 2 (4 + 4 + 8) = 44
 * With layout=image a texel is loaded whole: the cull loads 4 more each time.
 *   loaded   2 (8 + 4) + 8 + 20 = 52         stored   as before
 * With count_in=own the word is loaded and stored (4 and 4) beside the lock.
 *   loaded   2 (4 + 4 + 4) + 8 + 20 = 52     stored   12 + 2 (4 + 4 + 4 + 8) = 52
 *
 * ab-array. clear: the counter (4). store: an atomic on it (4 and 4), the fragment (8). resolve as
 * above.
 *   loaded   2 x 4 + 20 = 28                 stored   4 + 2 (4 + 8) = 28
 *
 * ab-ll. clear: head (4) and both counters (8). store: an atomic on the pool (4 and 4), depth,
 * colour (8), an atomic on the head (4 and 4), the link (4). resolve: the head (4), and three words
 * of each of two nodes (24). The pool grows in the first try of the frame; the last is counted.
 *   loaded   2 (4 + 4) + 28 = 44             stored   12 + 2 (4 + 8 + 4 + 4) = 52
 * With node=whole a node is stored, and loaded, at once (16).
 *   loaded   2 (4 + 4) + 4 + 2 x 16 = 52     stored   12 + 2 (4 + 4 + 16) = 60 */
static void one_pixel_of_two_layers_is_as_by_hand(void **state)
{
    static const expected rows[] = {
        { "null", "", 0, 0, 0 },
        { "kplus-array", "k=2 lock=spin", 44, 44, 2 },
        { "kplus-array", "k=2 lock=spin layout=image", 52, 44, 2 },
        { "kplus-array", "k=2 lock=spin count_in=own", 52, 52, 2 },
        { "kplus-array", "k=2 lock=spin layout=layer", 44, 44, 2 },
        { "kplus-array", "k=2 lock=spin buffers=address", 44, 44, 2 },
        { "ab-array", "", 28, 28, 2 },
        { "ab-array", "buffers=address", 28, 28, 2 },
        { "ab-ll", "node=split", 44, 52, 4 },
        { "ab-ll", "node=whole", 52, 60, 4 },
    };
    expect_rows(device_of(state), "width_px=1 height_px=1 n=2 pixel_density=1 order=ascending",
                rows, sizeof rows / sizeof rows[0]);
}

/* Twice the same, but for the two counters of ab-ll's pool. */
static void two_pixels_are_twice_one(void **state)
{
    static const expected rows[] = {
        { "kplus-array", "k=2 lock=spin", 88, 88, 4 },
        { "ab-array", "", 56, 56, 4 },
        { "ab-ll", "node=split", 88, 96, 8 },
        { "ab-ll", "node=whole", 104, 112, 8 },
    };
    expect_rows(device_of(state), "width_px=2 height_px=1 n=2 pixel_density=1 order=ascending",
                rows, sizeof rows / sizeof rows[0]);
}

/* More than 2^32 bytes: the two words of a sum hold together. 96 x 65 invocations load 16 bytes
 * 60 x 1009 times each. */
static void sums_are_wider_than_a_word(void **state)
{
    static const char shader[] = "void many(uvec2 pixel)\n{\n    uvec4 sum = uvec4(0u);\n"
                                 "    for (uint i = 0u; i < 60u; ++i)\n"
                                 "        for (uint j = 0u; j < 1009u; ++j)\n"
                                 "            sum += wide[(i + j) % 8u];\n"
                                 "    if (sum.x == 77u)\n        result[0] = sum.y;\n}\n";
    static const kit_file files[] = { { "many.glsl", shader } };
    static const fm_method_desc method = {
        .id = "many",
        .traits = FM_TRAIT_FLOOR,
        .resources = { { .name = "wide", .element = FM_ELEMENT_UVEC4, .extent = { .constant = 8 } },
                       { .name = "result", .extent = { .constant = 1 } } },
        .passes = { { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "wide" } },
                    { .name = "many",
                      .kind = FM_PASS_PIXELS,
                      .shader = "many.glsl",
                      .reads = { "wide" },
                      .writes = { "result" } } },
    };
    frames_seen seen;
    fm_error err = { .message = "" };
    const kit_frames frames = { .method = &method,
                                .files = files,
                                .file_count = 1,
                                .scene = "width_px=96 height_px=65 n=0",
                                .counts = true };
    const fm_status status = frames_try(&seen, device_of(state), &frames, &err);
    if (status != FM_OK)
        fail_msg("%s", err.message);
    assert_true(seen.has_counts);
    assert_true(seen.accesses[0].loaded == 96ull * 65 * 60 * 1009 * 16);
    assert_true(seen.accesses[0].stored == 8 * 16); /* by the clear pass */
    assert_true(seen.accesses[0].outside == 0);
    assert_true(seen.accesses[1].stored == 0);
}

static void elements_that_are_not_there_are_counted(void **state)
{
    static const char shader[] =
        "void beyond(uvec2 pixel)\n{\n"
        "    uint sum = result[0] + result[pixel.x];\n" /* 0, 1, 2 of 2 elements: 2 beyond */
        "    sum += imageLoad(fm_image_surface, ivec2(pixel) + ivec2(1, 0)).x;\n" /* the last column
                                                                                   */
        "    imageStore(fm_image_surface, ivec2(pixel) - ivec2(0, 1), uvec4(sum));\n" /* row 0 */
        "    if (pixel.x == 0u)\n"
        "        imageAtomicAdd(fm_image_surface, ivec2(pixel), 1u);\n"
        "    result[0] = sum;\n}\n";
    static const kit_file files[] = { { "beyond.glsl", shader } };
    static const fm_method_desc method = {
        .id = "beyond",
        .traits = FM_TRAIT_FLOOR,
        .resources = { { .name = "surface", .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_R32UI },
                       { .name = "result", .extent = { .constant = 2 } } },
        .passes = { { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "surface" } },
                    { .name = "beyond",
                      .kind = FM_PASS_PIXELS,
                      .shader = "beyond.glsl",
                      .writes = { "surface", "result" } } },
    };
    frames_seen seen;
    fm_error err = { .message = "" };
    const kit_frames frames = { .method = &method,
                                .files = files,
                                .file_count = 1,
                                .buffers = FM_BUFFERS_BOUND, /* where such loads do no harm */
                                .counts = true };
    if (frames_try(&seen, device_of(state), &frames, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_true(seen.has_counts);
    assert_int_equal(seen.accesses[1].loaded, 6 * (4 + 4));
    assert_int_equal(seen.accesses[1].stored, 6 * 4);
    assert_int_equal(seen.accesses[1].outside, 2);
    assert_int_equal(seen.accesses[0].loaded, 6 * 4 + 2 * 4);
    assert_int_equal(seen.accesses[0].stored, 6 * 4 + 6 * 4 + 2 * 4); /* clear, store, atomic */
    assert_int_equal(seen.accesses[0].atomics, 2);
    assert_int_equal(seen.accesses[0].outside, 2 + 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(one_pixel_of_two_layers_is_as_by_hand, open_vulkan,
                                        close_opened),
        cmocka_unit_test_setup_teardown(two_pixels_are_twice_one, open_vulkan, close_opened),
        cmocka_unit_test_setup_teardown(sums_are_wider_than_a_word, open_vulkan, close_opened),
        cmocka_unit_test_setup_teardown(elements_that_are_not_there_are_counted, open_vulkan,
                                        close_opened),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
