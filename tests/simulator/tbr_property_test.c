/* What techniques promise about images, over random sequences built to break them, and the three
 * counterexamples to the published signatures. FRAGMARK_TEST_ALL: 100 000 sequences, else a slice.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tbr_kit.h"

static uint32_t sequence_count(void)
{
    return getenv("FRAGMARK_TEST_ALL") != NULL ? 100000 : 1500;
}

static const uint32_t *draw_frame(tbr *gpu, const kit_sequence *sequence, uint32_t frame)
{
    fm_error err = { 0 };
    if (tbr_frame(gpu, &sequence->frames[frame].frame, &err) != FM_OK)
        fail_msg("%s", err.message);
    return tbr_image(gpu);
}

/* The first frame in which the two differ; the count of frames: none. */
static uint32_t first_difference(const kit_sequence *sequence, const kit_technique *technique,
                                 const kit_technique *base)
{
    tbr *gpu = kit_gpu(technique, sequence->width_px, sequence->height_px);
    tbr *right = kit_gpu(base, sequence->width_px, sequence->height_px);
    const size_t bytes = (size_t)sequence->width_px * sequence->height_px * 4;
    uint32_t frame = 0;
    while (frame < sequence->count &&
           memcmp(draw_frame(gpu, sequence, frame), draw_frame(right, sequence, frame), bytes) == 0)
        frame++;
    tbr_destroy(gpu);
    tbr_destroy(right);
    return frame;
}

static void assert_draws_as_base(const char *words, uint32_t flags)
{
    kit_technique technique = kit_technique_open(words), base = kit_technique_open("tbr-base");
    kit_sequence sequence = { 0 };
    for (uint32_t seed = 0; seed < sequence_count(); seed++) {
        kit_random(&sequence, seed, flags);
        const uint32_t frame = first_difference(&sequence, &technique, &base);
        if (frame < sequence.count)
            fail_msg("%s, flags 0x%X, seed %u: frame %u is not the baseline's", words, flags, seed,
                     frame);
    }
    kit_sequence_free(&sequence);
    kit_technique_close(&technique);
    kit_technique_close(&base);
}

static void reorder_draws_what_base_draws(void **state)
{
    (void)state;
    assert_draws_as_base("tbr-evr-reorder", ADVERSE_ALL);
    assert_draws_as_base("tbr-evr-reorder fvp=owner", ADVERSE_ALL);
    assert_draws_as_base("tbr-evr-reorder tie=paper",
                         ADVERSE_NWOZ | ADVERSE_DISCARD | ADVERSE_BARRIERS);
}

static void re_draws_what_base_draws(void **state)
{
    (void)state;
    assert_draws_as_base("tbr-re", ADVERSE_ALL);
    assert_draws_as_base("tbr-re age=2 uploads=disable", ADVERSE_ALL);
}

static void vro_lite_draws_what_base_draws(void **state)
{
    (void)state;
    assert_draws_as_base("tbr-vro-lite", ADVERSE_ALL);
    assert_draws_as_base("tbr-vro-lite", ADVERSE_TIES | ADVERSE_SLOPED);
}

static void evr_safe_draws_what_base_draws(void **state)
{
    (void)state;
    assert_draws_as_base("tbr-evr-safe", ADVERSE_ALL);
    assert_draws_as_base("tbr-evr-safe", ADVERSE_NWOZ);
    assert_draws_as_base("tbr-evr-safe age=2", ADVERSE_ALL);
    assert_draws_as_base("tbr-evr-safe tie=paper",
                         ADVERSE_NWOZ | ADVERSE_DISCARD | ADVERSE_BARRIERS);
}

static void z_prepass_draws_what_base_draws(void **state)
{
    (void)state;
    assert_draws_as_base("tbr-z-prepass", ADVERSE_ALL);
}

static void oracles_draw_what_base_draws(void **state)
{
    (void)state;
    assert_draws_as_base("tbr-oracle-z", ADVERSE_ALL);
    assert_draws_as_base("tbr-oracle-tile", ADVERSE_ALL);
    assert_draws_as_base("tbr-te", ADVERSE_ALL);
}

/* ---- published EVR ---- */

