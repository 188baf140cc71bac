/* The device against its naive twin: images, lists, layers, predictions, skipped tiles, FVP.
 * FRAGMARK_TEST_ALL: 20 000 sequences a technique, else a slice. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "naive_tbr.h"
#include "tbr_kit.h"

static uint32_t sequence_count(void)
{
    return getenv("FRAGMARK_TEST_ALL") != NULL ? 20000 : 60;
}

typedef struct twins {
    const char *words;
    tbr *device;
    naive_gpu *naive;
    uint32_t seed, frame;
} twins;

static void compare_lists(const twins *pair, uint32_t index)
{
    const naive_tile *tile = &pair->naive->tiles[index];
    tbr_list_entry entries[NAIVE_MAX_ENTRIES];
    const uint32_t count = tbr_list(pair->device, index, entries, NAIVE_MAX_ENTRIES);
    if (count != tile->count)
        fail_msg("%s, seed %u, frame %u, tile %u: %u entries, naive %u", pair->words, pair->seed,
                 pair->frame, index, count, tile->count);
    for (uint32_t i = 0; i < count; i++)
        if (entries[i].primitive != tile->list[i].primitive ||
            entries[i].draw != tile->list[i].draw || entries[i].layer != tile->list[i].layer ||
            entries[i].prediction != tile->list[i].prediction ||
            entries[i].is_signed != tile->list[i].is_signed)
            fail_msg(
                "%s, seed %u, frame %u, tile %u, entry %u: %u/%u layer %u prediction %d, naive "
                "%u/%u layer %u prediction %d",
                pair->words, pair->seed, pair->frame, index, i, entries[i].draw,
                entries[i].primitive, entries[i].layer, (int)entries[i].prediction,
                tile->list[i].draw, tile->list[i].primitive, tile->list[i].layer,
                (int)tile->list[i].prediction);
}

static void compare_tiles(const twins *pair)
{
    for (uint32_t i = 0; i < tbr_tile_count(pair->device); i++) {
        const naive_tile *tile = &pair->naive->tiles[i];
        const tbr_tile_info info = tbr_tile(pair->device, i);
        compare_lists(pair, i);
        if (info.is_skipped != tile->is_skipped || info.signature_valid != tile->is_valid)
            fail_msg("%s, seed %u, frame %u, tile %u: skipped %d valid %d, naive %d %d",
                     pair->words, pair->seed, pair->frame, i, info.is_skipped, info.signature_valid,
                     tile->is_skipped, tile->is_valid);
        if (pair->naive->rules.predicts &&
            (info.fvp.is_layer != tile->fvp.is_layer || info.fvp.value != tile->fvp.value))
            fail_msg("%s, seed %u, frame %u, tile %u: FVP %d %u, naive %d %u", pair->words,
                     pair->seed, pair->frame, i, info.fvp.is_layer, info.fvp.value,
                     tile->fvp.is_layer, tile->fvp.value);
    }
}

static void compare_sequence(twins *pair, const kit_technique *technique, const naive_rules *rules,
                             const kit_sequence *sequence)
{
    fm_error err = { 0 };
    tbr_desc desc = { .width_px = sequence->width_px,
                      .height_px = sequence->height_px,
                      .technique = technique->plugin->method->technique,
                      .parts = technique->parts,
                      .threads = 1,
                      .keep_layers = true };
    assert_int_equal(tbr_create(&pair->device, &desc, &err), FM_OK);
    pair->naive = naive_create(rules, sequence->width_px, sequence->height_px);
    for (pair->frame = 0; pair->frame < sequence->count; pair->frame++) {
        const fm_frame *frame = &sequence->frames[pair->frame].frame;
        assert_int_equal(tbr_frame(pair->device, frame, &err), FM_OK);
        naive_frame(pair->naive, frame);
        compare_tiles(pair);
        if (memcmp(tbr_image(pair->device), pair->naive->image,
                   (size_t)sequence->width_px * sequence->height_px * 4) != 0)
            fail_msg("%s, seed %u, frame %u: another image", pair->words, pair->seed, pair->frame);
    }
    tbr_destroy(pair->device);
    naive_destroy(pair->naive);
}

static void assert_twins_agree(const char *words, const naive_rules *rules)
{
    static const uint32_t flags[] = { ADVERSE_ALL, ADVERSE_NWOZ,
                                      ADVERSE_TIES | ADVERSE_SLOPED | ADVERSE_NWOZ, 0 };
    kit_technique technique = kit_technique_open(words);
    kit_sequence sequence = { 0 };
    twins pair = { .words = words };
    for (pair.seed = 0; pair.seed < sequence_count(); pair.seed++) {
        kit_random(&sequence, pair.seed, flags[pair.seed % (sizeof flags / sizeof flags[0])]);
        compare_sequence(&pair, &technique, rules, &sequence);
    }
    kit_sequence_free(&sequence);
    kit_technique_close(&technique);
}

static void base_agrees_with_its_naive_twin(void **state)
{
    (void)state;
    assert_twins_agree("tbr-base", &(naive_rules){ 0 });
}

static void re_agrees_with_its_naive_twin(void **state)
{
    (void)state;
    assert_twins_agree("tbr-re", &(naive_rules){ .eliminates = true });
}

static void evr_reorder_agrees_with_its_naive_twin(void **state)
{
    (void)state;
    naive_rules rules = { .predicts = true, .reorders = true };
    assert_twins_agree("tbr-evr-reorder tie=paper", &rules);
    rules.exact_ties = true;
    assert_twins_agree("tbr-evr-reorder tie=exact", &rules);
}

static void evr_agrees_with_its_naive_twin(void **state)
{
    (void)state;
    naive_rules rules = {
        .predicts = true, .reorders = true, .eliminates = true, .leaves_out = true
    };
    assert_twins_agree("tbr-evr", &rules);
    rules.owner = true;
    assert_twins_agree("tbr-evr fvp=owner", &rules);
}

static void evr_safe_agrees_with_its_naive_twin(void **state)
{
    (void)state;
    const naive_rules rules = { .predicts = true,
                                .reorders = true,
                                .eliminates = true,
                                .leaves_out = true,
                                .is_safe = true,
                                .exact_ties = true };
    assert_twins_agree("tbr-evr-safe", &rules);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(base_agrees_with_its_naive_twin),
        cmocka_unit_test(re_agrees_with_its_naive_twin),
        cmocka_unit_test(evr_reorder_agrees_with_its_naive_twin),
        cmocka_unit_test(evr_agrees_with_its_naive_twin),
        cmocka_unit_test(evr_safe_agrees_with_its_naive_twin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
