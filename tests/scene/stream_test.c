/* Recorded sequences: files that are whole, files that are not, OpenGL's feedback as triangles, and
 * the recording in scenes/frames/ through all techniques. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "record/polygons.h"
#include "scene/frame_builder.h"
#include "scene/frame_stream.h"
#include "simulator/tbr_kit.h"

static const fm_stream_costs costs = { .vertex_instructions = 12,
                                       .fragment_instructions = 8,
                                       .texture_bytes = 2 };

/* ---- files ---- */

typedef struct stream_file {
    char folder[32], path[64];
} stream_file;

static stream_file file_new(void)
{
    stream_file made = { .folder = "/tmp/fragmark-stream-XXXXXX" };
    assert_non_null(mkdtemp(made.folder));
    snprintf(made.path, sizeof made.path, "%s/a.stream", made.folder);
    return made;
}

static void file_remove(const stream_file *file)
{
    unlink(file->path);
    assert_int_equal(rmdir(file->folder), 0); /* nothing else was left */
}

/* `count` frames; frame i has i + 1 quads. */
static void write_frames(const stream_file *file, uint32_t count)
{
    fm_stream_writer writer;
    fm_frame_builder builder = { 0 };
    fm_error err = { 0 };
    assert_int_equal(stream_writer_open(&writer, file->path, 64, 48, &err), FM_OK);
    for (uint32_t i = 0; i < count; i++) {
        frame_builder_clear(&builder);
        for (int32_t k = 0; k <= (int32_t)i; k++) {
            fm_draw_call draw = kit_woz();
            draw.texture_bytes16 = 32; /* two textures */
            frame_builder_draw(&builder, &draw);
            frame_builder_quad(&builder, (const int32_t[4]){ k, 0, 20 + k, 30 }, 7);
        }
        assert_int_equal(stream_writer_add(&writer, &builder.frame, &err), FM_OK);
    }
    assert_int_equal(stream_writer_close(&writer, &err), FM_OK);
    frame_builder_free(&builder);
}

static void stream_gives_back_what_was_written(void **state)
{
    (void)state;
    const stream_file file = file_new();
    fm_sequence *sequence = NULL;
    const fm_frame *frame = NULL;
    fm_error err = { 0 };
    write_frames(&file, 3);
    assert_int_equal(stream_open(&sequence, file.path, 3, &costs, &err), FM_OK);
    assert_int_equal(sequence->width_px, 64);
    assert_int_equal(sequence->height_px, 48);
    for (uint32_t i = 3; i-- > 0;) {
        assert_int_equal(sequence->frame(sequence, &frame, i, &err), FM_OK);
        assert_int_equal(frame_check(frame, i, &err), FM_OK);
        assert_int_equal(frame->draw_count, i + 1);
        assert_int_equal(frame->triangle_count, 2 * (i + 1));
        assert_int_equal(frame->triangles[frame->draws[i].first].corners[0].x,
                         (int32_t)i * FRAMES_SUBPIXELS);
        assert_int_equal(frame->draws[i].fragment_instructions, 8);
        assert_int_equal(frame->draws[i].texture_bytes16, 64);
    }
    sequence_destroy(sequence);
    file_remove(&file);
}

static void stream_without_frames_leaves_no_file(void **state)
{
    (void)state;
    const stream_file file = file_new();
    write_frames(&file, 0);
    assert_int_not_equal(access(file.path, F_OK), 0);
    file_remove(&file);
}

static void assert_refused(const stream_file *file, fm_status wanted, const char *words)
{
    fm_sequence *sequence = NULL;
    fm_error err = { 0 };
    assert_int_equal(stream_open(&sequence, file->path, 3, &costs, &err), wanted);
    assert_null(sequence);
    assert_non_null(strstr(err.message, file->path));
    assert_non_null(strstr(err.message, words));
}

static void stream_open_refuses_what_is_not_whole(void **state)
{
    (void)state;
    const stream_file file = file_new();
    char *bytes = NULL;
    size_t count = 0;
    assert_refused(&file, FM_IO, "No such file");
    write_frames(&file, 2);
    assert_refused(&file, FM_INVALID, "sequence_frames = 3: it holds 2");
    write_frames(&file, 3);
    assert_int_equal(text_read_file(&bytes, &count, file.path, 1 << 20, NULL), FM_OK);
    assert_int_equal(text_write_file(file.path, bytes, count - 1, NULL), FM_OK);
    assert_refused(&file, FM_INVALID, "frame 2 is cut off");
    bytes[sizeof(fm_stream_head) + 11] = '\x7F'; /* of the first frame's number of draw calls */
    assert_int_equal(text_write_file(file.path, bytes, count, NULL), FM_OK);
    assert_refused(&file, FM_INVALID, "frame 0 is cut off");
    bytes[8] = 9;
    assert_int_equal(text_write_file(file.path, bytes, count, NULL), FM_OK);
    assert_refused(&file, FM_INVALID, "version 9");
    bytes[0] = 'x';
    assert_int_equal(text_write_file(file.path, bytes, count, NULL), FM_OK);
    assert_refused(&file, FM_INVALID, "not a stream");
    free(bytes);
    file_remove(&file);
}

