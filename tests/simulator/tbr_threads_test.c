/* The simulated GPU gives the same counts, cycles and images with any number of threads: thirteen
 * rows of tiles, in which each thread may take any. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "generators/frame_sequences.h"
#include "simulator/models/cycles.h"
#include "tbr_kit.h"

enum { WIDTH = 150, HEIGHT = 200, TILES_ACROSS = 10, TILES = 130, FRAMES = 4, RUNS = 4 };
static const uint32_t thread_counts[RUNS] = { 1, 2, 3, 8 };

static fm_sequence *make_sequence(void)
{
    fm_settings settings;
    fm_sequence *sequence = NULL;
    fm_error err = { 0 };
    settings_default(&settings);
    settings.width_px = WIDTH;
    settings.height_px = HEIGHT;
    settings.sequence_frames = FRAMES;
    settings.sprites = 20;
    settings.triangles = 400;
    settings.object_px = 24;
    settings.hud = 0.3;
    settings.hidden_churn = 0.5;
    assert_int_equal(frames_generate(&sequence, &settings, &err), FM_OK);
    return sequence;
}

typedef struct run {
    tbr *gpu;
    cycles *model;
} run;

static run run_new(const kit_technique *technique, uint32_t threads)
{
    run made = { NULL };
    model_table table;
    fm_error err = { 0 };
    assert_int_equal(model_table_read(&table, "", &err), FM_OK);
    assert_int_equal(cycles_create(&made.model, &table, TILES, TILES_ACROSS, &err), FM_OK);
    const tbr_desc desc = { .width_px = WIDTH,
                            .height_px = HEIGHT,
                            .technique = technique->plugin->method->technique,
                            .parts = technique->parts,
                            .threads = threads,
                            .binned = cycles_binned,
                            .rendered = cycles_rendered,
                            .context = made.model };
    assert_int_equal(tbr_create(&made.gpu, &desc, &err), FM_OK);
    assert_int_equal(tbr_tile_count(made.gpu), TILES);
    assert_int_equal(tbr_thread_count(made.gpu), threads);
    return made;
}

static void compare_frame(const run *other, const run *first)
{
    const tbr_counters *counts = tbr_counts(other->gpu);
    const cycles_frame ours = cycles_of_frame(other->model, counts);
    const cycles_frame theirs = cycles_of_frame(first->model, tbr_counts(first->gpu));
    assert_true(counts->fragments_shaded > 0);
    assert_memory_equal(counts, tbr_counts(first->gpu), sizeof *counts);
    assert_memory_equal(tbr_image(other->gpu), tbr_image(first->gpu), WIDTH * HEIGHT * 4);
    assert_memory_equal(&ours, &theirs, sizeof ours);
}

static void assert_same_with_all_threads(const char *words)
{
    fm_error err = { 0 };
    kit_technique technique = kit_technique_open(words);
    fm_sequence *sequence = make_sequence();
    run runs[RUNS];
    for (int i = 0; i < RUNS; i++)
        runs[i] = run_new(&technique, thread_counts[i]);
    for (uint32_t frame = 0; frame < FRAMES; frame++) {
        const fm_frame *drawn = NULL;
        assert_int_equal(sequence->frame(sequence, &drawn, frame, &err), FM_OK);
        for (int i = 0; i < RUNS; i++) {
            assert_int_equal(tbr_frame(runs[i].gpu, drawn, &err), FM_OK);
            compare_frame(&runs[i], &runs[0]);
        }
    }
    for (int i = 0; i < RUNS; i++) {
        tbr_destroy(runs[i].gpu);
        cycles_destroy(runs[i].model);
    }
    sequence_destroy(sequence);
    kit_technique_close(&technique);
}

static void one_two_three_and_eight_threads_agree(void **state)
{
    (void)state;
    assert_same_with_all_threads("tbr-base");
    assert_same_with_all_threads("tbr-re age=2");
    assert_same_with_all_threads("tbr-evr");
    assert_same_with_all_threads("tbr-evr-safe");
    assert_same_with_all_threads("tbr-z-prepass");
    assert_same_with_all_threads("tbr-oracle-tile");
    assert_same_with_all_threads("tbr-vro-lite");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_two_three_and_eight_threads_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
