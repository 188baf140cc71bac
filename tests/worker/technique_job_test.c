/* A sequence judged against the baseline: every frame counts, not the last one alone. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fragmark/technique.h"
#include "image/image_error.h"
#include "model/metrics.h"
#include "scene/frame_builder.h"
#include "scene/frame_stream.h"
#include "worker/protocol.h"
#include "worker/technique_job.h"

enum { WIDTH = 40, HEIGHT = 24, FRAMES = 40, WRONG_FRAME = 18, NEAR = 5, UNSIGNED = 4 };

/* Rendering elimination that forgets to sign whatever comes as near as UNSIGNED: a tile in which
 * nothing else changes keeps the colours of the frame before. */
static bool sign(uint32_t *bits, const fm_pair *pair, fm_prediction prediction)
{
    (void)bits;
    (void)prediction;
    return pair->depth_near > 2 * UNSIGNED;
}

static bool keeps_tile(const fm_tile_start *tile)
{
    return tile->previous_valid && tile->signature == tile->previous;
}

static const fm_technique forgetful = { .parts = FM_PART_SIGNATURES,
                                        .sign = sign,
                                        .skip = keeps_tile };
static const fm_method_desc method = { .id = "forgetful", .technique = &forgetful };

static void add_quad(fm_frame_builder *builder, const int32_t px[4], uint32_t z)
{
    const fm_draw_call draw = { .flags = FM_DRAW_DEPTH_WRITE,
                                .depth_test = FM_COMPARE_LESS,
                                .mask = 15,
                                .alpha = 255,
                                .shader = z, /* else they have the same colours */
                                .vertices = 4,
                                .vertex_instructions = 10,
                                .attribute_bytes = 144,
                                .scalars = 8,
                                .vertex_bytes = 48 };
    frame_builder_draw(builder, &draw);
    frame_builder_quad(builder, px, z);
}

/* The wide quad in every frame that has any; in frame `extra` 8 x 8 pixels that the technique
 * forgets, within tile (1, 0). */
typedef struct test_sequence {
    uint32_t frames;
    uint32_t first_drawn; /* frames before it are empty */
    uint32_t extra;
    char stream[64], truth[80], image[80];
    fm_settings settings;
} test_sequence;

static void set(fm_settings *settings, const char *name, const char *value)
{
    fm_error err = { 0 };
    if (settings_set(settings, key_find(name), value, &err) != FM_OK)
        fail_msg("%s", err.message);
}

static void build_frame(fm_frame_builder *builder, const test_sequence *sequence, uint32_t frame)
{
    frame_builder_clear(builder);
    builder->frame.clear_depth = FRAMES_DEPTH_MAX;
    if (frame >= sequence->first_drawn)
        add_quad(builder, (const int32_t[4]){ 0, 0, WIDTH, HEIGHT }, NEAR);
    if (frame == sequence->extra)
        add_quad(builder, (const int32_t[4]){ 20, 4, 28, 12 }, UNSIGNED);
}

static void write_stream(const test_sequence *sequence)
{
    fm_stream_writer writer = { 0 };
    fm_frame_builder builder = { 0 };
    fm_error err = { 0 };
    assert_int_equal(stream_writer_open(&writer, sequence->stream, WIDTH, HEIGHT, &err), FM_OK);
    for (uint32_t i = 0; i < sequence->frames; i++) {
        build_frame(&builder, sequence, i);
        assert_int_equal(stream_writer_add(&writer, &builder.frame, &err), FM_OK);
    }
    assert_int_equal(stream_writer_close(&writer, &err), FM_OK);
    frame_builder_free(&builder);
}

static void sequence_open(test_sequence *made)
{
    char text[16];
    fm_error err = { 0 };
    snprintf(made->stream, sizeof made->stream, "/tmp/fragmark-sequence-XXXXXX");
    close(mkstemp(made->stream));
    snprintf(made->truth, sizeof made->truth, "%s.truth", made->stream);
    snprintf(made->image, sizeof made->image, "%s.rgba32f", made->stream);
    write_stream(made);
    settings_default(&made->settings);
    set(&made->settings, "generator", "stream");
    set(&made->settings, "stream", made->stream);
    snprintf(text, sizeof text, "%d", WIDTH);
    set(&made->settings, "width_px", text);
    snprintf(text, sizeof text, "%d", HEIGHT);
    set(&made->settings, "height_px", text);
    snprintf(text, sizeof text, "%u", made->frames);
    set(&made->settings, "sequence_frames", text);
    if (settings_finish(&made->settings, &err) != FM_OK)
        fail_msg("%s", err.message);
}