static uint32_t count_wrong(const char *words, uint32_t flags, uint32_t count)
{
    kit_technique technique = kit_technique_open(words), base = kit_technique_open("tbr-base");
    kit_sequence sequence = { 0 };
    uint32_t wrong = 0;
    for (uint32_t seed = 0; seed < count; seed++) {
        kit_random(&sequence, seed, flags);
        wrong += first_difference(&sequence, &technique, &base) < sequence.count;
    }
    kit_sequence_free(&sequence);
    kit_technique_close(&technique);
    kit_technique_close(&base);
    return wrong;
}

/* Wilson's 95 % interval. */
static void print_rate(const char *what, uint32_t wrong, uint32_t count)
{
    const double z = 1.96, n = count, p = wrong / n;
    const double centre = (p + z * z / (2 * n)) / (1 + z * z / n);
    const double half = z * sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / (1 + z * z / n);
    print_message("%s: %u of %u sequences wrong, %.2f %% (95 %% interval %.2f to %.2f %%)\n", what,
                  wrong, count, 100 * p, 100 * (centre - half), 100 * (centre + half));
}

static void published_evr_draws_wrong_images(void **state)
{
    (void)state;
    const uint32_t count = sequence_count();
    const uint32_t simple = count_wrong("tbr-evr", ADVERSE_NWOZ, count);
    const uint32_t all = count_wrong("tbr-evr tie=exact", ADVERSE_ALL, count);
    print_rate("tbr-evr, flat opaque and blended quads", simple, count);
    print_rate("tbr-evr, everything", all, count);
    assert_true(simple > 0 && all > 0);
}

static void blended_depth_writers_may_not_be_reordered(void **state)
{
    (void)state;
    const uint32_t flags = ADVERSE_NWOZ | ADVERSE_BARRIERS;
    const uint32_t wrong =
        count_wrong("tbr-evr-reorder tie=exact types=paper", flags, sequence_count());
    print_rate("tbr-evr-reorder types=paper, blended depth writers", wrong, sequence_count());
    assert_true(wrong > 0);
}

/* A draw call of one quad; z in sixteenths of the range. */
typedef struct step {
    char name; /* its texture */
    bool is_woz;
    uint32_t z16;
    bool is_half; /* the left half of the tile only */
} step;

static void add_steps(fm_frame_builder *builder, const step *steps)
{
    frame_builder_clear(builder);
    for (; steps->name != 0; steps++) {
        fm_draw_call draw = steps->is_woz ? kit_woz() : kit_draw();
        const int32_t px[4] = { 0, 0, steps->is_half ? 8 : 16, 16 };
        draw.texture = (uint32_t)steps->name;
        frame_builder_draw(builder, &draw);
        frame_builder_quad(builder, px, steps->z16 * (FRAMES_DEPTH_MAX / 16));
    }
}

/* The frame in which the technique first differs from the baseline; the count: never. */
static uint32_t counterexample(const char *words, const step frames[][4], uint32_t count)
{
    kit_technique technique = kit_technique_open(words), base = kit_technique_open("tbr-base");
    kit_sequence sequence = { .width_px = 16, .height_px = 16, .count = count };
    for (uint32_t i = 0; i < count; i++)
        add_steps(&sequence.frames[i], frames[i]);
    const uint32_t first = first_difference(&sequence, &technique, &base);
    kit_sequence_free(&sequence);
    kit_technique_close(&technique);
    kit_technique_close(&base);
    return first;
}

/* Q hides P; Q shrinks, so P is seen though not signed; P goes. */
static const step visible_but_unsigned[][4] = {
    { { 'Q', true, 4, false }, { 'P', true, 8, false } },
    { { 'Q', true, 4, true }, { 'P', true, 8, false } },
    { { 'Q', true, 4, true } },
};

/* B goes, so the HUD takes B's number and counts as hidden; then the HUD goes. */
static const step renumbered[][4] = {
    { { 'A', false, 0, false }, { 'B', false, 0, false }, { 'H', false, 0, false } },
    { { 'A', false, 0, false }, { 'B', false, 0, false }, { 'H', false, 0, false } },
    { { 'A', false, 0, false }, { 'H', false, 0, false } },
    { { 'A', false, 0, false } },
};

/* S, under the HUD and unsigned, comes to the front: its depth now rejects M, which covers half of
 * the tile, so that the HUD's layer is the farthest. */
