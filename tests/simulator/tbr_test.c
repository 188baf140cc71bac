/* The simulated GPU: counts that can be worked out by hand, its parts, its models. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "simulator/crc.h"
#include "simulator/models/cycles.h"
#include "simulator/models/energy.h"
#include "tbr_kit.h"

static void draw(tbr *gpu, const fm_frame_builder *builder)
{
    fm_error err = { 0 };
    if (frame_check(&builder->frame, 0, &err) != FM_OK ||
        tbr_frame(gpu, &builder->frame, &err) != FM_OK)
        fail_msg("%s", err.message);
}

/* The technique is closed after the GPU that runs its hooks. */
static tbr *gpu_with(kit_technique *technique, const char *words, uint32_t width_px,
                     uint32_t height_px)
{
    *technique = kit_technique_open(words);
    return kit_gpu(technique, width_px, height_px);
}

static void add_rectangle(fm_frame_builder *builder, fm_draw_call draw, const int32_t px[4],
                          uint32_t z)
{
    frame_builder_draw(builder, &draw);
    frame_builder_quad(builder, px, z);
}

/* ---- CRC ---- */

static void crc_of_digits_is_the_published_check_value(void **state)
{
    (void)state;
    crc_table table;
    crc_table_fill(&table);
    assert_int_equal(crc_of(&table, "123456789", 9), 0xCBF43926u);
}

static void crc_combined_is_the_crc_of_the_whole_at_any_split(void **state)
{
    (void)state;
    crc_table table;
    unsigned char bytes[100];
    uint64_t random = 7;
    crc_table_fill(&table);
    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = (unsigned char)random_next(&random);
    for (size_t split = 0; split <= sizeof bytes; split++) {
        crc_shift shift;
        crc_shift_fill(&shift, &table, sizeof bytes - split);
        const uint32_t first = crc_of(&table, bytes, split);
        const uint32_t second = crc_of(&table, bytes + split, sizeof bytes - split);
        assert_int_equal(crc_combine(&shift, first, second), crc_of(&table, bytes, sizeof bytes));
    }
}

/* ---- counts ---- */

static void quad_counts_as_on_paper(void **state)
{
    (void)state;
    kit_technique held;
    tbr *gpu = gpu_with(&held, "tbr-base", 32, 32);
    fm_frame_builder builder = { 0 };
    frame_builder_clear(&builder);
    add_rectangle(&builder, kit_woz(), (const int32_t[4]){ 0, 0, 32, 32 }, 5);
    draw(gpu, &builder);
    const tbr_counters *c = tbr_counts(gpu);
    /* The diagonal crosses two tiles, so two of four hold both triangles. */
    assert_int_equal(c->primitives, 2);
    assert_int_equal(c->pairs, 6);
    assert_int_equal(c->list_bytes, 24);
    assert_int_equal(c->attribute_bytes, 2 * 144);
    assert_int_equal(c->vertex_lines, 3); /* 4 x 48 bytes */
    assert_int_equal(c->tiles_rendered, 4);
    assert_int_equal(c->fragments_rasterised, 1024);
    assert_int_equal(c->fragments_shaded, 1024);
    /* The diagonal runs through 16 quads, which both triangles touch. */
    assert_int_equal(c->quads_rasterised, 256 + 16);
    assert_int_equal(c->quads_shaded, 256 + 16);
    assert_int_equal(c->fragment_instructions_run, 4 * 8 * (256 + 16));
    assert_int_equal(c->flush_bytes, 4096);
    frame_builder_free(&builder);
    tbr_destroy(gpu);
    kit_technique_close(&held);
}

static void early_depth_test_shades_only_what_is_nearer(void **state)
{
    (void)state;
    kit_technique held;
    tbr *gpu = gpu_with(&held, "tbr-base", 16, 16);
    fm_frame_builder builder = { 0 };
    const int32_t whole[4] = { 0, 0, 16, 16 }, half[4] = { 0, 0, 8, 16 };
    frame_builder_clear(&builder);
    add_rectangle(&builder, kit_woz(), half, 5);
    add_rectangle(&builder, kit_woz(), whole, 9);
    draw(gpu, &builder);
    assert_int_equal(tbr_counts(gpu)->fragments_rasterised, 128 + 256);
    assert_int_equal(tbr_counts(gpu)->fragments_shaded, 128 + 128);
    frame_builder_free(&builder);
    tbr_destroy(gpu);
    kit_technique_close(&held);
}

/* Quads in random order: the mean number shaded at a pixel is 1 + 1/2 + ... + 1/d; reordered, from
 * the second frame on, one. */
