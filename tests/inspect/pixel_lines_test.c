/* What `fragmark dump` prints of a small case that is worked out by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "inspect/frame_lines.h"
#include "inspect/pixel_lines.h"
#include "scene/scene.h"

/* 2 x 1 px, of which the right one has three fragments. The method was to hand over the two nearest
 * and handed over the third, then the first, and two more than there was room for. */
static const fm_fragment own[] = { { 0.1f, 0x4D0A2028 }, { 0.5f, 0xFF000001 }, { 1, 0x80402010 } };
static const fm_fragment handed_over[] = { { 1, 0x80402010 }, { 0.1f, 0x4D0A2028 } };
static const uint32_t uncaptured[] = { 0, 2 };

static void map_lists(kept_map *map, kept_kind kind, const fm_fragment *fragments, size_t count)
{
    char path[] = "/tmp/fm-lines-XXXXXX";
    kept_writer writer;
    const kept_header header = {
        .kind = kind, .width_px = 2, .height_px = 1, .wanted = 2, .list_count = 2
    };
    close(mkstemp(path));
    assert_int_equal(kept_begin(&writer, path, &header, NULL), FM_OK);
    kept_add_list(&writer, NULL, 0);
    kept_add_list(&writer, fragments, count);
    if (kind == KEPT_FRAGMENTS)
        kept_add_words(&writer, uncaptured, 2);
    assert_int_equal(kept_finish(&writer, FM_OK, NULL), FM_OK);
    assert_int_equal(kept_open(map, path, NULL), FM_OK);
    unlink(path);
}

typedef struct small_case {
    kept_map fragments, truth;
} small_case;

static void open_case(small_case *of)
{
    map_lists(&of->fragments, KEPT_FRAGMENTS, handed_over, 2);
    map_lists(&of->truth, KEPT_TRUTH, own, 3);
}

static void close_case(small_case *of)
{
    kept_close(&of->fragments);
    kept_close(&of->truth);
}

static void expect(const pixel_source *source, pixel_counts *sums, const char *lines)
{
    fm_text text = { 0 };
    *sums = (pixel_counts){ 0 };
    assert_int_equal(pixel_lines_add(&text, sums, source, 0, NULL), FM_OK);
    assert_int_equal(text.length, 0); /* the left one has none */
    assert_int_equal(pixel_lines_add(&text, sums, source, 1, NULL), FM_OK);
    assert_string_equal(text.bytes, lines);
    text_free(&text);
}

static void each_fragment_has_its_state(void **state)
{
    small_case of;
    pixel_counts sums;
    (void)state;
    open_case(&of);
    expect(&(pixel_source){ &of.fragments, &of.truth }, &sums,
           "1,0,,0.5,3f000000,1,0,0,255,missing,1\n"
           "1,0,0,1,3f800000,16,32,64,128,behind,2\n"
           "1,0,1,0.100000001,3dcccccd,40,32,10,77,ok+misordered,0\n");
    assert_int_equal(sums.own, 3);
    assert_int_equal(sums.wanted, 2);
    assert_int_equal(sums.handed_over, 4);
    assert_int_equal(sums.uncaptured, 2);
    assert_int_equal(sums.missing, 1);
    assert_int_equal(sums.extra, 2);
    assert_int_equal(sums.misordered, 1);
    close_case(&of);
}

static void one_file_alone_has_no_state(void **state)
{
    small_case of;
    pixel_counts sums;
    (void)state;
    open_case(&of);
    expect(&(pixel_source){ .fragments = &of.fragments }, &sums,
           "1,0,0,1,3f800000,16,32,64,128,,\n"
           "1,0,1,0.100000001,3dcccccd,40,32,10,77,misordered,\n");
    assert_int_equal(sums.missing + sums.extra, 0);
    expect(&(pixel_source){ .truth = &of.truth }, &sums,
           "1,0,,0.100000001,3dcccccd,40,32,10,77,,0\n"
           "1,0,,0.5,3f000000,1,0,0,255,,1\n"
           "1,0,,1,3f800000,16,32,64,128,,2\n");
    close_case(&of);
}