/* ---- feedback ---- */

enum { POINT = 0x0701, POLYGON = 0x0703 };

/* A corner at (x, y), half deep, white with the given alpha. */
static size_t add_corner(float *to, float x, float y, float alpha)
{
    const float corner[POLYGON_FLOATS] = { x, y, 0.5f, 1, 1, 1, alpha, 0.25f, 0.5f, 0, 1 };
    memcpy(to, corner, sizeof corner);
    return POLYGON_FLOATS;
}

static size_t add_square(float *to, float side, float alpha)
{
    size_t count = 0;
    to[count++] = POLYGON;
    to[count++] = 4;
    count += add_corner(to + count, 0, 0, 1);
    count += add_corner(to + count, side, 0, alpha);
    count += add_corner(to + count, side, side, 1);
    return count + add_corner(to + count, 0, side, 1);
}

typedef struct heard {
    fm_frame_builder builder;
    polygon_totals totals;
    polygon_alpha alpha;
} heard;

static heard hear(const float *values, size_t count, const polygon_view *view)
{
    heard made = { .totals = { 0 } };
    const fm_draw_call draw = kit_draw();
    frame_builder_clear(&made.builder);
    frame_builder_draw(&made.builder, &draw);
    made.alpha = polygons_add(&made.builder, &made.totals, values, count, view);
    return made;
}

static void feedback_becomes_fans_with_rows_from_the_top(void **state)
{
    (void)state;
    float values[64];
    const size_t count = add_square(values, 10, 0.5f);
    const polygon_view view = { .height_px = 40, .texture_width = 8, .texture_height = 4 };
    heard got = hear(values, count, &view);
    const fm_corner *corner = &got.builder.frame.triangles[0].corners[1];
    assert_int_equal(got.totals.triangles, 2);
    assert_int_equal(got.builder.frame.triangle_count, 2);
    assert_int_equal(corner->x, 160);
    assert_int_equal(corner->y, 640);
    assert_int_equal(corner[1].y, 480);
    assert_int_equal(corner->z, 0x800000);
    assert_int_equal(corner->u & 0xFFFF, 0); /* 2 texels, moved by whole ones */
    assert_int_equal(corner->v, 2 << 16);
    assert_float_equal(got.alpha.least, 0.5f, 0);
    assert_float_equal(got.alpha.most, 1, 0);
    frame_builder_free(&got.builder);
}

static void feedback_of_another_colour_is_another_picture(void **state)
{
    (void)state;
    float values[64];
    const polygon_view view = { .height_px = 40 };
    heard one = hear(values, add_square(values, 10, 0.5f), &view);
    heard same = hear(values, add_square(values, 10, 0.5f), &view);
    heard other = hear(values, add_square(values, 10, 0.6f), &view);
    const uint32_t u = one.builder.frame.triangles[0].corners[0].u;
    assert_int_equal(u, same.builder.frame.triangles[0].corners[0].u);
    assert_int_not_equal(u, other.builder.frame.triangles[0].corners[0].u);
    frame_builder_free(&one.builder);
    frame_builder_free(&same.builder);
    frame_builder_free(&other.builder);
}

static void feedback_is_clipped_to_the_scissor(void **state)
{
    (void)state;
    float values[64];
    const size_t count = add_square(values, 10, 1);
    polygon_view view = { .height_px = 40, .has_scissor = true, .left = 2, .bottom = 3 };
    view.right = 7;
    view.top = 100;
    heard got = hear(values, count, &view);
    assert_true(got.builder.frame.triangle_count >= 2);
    for (uint32_t i = 0; i < got.builder.frame.triangle_count; i++)
        for (int c = 0; c < 3; c++) {
            const fm_corner *corner = &got.builder.frame.triangles[i].corners[c];
            assert_in_range(corner->x, 2 * 16, 7 * 16);
            assert_in_range(corner->y, (40 - 10) * 16, (40 - 3) * 16);
        }
    frame_builder_free(&got.builder);
    view.right = 0;
    got = hear(values, count, &view);
    assert_int_equal(got.builder.frame.triangle_count, 0);
    frame_builder_free(&got.builder);
}