static void random_order_shades_the_harmonic_number(void **state)
{
    (void)state;
    enum { DEPTH = 4, TRIALS = 4000 };
    uint64_t random = 11, base_sum = 0;
    fm_frame_builder builder = { 0 };
    for (int trial = 0; trial < TRIALS; trial++) {
        uint32_t order[DEPTH] = { 1, 2, 3, 4 };
        kit_technique flat, sorted = { 0 };
        tbr *base = gpu_with(&flat, "tbr-base", 2, 2), *reorder = NULL;
        for (uint32_t i = DEPTH; i > 1; i--) {
            const uint32_t k = random_below(&random, i), kept = order[i - 1];
            order[i - 1] = order[k];
            order[k] = kept;
        }
        frame_builder_clear(&builder);
        for (int i = 0; i < DEPTH; i++)
            add_rectangle(&builder, kit_woz(), (const int32_t[4]){ 0, 0, 2, 2 }, order[i]);
        draw(base, &builder);
        base_sum += tbr_counts(base)->fragments_shaded;
        tbr_destroy(base);
        kit_technique_close(&flat);
        reorder = trial % 100 == 0 ? gpu_with(&sorted, "tbr-evr-reorder", 2, 2) : NULL;
        for (int frame = 0; reorder != NULL && frame < 3; frame++) {
            draw(reorder, &builder);
            if (frame > 0)
                assert_int_equal(tbr_counts(reorder)->fragments_shaded, 4);
        }
        tbr_destroy(reorder);
        kit_technique_close(&sorted);
    }
    const double mean = (double)base_sum / (4.0 * TRIALS);
    assert_true(fabs(mean - 25.0 / 12.0) < 0.05); /* five standard errors */
    frame_builder_free(&builder);
}

static void static_scenes_are_skipped_from_the_third_frame_on(void **state)
{
    (void)state;
    static const char *const skippers[] = { "tbr-re", "tbr-evr" };
    kit_sequence sequence = { 0 };
    for (size_t i = 0; i < 2; i++)
        for (uint32_t seed = 0; seed < 20; seed++) {
            kit_random(&sequence, seed, ADVERSE_NWOZ | ADVERSE_STATIC);
            kit_technique held;
            tbr *gpu = gpu_with(&held, skippers[i], sequence.width_px, sequence.height_px);
            for (uint32_t frame = 0; frame < sequence.count; frame++)
                draw(gpu, &sequence.frames[frame]);
            assert_int_equal(tbr_counts(gpu)->tiles_skipped, tbr_tile_count(gpu));
            assert_int_equal(tbr_counts(gpu)->fragments_rasterised, 0);
            assert_int_equal(tbr_counts(gpu)->flush_bytes, 0);
            assert_int_equal(tbr_counts(gpu)->signature_compares, tbr_tile_count(gpu));
            tbr_destroy(gpu);
            kit_technique_close(&held);
        }
    kit_sequence_free(&sequence);
}

/* ---- only what is needed runs ---- */

static void parts_that_nobody_needs_do_not_run(void **state)
{
    (void)state;
    kit_sequence woz = { 0 }, mixed = { 0 };
    kit_random(&woz, 3, 0);
    kit_random(&mixed, 4, ADVERSE_NWOZ);
    kit_technique plain, hiding;
    tbr *base = gpu_with(&plain, "tbr-base", mixed.width_px, mixed.height_px);
    tbr *evr = gpu_with(&hiding, "tbr-evr", woz.width_px, woz.height_px);
    draw(base, &mixed.frames[0]);
    draw(evr, &woz.frames[0]);
    const tbr_counters *b = tbr_counts(base), *e = tbr_counts(evr);
    assert_true(b->pairs > 0 && e->pairs > 0);
    assert_int_equal(b->layer_lookups + b->layer_bytes + b->fvp_reads + b->signed_pairs, 0);
    assert_int_equal(b->visibility_scans + b->layer_quad_writes + b->signature_compares, 0);
    assert_int_equal(e->layer_lookups + e->layer_bytes + e->layer_quad_writes, 0);
    assert_true(e->fvp_reads > 0 && e->signed_pairs > 0 && e->visibility_scans > 0);
    tbr_destroy(base);
    tbr_destroy(evr);
    kit_technique_close(&plain);
    kit_technique_close(&hiding);
    kit_sequence_free(&woz);
    kit_sequence_free(&mixed);
}