static void sequence_close(const test_sequence *made)
{
    char path[96];
    snprintf(path, sizeof path, "%s.truth.rgba32f", made->stream);
    unlink(path);
    unlink(made->image);
    unlink(made->truth);
    unlink(made->stream);
}

/* The baseline first, then the technique, or the baseline again with NULL. */
static json_t *judge(fm_technique_outcome *outcome, const test_sequence *made,
                     const fm_method_desc *judged)
{
    fm_error err = { 0 };
    fm_technique_job job = { .settings = &made->settings, .truth = made->truth, .image = "" };
    json_t *answer = json_object();
    if (technique_job_run(answer, outcome, &job, &err) != FM_OK)
        fail_msg("%s", err.message);
    if (judged == NULL)
        return answer;
    json_decref(answer);
    answer = json_object();
    job.method = judged;
    job.image = made->image;
    if (technique_job_run(answer, outcome, &job, &err) != FM_OK)
        fail_msg("%s", err.message);
    return answer;
}

static double metric(const json_t *answer, fm_metric which)
{
    const json_t *value = json_object_get(answer_metrics(answer), fm_metrics[which].name);
    if (json_is_string(value))
        return strcmp(json_string_value(value), "inf") == 0 ? INFINITY : NAN;
    assert_non_null(value);
    return json_number_value(value);
}

/* The last frame is right: frame WRONG_FRAME alone has the tile. */
static void one_wrong_tile_within_a_sequence_shows(void **state)
{
    (void)state;
    test_sequence made = { .frames = FRAMES, .extra = WRONG_FRAME };
    fm_technique_outcome outcome;
    fm_image *image = NULL, *truth = NULL;
    fm_image_error compared;
    fm_error err = { 0 };
    char path[96];
    sequence_open(&made);
    json_t *answer = judge(&outcome, &made, &method);
    assert_int_equal(outcome.wrong_tiles, 1);
    assert_int_equal(outcome.wrong_frames, 1);
    assert_int_equal(outcome.first_wrong_frame, WRONG_FRAME);
    assert_int_equal(outcome.frames, FRAMES);
    assert_int_equal((int)metric(answer, FM_METRIC_WRONG_TILES), 1);
    assert_int_equal((int)metric(answer, FM_METRIC_WRONG_FRAMES), 1);

    /* The wrong frame's picture and truth are kept, and the sequence's errors follow from them. */
    snprintf(path, sizeof path, "%s.truth.rgba32f", made.stream);
    assert_int_equal(image_read(&image, made.image, &err), FM_OK);
    assert_int_equal(image_read(&truth, path, &err), FM_OK);
    const image_compare_desc pair = { .image = image, .reference = truth };
    assert_int_equal(image_compare(&compared, &pair, &err), FM_OK);
    const fm_region_error apart = compared.region[FM_REGION_VIEWPORT];
    assert_true(apart.difference.rmse > 0.01 && apart.flip.mean > 0.01);
    const double rmse = apart.difference.rmse / sqrt(FRAMES);
    assert_true(fabs(metric(answer, FM_METRIC_RMSE) - rmse) < 1e-12);
    assert_true(fabs(metric(answer, FM_METRIC_PSNR_DB) + 20.0 * log10(rmse)) < 1e-9);
    assert_true(fabs(metric(answer, FM_METRIC_MAX_ABS) - apart.difference.max_abs) < 1e-12);
    const double ssim = 1.0 - (1.0 - apart.ssim) / FRAMES;
    assert_true(fabs(metric(answer, FM_METRIC_SSIM) - ssim) < 1e-12);
    assert_true(fabs(metric(answer, FM_METRIC_FLIP) - apart.flip.mean / FRAMES) < 1e-12);
    image_destroy(image);
    image_destroy(truth);
    json_decref(answer);
    sequence_close(&made);
}

static void right_sequence_has_no_error_and_no_picture(void **state)
{
    (void)state;
    test_sequence made = { .frames = 3, .extra = UINT32_MAX };
    fm_technique_outcome outcome;
    sequence_open(&made);
    json_t *answer = judge(&outcome, &made, &method);
    assert_int_equal(outcome.wrong_tiles, 0);
    assert_int_equal(outcome.wrong_frames, 0);
    assert_true(metric(answer, FM_METRIC_RMSE) <= 0.0);
    assert_true(metric(answer, FM_METRIC_MAX_ABS) <= 0.0);
    assert_true(metric(answer, FM_METRIC_SSIM) >= 1.0);
    assert_true(isinf(metric(answer, FM_METRIC_PSNR_DB)));
    assert_int_not_equal(access(made.image, F_OK), 0);
    json_decref(answer);
    sequence_close(&made);
}

