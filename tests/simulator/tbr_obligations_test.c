/* What the paper on EVR takes for granted of lists, predictions and counts, over random sequences.
 * FRAGMARK_TEST_ALL: 100 000 sequences, else a slice. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "tbr_kit.h"

enum { MAX_ENTRIES = 64, MAX_RUNS = 4, MAX_TILES = 4 };

static uint32_t sequence_count(void)
{
    return getenv("FRAGMARK_TEST_ALL") != NULL ? 100000 : 1000;
}

/* Techniques side by side on one sequence after another. */
typedef struct race {
    const char *const *words; /* [count] */
    size_t count;
    kit_technique techniques[MAX_RUNS];
    tbr *gpus[MAX_RUNS];
    kit_sequence sequence;
    uint32_t seed, frame;
    fm_fvp first[MAX_TILES]; /* what a check keeps of the first frame */
} race;

/* Called after each frame that all have drawn. */
typedef void race_check(race *runs);

static void draw_all(race *runs)
{
    fm_error err = { 0 };
    for (size_t i = 0; i < runs->count; i++)
        if (tbr_frame(runs->gpus[i], &runs->sequence.frames[runs->frame].frame, &err) != FM_OK)
            fail_msg("%s", err.message);
}

static void run_race(const char *const *words, size_t count, uint32_t flags, race_check *check)
{
    race runs = { .words = words, .count = count };
    for (size_t i = 0; i < count; i++)
        runs.techniques[i] = kit_technique_open(words[i]);
    for (runs.seed = 0; runs.seed < sequence_count(); runs.seed++) {
        kit_random(&runs.sequence, runs.seed, flags);
        for (size_t i = 0; i < count; i++)
            runs.gpus[i] =
                kit_gpu(&runs.techniques[i], runs.sequence.width_px, runs.sequence.height_px);
        for (runs.frame = 0; runs.frame < runs.sequence.count; runs.frame++) {
            draw_all(&runs);
            check(&runs);
        }
        for (size_t i = 0; i < count; i++)
            tbr_destroy(runs.gpus[i]);
    }
    for (size_t i = 0; i < count; i++)
        kit_technique_close(&runs.techniques[i]);
    kit_sequence_free(&runs.sequence);
}

#define RACE(flags, check, ...)                                                                    \
    run_race((const char *const[]){ __VA_ARGS__ },                                                 \
             sizeof((const char *const[]){ __VA_ARGS__ }) / sizeof(char *), flags, check)

static void fail_at(const race *runs, size_t technique, const char *what)
{
    fail_msg("%s, seed %u, frame %u: %s", runs->words[technique], runs->seed, runs->frame, what);
}

/* ---- lists ---- */

static bool may_move(const race *runs, const tbr_list_entry *entry)
{
    const fm_draw_call *draw = &runs->sequence.frames[runs->frame].frame.draws[entry->draw];
    return entry->primitive != UINT32_MAX && tbr_type(draw, 0) == FM_TYPE_WOZ;
}

static const tbr_list_entry *find(const tbr_list_entry *list, uint32_t count,
                                  const tbr_list_entry *wanted)
{
    for (uint32_t i = 0; i < count; i++)
        if (list[i].primitive == wanted->primitive && list[i].draw == wanted->draw)
            return &list[i];
    return NULL;
}

/* `ours` is what Algorithm 1 makes of `submitted`: between two entries that may not move, first all
 * that are predicted visible, then all others, each as submitted. */
static void compare_partition(const race *runs, const tbr_list_entry *ours,
                              const tbr_list_entry *submitted, uint32_t count)
{
    uint32_t at = 0;
    for (uint32_t begin = 0, end; begin < count; begin = end) {
        end = begin;
        while (end < count && may_move(runs, &submitted[end]))
            end++;
        for (int pass = 0; pass < 2; pass++)
            for (uint32_t i = begin; i < end; i++) {
                const tbr_list_entry *moved = find(ours, count, &submitted[i]);
                if (moved == NULL)
                    fail_at(runs, 1, "a primitive is in no list");
                else if ((moved->prediction != FM_VISIBLE) == (pass == 1) && moved != &ours[at++])
                    fail_at(runs, 1, "no stable partition");
            }
        if (end < count && find(ours, count, &submitted[end++]) != &ours[at++])
            fail_at(runs, 1, "an entry that may not move was moved");
    }
}

static void check_lists(race *runs)
{
    tbr_list_entry submitted[MAX_ENTRIES], ours[MAX_ENTRIES];
    for (uint32_t tile = 0; tile < tbr_tile_count(runs->gpus[0]); tile++) {
        const uint32_t count = tbr_list(runs->gpus[0], tile, submitted, MAX_ENTRIES);
        uint32_t layer = 0;
        assert_true(count <= MAX_ENTRIES);
        if (tbr_list(runs->gpus[1], tile, ours, MAX_ENTRIES) != count)
            fail_at(runs, 1, "not as many entries as submitted");
        compare_partition(runs, ours, submitted, count);
        for (uint32_t i = 0; i < count; i++) {
            if (ours[i].primitive == UINT32_MAX) /* a clear has no layer */
                continue;
            if (ours[i].layer < layer)
                fail_at(runs, 1, "layers decrease along a list");
            layer = ours[i].layer;
        }
    }
}

static void lists_are_stable_partitions_in_order_of_layers(void **state)
{
    (void)state;
    RACE(ADVERSE_ALL, check_lists, "tbr-base", "tbr-evr-reorder");
    RACE(ADVERSE_NWOZ, check_lists, "tbr-base", "tbr-evr");
}