static void wrong_pixels_are_listed_up_to_a_count(void **state)
{
    small_case of;
    pixel_counts sums = { 0 };
    fm_text text = { 0 };
    uint64_t wrong;
    (void)state;
    open_case(&of);
    const pixel_source both = { &of.fragments, &of.truth };
    assert_int_equal(pixel_lines_wrong(&text, &sums, &wrong, &both, 0, NULL), FM_OK);
    assert_int_equal(wrong, 1);
    assert_int_equal(text.length, 0);
    assert_int_equal(pixel_lines_wrong(&text, &sums, &wrong, &both, 5, NULL), FM_OK);
    assert_string_equal(text.bytes, "1,0,3,2,4,1,2,1\n");
    assert_int_equal(sums.missing, 2); /* of both calls */
    text_free(&text);
    close_case(&of);
}

/* ---- sequences ---- */

enum { WIDTH = 18, HEIGHT = 1 };

/* Two tiles, 16 and 2 px wide; frame 1 has one wrong pixel in the second, frame 2, whose picture is
 * not kept, one in the first. */
static void map_frames(kept_map *map)
{
    static const kept_tile second = { 1, 1 }, first = { 0, 1 };
    char path[] = "/tmp/fm-lines-XXXXXX";
    kept_writer writer;
    const kept_header header = {
        .kind = KEPT_FRAMES, .width_px = WIDTH, .height_px = HEIGHT, .list_count = 3
    };
    uint32_t picture[WIDTH] = { [17] = 0xFF030201 };
    close(mkstemp(path));
    assert_int_equal(kept_begin(&writer, path, &header, NULL), FM_OK);
    kept_add_list(&writer, NULL, 0);
    kept_add_list(&writer, &second, 1);
    kept_add_list(&writer, &first, 1);
    kept_add_words(&writer, picture, WIDTH);
    picture[17] = 0xFF030205;
    kept_add_words(&writer, picture, WIDTH);
    assert_int_equal(kept_finish(&writer, FM_OK, NULL), FM_OK);
    assert_int_equal(kept_open(map, path, NULL), FM_OK);
    unlink(path);
}

static void wrong_tiles_have_their_place(void **state)
{
    kept_map map;
    fm_text text = { 0 };
    frame_counts counts;
    (void)state;
    map_frames(&map);
    frame_lines_wrong(&text, &counts, &map, 1);
    assert_string_equal(text.bytes, "1,1,16,0,2,1,1\n");
    assert_int_equal(counts.frames, 3);
    assert_int_equal(counts.wrong_frames, 2);
    assert_int_equal(counts.wrong_tiles, 2);
    assert_int_equal(counts.wrong_pixels, 2);
    text_free(&text);
    kept_close(&map);
}

static void wrong_pixels_have_both_colours(void **state)
{
    kept_map map;
    fm_text text = { 0 };
    fm_error err = { 0 };
    uint64_t wrong;
    (void)state;
    map_frames(&map);
    assert_int_equal(frame_lines_add(&text, &wrong, &map, 0, NULL, &err), FM_OK);
    assert_int_equal(text.length, 0); /* it is right */
    assert_int_equal(frame_lines_add(&text, &wrong, &map, 1, NULL, &err), FM_OK);
    assert_int_equal(wrong, 1);
    assert_string_equal(text.bytes, "1,17,0,1,1,2,3,255,5,2,3,255,wrong\n");
    text.length = 0;
    const pixel_area area = { 16, 0, 1, 1 };
    assert_int_equal(frame_lines_add(&text, &wrong, &map, 1, &area, &err), FM_OK);
    assert_string_equal(text.bytes, "1,16,0,1,0,0,0,0,0,0,0,0,ok\n");
    assert_int_equal(frame_lines_add(&text, &wrong, &map, 2, NULL, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "the first 1 wrong frames alone are kept"));
    assert_int_equal(frame_lines_add(&text, &wrong, &map, 3, NULL, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "has 3 frames"));
    text_free(&text);
    kept_close(&map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_fragment_has_its_state),
        cmocka_unit_test(one_file_alone_has_no_state),
        cmocka_unit_test(wrong_pixels_are_listed_up_to_a_count),
        cmocka_unit_test(wrong_tiles_have_their_place),
        cmocka_unit_test(wrong_pixels_have_both_colours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