/* Runs both with a file of wrong frames. */
static void judge_kept(kept_map *map, const test_sequence *made, uint64_t kept_bytes)
{
    char path[96];
    fm_technique_outcome outcome;
    fm_error err = { 0 };
    snprintf(path, sizeof path, "%s.frames", made->stream);
    json_decref(judge(&outcome, made, NULL));
    const fm_technique_job job = { .method = &method,
                                   .settings = &made->settings,
                                   .truth = made->truth,
                                   .image = "",
                                   .keep = path,
                                   .kept_bytes = kept_bytes };
    json_t *answer = json_object();
    if (technique_job_run(answer, &outcome, &job, &err) != FM_OK)
        fail_msg("%s", err.message);
    if (kept_open(map, path, &err) != FM_OK)
        fail_msg("%s", err.message);
    json_decref(answer);
    unlink(path);
}

static void wrong_tiles_are_kept_with_both_pictures(void **state)
{
    (void)state;
    test_sequence made = { .frames = 5, .extra = 2 };
    kept_map map;
    const uint32_t *pictures[2];
    uint32_t apart = 0;
    sequence_open(&made);
    judge_kept(&map, &made, 0);
    assert_int_equal(map.header->kind, KEPT_FRAMES);
    assert_int_equal(map.header->list_count, 5);
    assert_int_equal(map.header->item_count, 1);
    assert_int_equal(map.offsets[2], 0); /* of frame 2 */
    assert_int_equal(map.offsets[3], 1);
    const kept_tile *tile = map.items;
    assert_int_equal(tile->tile, 1);
    assert_int_equal(tile->wrong_pixels, 64);
    assert_true(kept_pictures(pictures, &map, 2));
    for (uint32_t y = 4; y < 12; y++)
        for (uint32_t x = 20; x < 28; x++)
            apart += pictures[0][y * WIDTH + x] != pictures[1][y * WIDTH + x];
    assert_int_equal(apart, 64);
    assert_int_equal(pictures[0][0], pictures[1][0]);
    kept_close(&map);
    sequence_close(&made);
}

static void pictures_beyond_the_limit_are_not_kept(void **state)
{
    (void)state;
    test_sequence made = { .frames = 5, .extra = 2 };
    kept_map map;
    const uint32_t *pictures[2];
    sequence_open(&made);
    judge_kept(&map, &made, 2 * 4 * WIDTH * HEIGHT - 1);
    assert_int_equal(map.header->item_count, 1);
    assert_int_equal(map.header->word_count, 0);
    assert_false(kept_pictures(pictures, &map, 2));
    kept_close(&map);
    judge_kept(&map, &made, 2 * 4 * WIDTH * HEIGHT);
    assert_true(kept_pictures(pictures, &map, 2));
    kept_close(&map);
    sequence_close(&made);
}

/* Counters leave the first frame out; whether anything was drawn is a question of all frames. */
static void fragments_of_the_first_frame_count_as_drawn(void **state)
{
    (void)state;
    static const struct {
        test_sequence made;
        bool is_drawn;
    } rows[] = {
        { { .frames = 3, .first_drawn = 3, .extra = UINT32_MAX }, false },
        { { .frames = 3, .first_drawn = 3, .extra = 0 }, true },
        { { .frames = 3, .first_drawn = 2, .extra = UINT32_MAX }, true },
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        test_sequence made = rows[i].made;
        fm_technique_outcome outcome;
        sequence_open(&made);
        json_decref(judge(&outcome, &made, NULL));
        assert_int_equal(outcome.fragments > 0, rows[i].is_drawn);
        sequence_close(&made);
    }
}

/* Launches are compared by it: a frame within the sequence must count. */
static void image_hash_is_of_all_frames(void **state)
{
    (void)state;
    test_sequence wrong = { .frames = 5, .extra = 2 };
    fm_technique_outcome outcome;
    sequence_open(&wrong);
    json_t *right = judge(&outcome, &wrong, NULL);
    json_t *answer = judge(&outcome, &wrong, &method);
    assert_false(json_equal(answer_image_hashes(right), answer_image_hashes(answer)));
    json_decref(right);
    json_decref(answer);
    sequence_close(&wrong);
}