/* ---- counts ---- */

static uint64_t shaded(const race *runs, size_t technique)
{
    return tbr_counts(runs->gpus[technique])->fragments_shaded;
}

/* Base, reorder, oracle-z. */
static void check_oracle_shades_least(race *runs)
{
    for (size_t i = 0; i < 2; i++) {
        if (shaded(runs, 2) > shaded(runs, i))
            fail_at(runs, i, "shades less than the oracle");
        assert_int_equal(tbr_counts(runs->gpus[i])->fragments_rasterised,
                         tbr_counts(runs->gpus[2])->fragments_rasterised);
    }
}

static void check_order_shades_no_more(race *runs)
{
    check_oracle_shades_least(runs);
    if (shaded(runs, 1) > shaded(runs, 0))
        fail_at(runs, 1, "shades more than the baseline");
}

static void nothing_shades_less_than_the_oracle(void **state)
{
    (void)state;
    RACE(ADVERSE_ALL, check_oracle_shades_least, "tbr-base", "tbr-evr-reorder", "tbr-oracle-z");
}

/* Of sloped primitives that is not so. Most of these sequences have one tile. */
static void reordering_flat_primitives_never_shades_more(void **state)
{
    (void)state;
    RACE(0, check_order_shades_no_more, "tbr-base", "tbr-evr-reorder", "tbr-oracle-z");
}

/* With nothing to go by, a technique does what the baseline does. */
static void check_first_frame(race *runs)
{
    const tbr_counters *base = tbr_counts(runs->gpus[0]);
    for (size_t i = 1; i < runs->count && runs->frame == 0; i++) {
        const tbr_counters *c = tbr_counts(runs->gpus[i]);
        assert_int_equal(c->hidden_by_layer + c->hidden_by_depth + c->tiles_skipped, 0);
        assert_int_equal(c->pairs, base->pairs);
        assert_int_equal(c->list_bytes, base->list_bytes);
        assert_int_equal(c->attribute_bytes, base->attribute_bytes);
        assert_int_equal(c->quads_rasterised, base->quads_rasterised);
        assert_int_equal(c->fragments_shaded, base->fragments_shaded);
        assert_int_equal(c->fragment_instructions_run, base->fragment_instructions_run);
        assert_int_equal(c->texture_bytes16, base->texture_bytes16);
        assert_int_equal(c->colour_quad_writes, base->colour_quad_writes);
        assert_int_equal(c->flush_bytes, base->flush_bytes);
    }
}

static void the_first_frame_costs_what_the_baseline_does(void **state)
{
    (void)state;
    RACE(ADVERSE_ALL, check_first_frame, "tbr-base", "tbr-re", "tbr-evr", "tbr-evr-safe");
}

/* ---- static scenes ---- */

/* What is predicted hidden by its depth stays hidden, so the farthest point stays too. */
static void check_depth_is_settled(race *runs)
{
    assert_true(tbr_tile_count(runs->gpus[0]) <= MAX_TILES);
    if (runs->frame > 0)
        assert_int_equal(tbr_counts(runs->gpus[0])->hidden_but_seen, 0);
    for (uint32_t i = 0; i < tbr_tile_count(runs->gpus[0]); i++) {
        const fm_fvp now = tbr_tile(runs->gpus[0], i).fvp;
        if (runs->frame == 0)
            runs->first[i] = now;
        if (now.is_layer != runs->first[i].is_layer || now.value != runs->first[i].value)
            fail_at(runs, 0, "the farthest visible point moved");
    }
}

static void static_depths_settle_at_once(void **state)
{
    (void)state;
    RACE(ADVERSE_STATIC | ADVERSE_SLOPED | ADVERSE_TIES | ADVERSE_DISCARD, check_depth_is_settled,
         "tbr-evr-reorder");
}

/* A tile that is skipped has cost a comparison. */
static void check_all_is_skipped(race *runs)
{
    for (size_t i = 0; i < runs->count && runs->frame >= 2; i++) {
        const tbr_counters *c = tbr_counts(runs->gpus[i]);
        if (c->tiles_skipped != tbr_tile_count(runs->gpus[i]))
            fail_at(runs, i, "a tile that did not change is drawn");
        assert_int_equal(c->signature_compares, c->tiles_skipped);
        assert_int_equal(c->tiles_rendered + c->entries_read + c->read_bytes + c->flush_bytes, 0);
        assert_int_equal(c->quads_rasterised + c->quads_shaded + c->fragments_shaded, 0);
        assert_int_equal(c->depth_quad_reads + c->colour_quad_writes + c->texture_bytes16, 0);
        assert_int_equal(c->visibility_scans + c->fvp_writes + c->layer_quad_writes, 0);
    }
}

static void static_scenes_are_skipped_whole(void **state)
{
    (void)state;
    RACE(ADVERSE_STATIC | ADVERSE_ALL, check_all_is_skipped, "tbr-re");
    RACE(ADVERSE_STATIC | ADVERSE_NWOZ, check_all_is_skipped, "tbr-re", "tbr-evr");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_are_stable_partitions_in_order_of_layers),
        cmocka_unit_test(nothing_shades_less_than_the_oracle),
        cmocka_unit_test(reordering_flat_primitives_never_shades_more),
        cmocka_unit_test(the_first_frame_costs_what_the_baseline_does),
        cmocka_unit_test(static_depths_settle_at_once),
        cmocka_unit_test(static_scenes_are_skipped_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
