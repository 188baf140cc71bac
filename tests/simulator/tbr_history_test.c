/* The simulated GPU's memory of frames: order of objects, two frame buffers, uploads. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "simulator/history.h"
#include "tbr_kit.h"

enum { SIDE = 32, TILES = 4 };

typedef struct runner {
    kit_technique technique;
    tbr *gpu;
} runner;

static runner runner_new(const char *words)
{
    runner made = { .technique = kit_technique_open(words) };
    made.gpu = kit_gpu(&made.technique, SIDE, SIDE);
    return made;
}

static void runner_free(runner *with)
{
    tbr_destroy(with->gpu);
    kit_technique_close(&with->technique);
}

/* A frame of whole-screen quads at these depths, each an object of its own. */
static const tbr_counters *draw_quads(runner *with, const uint32_t *depths, uint32_t count,
                                      uint32_t texture_version)
{
    fm_frame_builder builder = { 0 };
    fm_error err = { 0 };
    frame_builder_clear(&builder);
    for (uint32_t i = 0; i < count; i++) {
        fm_draw_call call = kit_woz();
        call.object = (uint16_t)i;
        call.texture = 1;
        call.texture_version = texture_version;
        frame_builder_draw(&builder, &call);
        frame_builder_quad(&builder, (const int32_t[4]){ 0, 0, SIDE, SIDE }, depths[i]);
    }
    assert_int_equal(frame_check(&builder.frame, 0, &err), FM_OK);
    assert_int_equal(tbr_frame(with->gpu, &builder.frame, &err), FM_OK);
    frame_builder_free(&builder);
    return tbr_counts(with->gpu);
}

static void vro_lite_draws_objects_nearest_first(void **state)
{
    (void)state;
    const uint32_t depths[] = { 900, 500, 100 };
    runner with = runner_new("tbr-vro-lite");
    assert_int_equal(draw_quads(&with, depths, 3, 0)->fragments_shaded, 3 * SIDE * SIDE);
    assert_int_equal(draw_quads(&with, depths, 3, 0)->fragments_shaded, SIDE * SIDE);
    runner_free(&with);
}

/* One that comes with the frame is drawn last, and hidden by what the last frame had. */
static void new_objects_come_last(void **state)
{
    (void)state;
    const uint32_t depths[] = { 900, 500, 700 };
    runner with = runner_new("tbr-vro-lite");
    draw_quads(&with, depths, 2, 0);
    assert_int_equal(draw_quads(&with, depths, 3, 0)->fragments_shaded, SIDE * SIDE);
    runner_free(&with);
}

static void order_stays_within_stretches_that_may_move(void **state)
{
    (void)state;
    enum { DRAWS = 5 };
    static const uint32_t wanted[DRAWS] = { 1, 0, 2, 4, 3 };
    const bool may_move[DRAWS] = { true, true, false, true, true };
    fm_draw_call draws[DRAWS];
    fm_triangle triangles[DRAWS];
    uint32_t order[DRAWS];
    history *past = NULL;
    fm_error err = { 0 };
    memset(triangles, 0, sizeof triangles);
    for (uint32_t i = 0; i < DRAWS; i++) {
        draws[i] = kit_woz();
        draws[i].object = (uint16_t)i;
        draws[i].first = i;
        draws[i].count = 1;
        for (int c = 0; c < 3; c++)
            triangles[i].corners[c].z = 100 - i;
    }
    const fm_frame frame = {
        .draws = draws, .draw_count = DRAWS, .triangles = triangles, .triangle_count = DRAWS
    };
    assert_int_equal(history_create(&past, &err), FM_OK);
    assert_int_equal(history_order(order, past, &frame, may_move, &err), FM_OK);
    for (uint32_t i = 0; i < DRAWS; i++)
        assert_int_equal(order[i], i); /* nothing is known yet */
    assert_int_equal(history_order(order, past, &frame, may_move, &err), FM_OK);
    assert_memory_equal(order, wanted, sizeof wanted);
    history_destroy(past);
}

/* Two pictures in turns: the last frame is never the same, the one before always. */
static void two_buffers_compare_with_the_frame_before_the_last(void **state)
{
    (void)state;
    const uint32_t pictures[2][1] = { { 100 }, { 200 } };
    runner one = runner_new("tbr-re"), two = runner_new("tbr-re age=2");
    for (uint32_t i = 0; i < 6; i++) {
        assert_int_equal(draw_quads(&one, pictures[i % 2], 1, 0)->tiles_skipped, 0);
        const tbr_counters *counts = draw_quads(&two, pictures[i % 2], 1, 0);
        assert_int_equal(counts->tiles_skipped, i < 2 ? 0 : TILES);
        assert_memory_equal(tbr_image(one.gpu), tbr_image(two.gpu), SIDE * SIDE * 4);
    }
    runner_free(&one);
    runner_free(&two);
}

/* By its version an upload changes what reads the texture; as published it stops all skipping. */
static void uploads_disable_skipping_where_asked(void **state)
{
    (void)state;
    static const uint32_t versions[] = { 1, 1, 2, 2 };
    const uint32_t depths[] = { 100 };
    runner with = runner_new("tbr-re uploads=disable");
    for (uint32_t i = 0; i < 4; i++)
        assert_int_equal(draw_quads(&with, depths, 1, versions[i])->tiles_skipped,
                         i == 1 || i == 3 ? TILES : 0);
    runner_free(&with);
}

static void uploads_of_many_textures_are_told(void **state)
{
    (void)state;
    enum { DRAWS = 1000 };
    fm_draw_call draws[DRAWS] = { 0 };
    const fm_frame frame = { .draws = draws, .draw_count = DRAWS };
    history *past = NULL;
    fm_error err = { 0 };
    bool has_uploads = true;
    assert_int_equal(history_create(&past, &err), FM_OK);
    for (uint32_t i = 0; i < DRAWS; i++)
        draws[i].texture = i * 65536;
    for (int frames = 0; frames < 2; frames++) {
        assert_int_equal(history_uploads(&has_uploads, past, &frame, &err), FM_OK);
        assert_false(has_uploads); /* new, then known */
    }
    draws[777].texture_version = 1;
    assert_int_equal(history_uploads(&has_uploads, past, &frame, &err), FM_OK);
    assert_true(has_uploads);
    history_destroy(past);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vro_lite_draws_objects_nearest_first),
        cmocka_unit_test(new_objects_come_last),
        cmocka_unit_test(order_stays_within_stretches_that_may_move),
        cmocka_unit_test(two_buffers_compare_with_the_frame_before_the_last),
        cmocka_unit_test(uploads_disable_skipping_where_asked),
        cmocka_unit_test(uploads_of_many_textures_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