static void truth_of_another_sequence_is_refused(void **state)
{
    (void)state;
    test_sequence made = { .frames = 3, .extra = 1 };
    fm_technique_outcome outcome;
    fm_error err = { 0 };
    FILE *file;
    sequence_open(&made);
    json_decref(judge(&outcome, &made, NULL));
    /* A wrong hash of a tile that the technique draws right: only the baseline can tell. */
    file = fopen(made.truth, "r+b");
    assert_non_null(file);
    assert_int_equal(fseek(file, -1, SEEK_END), 0);
    const int last = fgetc(file);
    assert_int_equal(fseek(file, -1, SEEK_END), 0);
    fputc(last ^ 1, file);
    fclose(file);
    json_t *answer = json_object();
    const fm_technique_job job = {
        .method = &method, .settings = &made.settings, .truth = made.truth, .image = ""
    };
    assert_int_equal(technique_job_run(answer, &outcome, &job, &err), FM_IO);
    assert_non_null(strstr(err.message, "not the truth of this sequence"));
    json_decref(answer);
    sequence_close(&made);
}

/* Hooks that answer what is no answer, or write to what they are shown. */
static fm_prediction foretells_nonsense(const fm_pair *pair)
{
    static const unsigned nonsense = 77;
    fm_prediction prediction;
    (void)pair;
    memcpy(&prediction, &nonsense, sizeof prediction);
    return prediction;
}

static fm_place places_nowhere(const fm_pair *pair, fm_prediction prediction)
{
    static const unsigned nonsense = 78;
    fm_place place;
    (void)pair;
    (void)prediction;
    memcpy(&place, &nonsense, sizeof place);
    return place;
}

static fm_prediction rewrites_the_pair(const fm_pair *pair)
{
    fm_pair *written;
    memcpy(&written, &pair, sizeof written);
    written->layer += 1;
    return FM_VISIBLE;
}

static void ends_nowhere(fm_tile_end *tile)
{
    static const unsigned nonsense = 79;
    memcpy(&tile->outcome, &nonsense, sizeof tile->outcome);
}

static void ends_neither_true_nor_false(fm_tile_end *tile)
{
    memset(&tile->signature_valid, 80, sizeof tile->signature_valid);
}

static void what_hooks_answer_is_checked(void **state)
{
    (void)state;
    static const struct {
        fm_technique technique;
        const char *message;
    } wrong[] = {
        { { .parts = FM_PART_VISIBILITY, .predict = foretells_nonsense },
          "hooked: frame 0: technique: predict: answered 77 in tile 0, no such value" },
        { { .place = places_nowhere },
          "hooked: frame 0: technique: place: answered 78 in tile 0, no such value" },
        { { .parts = FM_PART_VISIBILITY, .predict = rewrites_the_pair },
          "hooked: frame 0: technique: a hook wrote to the pair in tile 0, which is constant" },
        { { .tile_end = ends_nowhere },
          "hooked: frame 0: technique: tile_end: outcome: 79 in tile 0, no such value" },
        { { .tile_end = ends_neither_true_nor_false },
          "hooked: frame 0: technique: tile_end: signature_valid: 80 in tile 0, no such value" },
    };
    test_sequence made = { .frames = 2, .extra = 1 };
    fm_technique_outcome outcome;
    sequence_open(&made);
    json_decref(judge(&outcome, &made, NULL));
    assert_false(outcome.is_techniques);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        const fm_method_desc hooked = { .id = "hooked", .technique = &wrong[i].technique };
        const fm_technique_job job = {
            .settings = &made.settings, .truth = made.truth, .image = "", .method = &hooked
        };
        fm_error err = { 0 };
        json_t *answer = json_object();
        assert_int_equal(technique_job_run(answer, &outcome, &job, &err), FM_INVALID);
        assert_string_equal(err.message, wrong[i].message);
        assert_true(outcome.is_techniques);
        json_decref(answer);
    }
    sequence_close(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_wrong_tile_within_a_sequence_shows),
        cmocka_unit_test(right_sequence_has_no_error_and_no_picture),
        cmocka_unit_test(wrong_tiles_are_kept_with_both_pictures),
        cmocka_unit_test(pictures_beyond_the_limit_are_not_kept),
        cmocka_unit_test(fragments_of_the_first_frame_count_as_drawn),
        cmocka_unit_test(image_hash_is_of_all_frames),
        cmocka_unit_test(truth_of_another_sequence_is_refused),
        cmocka_unit_test(what_hooks_answer_is_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