/* Without primitives that need layers, predictions and images are the same without them. */
static void layers_left_out_change_nothing(void **state)
{
    (void)state;
    kit_technique technique = kit_technique_open("tbr-evr-safe");
    kit_sequence sequence = { 0 };
    fm_error err = { 0 };
    for (uint32_t seed = 0; seed < 300; seed++) {
        tbr *gpus[2] = { NULL };
        kit_random(&sequence, seed,
                   seed % 2 == 0 ? ADVERSE_SLOPED | ADVERSE_TIES : ADVERSE_DISCARD);
        for (int i = 0; i < 2; i++) {
            const tbr_desc desc = { .width_px = sequence.width_px,
                                    .height_px = sequence.height_px,
                                    .technique = technique.plugin->method->technique,
                                    .parts = technique.parts,
                                    .threads = 1,
                                    .keep_layers = i == 1 };
            assert_int_equal(tbr_create(&gpus[i], &desc, &err), FM_OK);
        }
        for (uint32_t frame = 0; frame < sequence.count; frame++) {
            draw(gpus[0], &sequence.frames[frame]);
            draw(gpus[1], &sequence.frames[frame]);
            assert_int_equal(tbr_counts(gpus[0])->hidden_by_depth,
                             tbr_counts(gpus[1])->hidden_by_depth);
            assert_int_equal(tbr_counts(gpus[0])->tiles_skipped,
                             tbr_counts(gpus[1])->tiles_skipped);
            assert_int_equal(tbr_counts(gpus[0])->layer_lookups, 0);
            assert_memory_equal(tbr_image(gpus[0]), tbr_image(gpus[1]),
                                (size_t)sequence.width_px * sequence.height_px * 4);
        }
        tbr_destroy(gpus[0]);
        tbr_destroy(gpus[1]);
    }
    kit_sequence_free(&sequence);
    kit_technique_close(&technique);
}

/* Charts tell methods of a family by marker and dash. */
static void techniques_look_apart(void **state)
{
    (void)state;
    static const char *const ids[] = { "tbr-base",     "tbr-re",       "tbr-evr-reorder",
                                       "tbr-evr",      "tbr-evr-safe", "tbr-z-prepass",
                                       "tbr-oracle-z", "tbr-te",       "tbr-oracle-tile",
                                       "tbr-vro-lite" };
    enum { COUNT = sizeof ids / sizeof ids[0] };
    kit_technique held[COUNT];
    for (size_t i = 0; i < COUNT; i++) {
        held[i] = kit_technique_open(ids[i]);
        const fm_method_desc *one = held[i].plugin->method;
        for (size_t k = 0; k < i; k++) {
            const fm_method_desc *other = held[k].plugin->method;
            if (one->family == other->family && one->marker == other->marker &&
                one->dashed == other->dashed)
                fail_msg("%s looks like %s", one->id, other->id);
        }
    }
    for (size_t i = 0; i < COUNT; i++)
        kit_technique_close(&held[i]);
}

/* ---- threads and builds ---- */

static void counts_and_images_do_not_depend_on_threads_or_vectors(void **state)
{
    (void)state;
    static const char *const words[] = { "tbr-evr-safe", "tbr-oracle-z", "tbr-z-prepass" };
    kit_sequence sequence = { 0 };
    fm_error err = { 0 };
    for (uint32_t seed = 0; seed < 60; seed++) {
        kit_technique technique = kit_technique_open(words[seed % 3]);
        tbr *gpus[3] = { NULL };
        kit_random(&sequence, seed, ADVERSE_ALL);
        for (uint32_t i = 0; i < 3; i++) {
            const tbr_desc desc = { .width_px = sequence.width_px,
                                    .height_px = sequence.height_px,
                                    .technique = technique.plugin->method->technique,
                                    .parts = technique.parts,
                                    .threads = i == 1 ? 4 : 1,
                                    .no_vectors = i == 2 };
            assert_int_equal(tbr_create(&gpus[i], &desc, &err), FM_OK);
        }
        for (uint32_t frame = 0; frame < sequence.count; frame++)
            for (int i = 0; i < 3; i++) {
                draw(gpus[i], &sequence.frames[frame]);
                assert_memory_equal(tbr_counts(gpus[i]), tbr_counts(gpus[0]), sizeof(tbr_counters));
                assert_memory_equal(tbr_image(gpus[i]), tbr_image(gpus[0]),
                                    (size_t)sequence.width_px * sequence.height_px * 4);
            }
        for (int i = 0; i < 3; i++)
            tbr_destroy(gpus[i]);
        kit_technique_close(&technique);
    }
    kit_sequence_free(&sequence);
}

/* ---- models ---- */