static void feedback_counts_points_and_ends_at_nonsense(void **state)
{
    (void)state;
    float values[128] = { POINT };
    const polygon_view view = { .height_px = 40 };
    size_t count = 1 + add_corner(values + 1, 1, 1, 1);
    count += add_square(values + count, 10, 1);
    heard got = hear(values, count, &view);
    assert_int_equal(got.totals.dropped, 1);
    assert_int_equal(got.totals.triangles, 2);
    frame_builder_free(&got.builder);
    got = hear(values, count - 1, &view); /* the square is cut off */
    assert_int_equal(got.totals.triangles, 0);
    frame_builder_free(&got.builder);
    values[0] = 3;
    got = hear(values, count, &view);
    assert_int_equal(got.totals.dropped + got.totals.triangles, 0);
    frame_builder_free(&got.builder);
}

/* ---- the recording ---- */

static fm_sequence *open_demo(void)
{
    char path[1024];
    const char *source = getenv("FRAGMARK_SOURCE_DIR");
    fm_sequence *sequence = NULL;
    fm_error err = { 0 };
    snprintf(path, sizeof path, "%s/scenes/frames/gl-demo.stream", source != NULL ? source : ".");
    if (stream_open(&sequence, path, 12, &costs, &err) != FM_OK)
        fail_msg("%s", err.message);
    return sequence;
}

static const fm_frame *frame_of(fm_sequence *sequence, uint32_t index)
{
    const fm_frame *frame = NULL;
    fm_error err = { 0 };
    if (sequence->frame(sequence, &frame, index, &err) != FM_OK ||
        frame_check(frame, index, &err) != FM_OK)
        fail_msg("%s", err.message);
    return frame;
}

/* What the program does is in the recording. */
static void recording_tells_states_apart(void **state)
{
    (void)state;
    fm_sequence *sequence = open_demo();
    const fm_frame *frame = frame_of(sequence, 0);
    uint32_t count[FM_TYPE_COUNT] = { 0 }, clears = 0, discards = 0, blended = 0;
    for (uint32_t i = 0; i < frame->draw_count; i++) {
        const fm_draw_call *draw = &frame->draws[i];
        clears += (draw->flags & FM_DRAW_DEPTH_CLEAR) != 0;
        discards += (draw->flags & FM_DRAW_DISCARD) != 0;
        blended += draw->mix == FM_MIX_OVER && (draw->flags & FM_DRAW_TEXTURED_ALPHA) != 0;
        if ((draw->flags & FM_DRAW_DEPTH_CLEAR) == 0)
            count[tbr_type(draw, 0)]++;
    }
    assert_int_equal(count[FM_TYPE_WOZ], 7); /* ground, five cones, one on the panel */
    assert_int_equal(count[FM_TYPE_NWOZ], 4);
    assert_int_equal(clears, 1);
    assert_int_equal(discards, 1);
    assert_int_equal(blended, 1);
    const uint32_t version = frame->draws[6].texture_version;
    assert_int_equal(frame_of(sequence, 11)->draws[6].texture_version, version + 1);
    sequence_destroy(sequence);
}

static void replay(const char *words, bool must_skip)
{
    fm_error err = { 0 };
    uint64_t skipped = 0;
    fm_sequence *sequence = open_demo();
    kit_technique plain = kit_technique_open("tbr-base"), tried = kit_technique_open(words);
    tbr *base = kit_gpu(&plain, 320, 240), *gpu = kit_gpu(&tried, 320, 240);
    for (uint32_t i = 0; i < sequence->frame_count; i++) {
        const fm_frame *frame = frame_of(sequence, i);
        assert_int_equal(tbr_frame(base, frame, &err), FM_OK);
        assert_int_equal(tbr_frame(gpu, frame, &err), FM_OK);
        assert_memory_equal(tbr_image(gpu), tbr_image(base), 320 * 240 * 4);
        skipped += tbr_counts(gpu)->tiles_skipped;
    }
    assert_int_equal(skipped > 0, must_skip);
    tbr_destroy(base);
    tbr_destroy(gpu);
    kit_technique_close(&plain);
    kit_technique_close(&tried);
    sequence_destroy(sequence);
}

static void recording_replays_alike_with_every_exact_technique(void **state)
{
    (void)state;
    replay("tbr-re", true);
    replay("tbr-evr-reorder", false);
    replay("tbr-evr-safe", true);
    replay("tbr-z-prepass", false);
    replay("tbr-oracle-z", false);
    replay("tbr-oracle-tile", true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stream_gives_back_what_was_written),
        cmocka_unit_test(stream_without_frames_leaves_no_file),
        cmocka_unit_test(stream_open_refuses_what_is_not_whole),
        cmocka_unit_test(feedback_becomes_fans_with_rows_from_the_top),
        cmocka_unit_test(feedback_of_another_colour_is_another_picture),
        cmocka_unit_test(feedback_is_clipped_to_the_scissor),
        cmocka_unit_test(feedback_counts_points_and_ends_at_nonsense),
        cmocka_unit_test(recording_tells_states_apart),
        cmocka_unit_test(recording_replays_alike_with_every_exact_technique),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