static const step hidden_depth_acts[][4] = {
    { { 'S', true, 10, false }, { 'H', false, 0, false }, { 'M', true, 6, true } },
    { { 'S', true, 10, false }, { 'H', false, 0, false }, { 'M', true, 6, true } },
    { { 'S', true, 2, false }, { 'H', false, 0, false }, { 'M', true, 6, true } },
};

static void evr_keeps_what_was_seen_though_unsigned(void **state)
{
    (void)state;
    assert_int_equal(counterexample("tbr-evr", visible_but_unsigned, 3), 2);
    assert_int_equal(counterexample("tbr-evr-safe", visible_but_unsigned, 3), 3);
}

static void evr_takes_a_renumbered_layer_for_hidden(void **state)
{
    (void)state;
    assert_int_equal(counterexample("tbr-evr", renumbered, 4), 3);
    assert_int_equal(counterexample("tbr-evr-safe", renumbered, 4), 4);
}

static void evr_forgets_that_hidden_depths_act(void **state)
{
    (void)state;
    assert_int_equal(counterexample("tbr-evr", hidden_depth_acts, 3), 2);
    assert_int_equal(counterexample("tbr-evr-safe", hidden_depth_acts, 3), 3);
}

/* One slope, whose corners are whole depth steps: the two agree exactly wherever both are. */
static void add_ramp(fm_frame_builder *builder, char name, int32_t from_px)
{
    fm_draw_call draw = kit_woz();
    fm_corner corners[4];
    for (int i = 0; i < 4; i++) {
        const int32_t x = i == 1 || i == 2 ? 16 : from_px, y = i >= 2 ? 16 : 0;
        corners[i] = (fm_corner){ x * FRAMES_SUBPIXELS, y * FRAMES_SUBPIXELS,
                                  (1u << 22) + ((uint32_t)x << 19), 0, 0 };
    }
    draw.texture = (uint32_t)name;
    frame_builder_draw(builder, &draw);
    frame_builder_triangle(builder, &(fm_triangle){ { corners[0], corners[1], corners[2] } });
    frame_builder_triangle(builder, &(fm_triangle){ { corners[0], corners[2], corners[3] } });
}

/* P, hidden behind F in the frame before, and Q, of the same plane but reaching nearer. */
static void ties_across_lists_need_exact_ties(void **state)
{
    (void)state;
    const struct {
        const char *words;
        uint32_t differs_in;
    } expected[] = { { "tbr-evr-reorder tie=paper", 1 }, { "tbr-evr-reorder tie=exact", 2 } };
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        kit_technique technique = kit_technique_open(expected[i].words);
        kit_technique base = kit_technique_open("tbr-base");
        kit_sequence sequence = { .width_px = 16, .height_px = 16, .count = 2 };
        const step front[] = { { 'F', true, 7, false }, { 0 } };
        add_steps(&sequence.frames[0], front);
        add_steps(&sequence.frames[1], front + 1);
        for (uint32_t frame = 0; frame < 2; frame++) {
            add_ramp(&sequence.frames[frame], 'P', 8);
            add_ramp(&sequence.frames[frame], 'Q', 0);
        }
        assert_int_equal(first_difference(&sequence, &technique, &base), expected[i].differs_in);
        kit_sequence_free(&sequence);
        kit_technique_close(&technique);
        kit_technique_close(&base);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reorder_draws_what_base_draws),
        cmocka_unit_test(re_draws_what_base_draws),
        cmocka_unit_test(evr_safe_draws_what_base_draws),
        cmocka_unit_test(vro_lite_draws_what_base_draws),
        cmocka_unit_test(z_prepass_draws_what_base_draws),
        cmocka_unit_test(oracles_draw_what_base_draws),
        cmocka_unit_test(evr_keeps_what_was_seen_though_unsigned),
        cmocka_unit_test(evr_takes_a_renumbered_layer_for_hidden),
        cmocka_unit_test(evr_forgets_that_hidden_depths_act),
        cmocka_unit_test(published_evr_draws_wrong_images),
        cmocka_unit_test(ties_across_lists_need_exact_ties),
        cmocka_unit_test(blended_depth_writers_may_not_be_reordered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