static void energy_components_add_up(void **state)
{
    (void)state;
    model_table table;
    tbr_counters counters;
    uint64_t random = 5;
    double all_static = 0;
    assert_int_equal(model_table_read(&table, "", NULL), FM_OK);
    for (size_t i = 0; i < TBR_COUNTER_COUNT; i++) {
        const uint64_t value = random_below(&random, 100000);
        memcpy((char *)&counters + tbr_counter_infos[i].offset, &value, sizeof value);
    }
    counters.read_bytes = 1000000000; /* entries_read times their layers are part of it */
    const energy_inputs in = { .counters = &counters,
                               .cycles = 1e6,
                               .spilled = 0.25,
                               .has_visibility = true,
                               .has_signatures = true };
    const energy_result result = energy_of(&in, &table.nominal);
    double sum = 0;
    for (int i = 0; i < ENERGY_COMPONENT_COUNT; i++) {
        assert_true(result.component[i] > 0);
        sum += result.component[i];
    }
    assert_true(fabs(sum - result.total) <= 1e-9 * sum);
    const model_parameters *p = &table.nominal;
    /* 1e6 cycles at 400 MHz are 2.5 ms. */
    all_static = (p->logic_mw + p->dram_standby_mw + p->caches_mw + p->tile_buffers_mw) * 2.5e3;
    assert_true(fabs(result.component[ENERGY_STATIC] - all_static) < 1e-6 * all_static);
}

static void nothing_costs_nothing_but_time(void **state)
{
    (void)state;
    model_table table;
    const tbr_counters none = { 0 };
    assert_int_equal(model_table_read(&table, "", NULL), FM_OK);
    const energy_inputs in = { .counters = &none, .cycles = 0 };
    assert_true(fabs(energy_of(&in, &table.nominal).total) < 1e-12);
}

static void model_table_takes_overrides_and_names_the_nearest(void **state)
{
    (void)state;
    model_table table;
    fm_error err = { 0 };
    assert_int_equal(model_table_read(&table, "accumulate_cycles=7 clock_mhz=200", &err), FM_OK);
    assert_true(fabs(table.nominal.accumulate_cycles - 7) < 1e-12);
    assert_true(fabs(table.nominal.clock_mhz - 200) < 1e-12);
    assert_int_equal(model_table_read(&table, "acumulate_cycles=7", &err), FM_INVALID);
    assert_non_null(strstr(err.message, "nearest is 'accumulate_cycles'"));
    assert_int_equal(model_table_read(&table, "clock_mhz=0", &err), FM_INVALID);
    assert_int_equal(model_table_read(&table, "clock_mhz", &err), FM_INVALID);
    assert_int_equal(model_table_read(&table, "tile_queue=257", &err), FM_INVALID);
}

static const double exact = 1e-9;

/* One full-tile quad: each stage by hand. */
static void cycles_of_one_tile_are_as_on_paper(void **state)
{
    (void)state;
    model_table table;
    cycles *model = NULL;
    tbr *gpu = NULL;
    fm_error err = { 0 };
    fm_frame_builder builder = { 0 };
    assert_int_equal(model_table_read(&table, "", &err), FM_OK);
    assert_int_equal(cycles_create(&model, &table, 1, 1, &err), FM_OK);
    const tbr_desc desc = { .width_px = 16,
                            .height_px = 16,
                            .threads = 1,
                            .binned = cycles_binned,
                            .rendered = cycles_rendered,
                            .context = model };
    assert_int_equal(tbr_create(&gpu, &desc, &err), FM_OK);
    frame_builder_clear(&builder);
    add_rectangle(&builder, kit_draw(), (const int32_t[4]){ 0, 0, 16, 16 }, 0);
    draw(gpu, &builder);
    const cycles_frame frame = cycles_of_frame(model, tbr_counts(gpu));
    const double quads = 64 + 8; /* the diagonal's are both triangles' */
    assert_true(fabs(frame.stages[0] - (8.0 / 64 + 2 * 3)) < exact); /* 144 bytes: 3 lines */
    assert_true(fabs(frame.stages[1] - (2 * 4 + quads * 2)) <
                exact); /* 4 x 8 scalars, 16 a cycle */
    assert_true(fabs(frame.stages[2] - quads) < exact);
    /* 8 instructions x 4; 8 bytes of a quad's textures are 1/8 line, 75 / 16 cycles each. */
    assert_true(fabs(frame.stages[3] - quads * (32 + 75.0 / 16 / 8) / 4) < exact);
    assert_true(fabs(frame.stages[5] - (quads * 8 + 1024) / 4) < exact);
    assert_true(fabs(frame.raster[CYCLES_NOMINAL] - frame.stages[3]) < exact);
    /* Geometry: 4 vertices of 10 instructions are the slowest stage, but for 192 bytes / 4. */
    assert_true(fabs(frame.geometry[CYCLES_NOMINAL] - 48) < exact);
    assert_true(frame.raster_b >= frame.raster[CYCLES_NOMINAL]);
    frame_builder_free(&builder);
    tbr_destroy(gpu);
    cycles_destroy(model);
}

