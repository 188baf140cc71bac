/* The adversarial scene: the same from the same seed, in whatever order its frames are asked for,
 * and legal in each of them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "generators/adversarial.h"

enum { FRAMES = 20 };

static fm_settings make_settings(uint64_t seed)
{
    fm_settings settings;
    settings_default(&settings);
    settings.generator = FM_GENERATOR_ADVERSARIAL;
    settings.width_px = 64;
    settings.height_px = 48;
    settings.sequence_frames = FRAMES;
    settings.seed = seed;
    return settings;
}

static fm_sequence *make_sequence(uint64_t seed)
{
    const fm_settings settings = make_settings(seed);
    fm_sequence *sequence = NULL;
    assert_int_equal(adversarial_generate(&sequence, &settings, NULL), FM_OK);
    assert_int_equal(sequence->frame_count, FRAMES);
    return sequence;
}

static const fm_frame *frame_of(fm_sequence *sequence, uint32_t index)
{
    const fm_frame *frame = NULL;
    fm_error err = { 0 };
    assert_int_equal(sequence->frame(sequence, &frame, index, &err), FM_OK);
    if (frame_check(frame, index, &err) != FM_OK)
        fail_msg("%s", err.message);
    return frame;
}

static bool is_same(const fm_frame *a, const fm_frame *b)
{
    return a->clear_depth == b->clear_depth && a->draw_count == b->draw_count &&
           a->triangle_count == b->triangle_count &&
           (a->draw_count == 0 ||
            memcmp(a->draws, b->draws, a->draw_count * sizeof *a->draws) == 0) &&
           (a->triangle_count == 0 ||
            memcmp(a->triangles, b->triangles, a->triangle_count * sizeof *a->triangles) == 0);
}

static void frames_do_not_depend_on_the_order_they_are_asked_in(void **state)
{
    (void)state;
    static const uint32_t order[] = { 0, 1, 1, 7, 3, 19, 0, 18, 19 };
    fm_sequence *asked = make_sequence(5);
    for (size_t i = 0; i < sizeof order / sizeof order[0]; i++) {
        fm_sequence *fresh = make_sequence(5);
        for (uint32_t frame = 0; frame < order[i]; frame++)
            frame_of(fresh, frame);
        assert_true(is_same(frame_of(asked, order[i]), frame_of(fresh, order[i])));
        sequence_destroy(fresh);
    }
    sequence_destroy(asked);
}

static void seeds_make_sequences_that_differ_and_change(void **state)
{
    (void)state;
    size_t changes = 0;
    for (uint64_t seed = 0; seed < 20; seed++) {
        fm_sequence *one = make_sequence(seed), *same = make_sequence(seed);
        fm_sequence *other = make_sequence(seed + 1);
        assert_false(is_same(frame_of(one, 0), frame_of(other, 0)));
        for (uint32_t frame = 1; frame < FRAMES; frame++)
            changes += !is_same(frame_of(one, frame), frame_of(same, frame - 1));
        sequence_destroy(one);
        sequence_destroy(same);
        sequence_destroy(other);
    }
    assert_true(changes > 20 * (FRAMES - 1) / 2); /* two of three, but for what changes nothing */
}

static void a_viewport_that_is_too_large_is_refused(void **state)
{
    (void)state;
    fm_settings settings = make_settings(1);
    fm_sequence *sequence = NULL;
    fm_error err = { 0 };
    settings.height_px = FRAMES_SIDE_MAX + 1;
    assert_int_equal(adversarial_generate(&sequence, &settings, &err), FM_INVALID);
    assert_null(sequence);
    assert_string_equal(err.message, "64 x 4097 px: sequences of frames end at 4096");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_do_not_depend_on_the_order_they_are_asked_in),
        cmocka_unit_test(seeds_make_sequences_that_differ_and_change),
        cmocka_unit_test(a_viewport_that_is_too_large_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