/* 64 quads that are shaded, then 64 that are not: rasterising these takes no time of its own, since
 * what is hidden waits for no fragment before it. */
static void hidden_quads_do_not_wait_for_shading_in_form_b(void **state)
{
    (void)state;
    model_table table;
    cycles *model = NULL;
    fm_error err = { 0 };
    fm_draw_call call = kit_draw();
    const tbr_work work[] = { { 0, 64, 64, false }, { 0, 64, 0, false } };
    const fm_frame frame = { .draws = &call, .draw_count = 1 };
    const tbr_tile_work tile = { .frame = &frame, .work = work, .count = 2, .flush_bytes = 1024 };
    assert_int_equal(model_table_read(&table, "", &err), FM_OK);
    assert_int_equal(cycles_create(&model, &table, 1, 1, &err), FM_OK);
    cycles_rendered(model, &tile);
    const cycles_frame result = cycles_of_frame(model, &(tbr_counters){ 0 });
    /* Before the first quad is shaded it is fetched (49 / 16 cycles) and set up (4). */
    assert_true(fabs(result.raster_b - (result.stages[3] + 49.0 / 16 + 4)) < exact);
    assert_true(fabs(result.raster[CYCLES_NOMINAL] - result.stages[3]) < exact);
    cycles_destroy(model);
}

/* 16 places, then each pair waits: n pairs at c cycles take n c, whatever the builder could do. */
static void signature_queue_stalls_the_list_builder(void **state)
{
    (void)state;
    model_table table;
    cycles *model = NULL;
    fm_error err = { 0 };
    fm_draw_call call = kit_draw();
    enum { PAIRS = 1000 };
    uint8_t is_signed[PAIRS];
    const uint32_t pairs = PAIRS, of_draw = 0;
    const bool is_prepassed = false;
    const fm_frame frame = { .draws = &call, .draw_count = 1 };
    const tbr_counters counters = { .pairs = PAIRS };
    memset(is_signed, 1, sizeof is_signed);
    assert_int_equal(model_table_read(&table, "accumulate_cycles=5", &err), FM_OK);
    assert_int_equal(cycles_create(&model, &table, 1, 1, &err), FM_OK);
    tbr_geometry geometry = { &frame, 1, &pairs, &of_draw, &is_prepassed, is_signed };
    cycles_binned(model, &geometry, &counters);
    /* 3 lines, 18 cycles of CRC, then 1 000 pairs of 5. */
    cycles_frame result = cycles_of_frame(model, &counters);
    assert_true(fabs(result.geometry[CYCLES_NOMINAL] - (3 + 18 + 5.0 * PAIRS)) < exact);
    assert_true(result.signature_stall > 3900);
    memset(is_signed, 0, sizeof is_signed);
    cycles_binned(model, &geometry, &counters);
    result = cycles_of_frame(model, &counters);
    assert_true(fabs(result.geometry[CYCLES_NOMINAL] - (3 + PAIRS)) < exact);
    assert_true(fabs(result.signature_stall) < exact);
    cycles_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crc_of_digits_is_the_published_check_value),
        cmocka_unit_test(crc_combined_is_the_crc_of_the_whole_at_any_split),
        cmocka_unit_test(quad_counts_as_on_paper),
        cmocka_unit_test(early_depth_test_shades_only_what_is_nearer),
        cmocka_unit_test(random_order_shades_the_harmonic_number),
        cmocka_unit_test(static_scenes_are_skipped_from_the_third_frame_on),
        cmocka_unit_test(parts_that_nobody_needs_do_not_run),
        cmocka_unit_test(layers_left_out_change_nothing),
        cmocka_unit_test(techniques_look_apart),
        cmocka_unit_test(counts_and_images_do_not_depend_on_threads_or_vectors),
        cmocka_unit_test(energy_components_add_up),
        cmocka_unit_test(nothing_costs_nothing_but_time),
        cmocka_unit_test(model_table_takes_overrides_and_names_the_nearest),
        cmocka_unit_test(cycles_of_one_tile_are_as_on_paper),
        cmocka_unit_test(hidden_quads_do_not_wait_for_shading_in_form_b),
        cmocka_unit_test(signature_queue_stalls_the_list_builder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
