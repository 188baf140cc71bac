/* Files of lists: written and read back, and refused where they are damaged. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "truth/kept_file.h"
#include "truth/truth.h"

enum { WIDTH = 3, HEIGHT = 2, PIXELS = WIDTH * HEIGHT, FRAMES = 4 };

/* A folder of its own, and a path in it. */
typedef struct place {
    char folder[32], path[64];
} place;

static void make_place(place *at)
{
    snprintf(at->folder, sizeof at->folder, "/tmp/fm-kept-XXXXXX");
    assert_non_null(mkdtemp(at->folder));
    snprintf(at->path, sizeof at->path, "%s/a.kept", at->folder);
}

static size_t count_files(const place *at)
{
    size_t count = 0;
    DIR *folder = opendir(at->folder);
    assert_non_null(folder);
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;)
        count += entry->d_name[0] != '.';
    closedir(folder);
    return count;
}

static void remove_place(const place *at)
{
    unlink(at->path);
    rmdir(at->path);
    assert_int_equal(rmdir(at->folder), 0); /* and nothing else lay in it */
}

/* Pixel i has i fragments; two more of the last were not captured. */
static fm_status write_fragments(const char *path, fm_error *err)
{
    kept_writer writer;
    const kept_header header = { .kind = KEPT_FRAGMENTS,
                                 .width_px = WIDTH,
                                 .height_px = HEIGHT,
                                 .wanted = 3,
                                 .list_count = PIXELS };
    fm_status status = kept_begin(&writer, path, &header, err);
    for (uint32_t i = 0; i < PIXELS && status == FM_OK; i++) {
        fm_fragment fragments[PIXELS];
        const uint32_t more = i == PIXELS - 1 ? 2 : 0;
        for (uint32_t j = 0; j < i; j++)
            fragments[j] = (fm_fragment){ (float)j / 8, 10 * i + j };
        kept_add_list(&writer, fragments, i);
        kept_add_words(&writer, &more, 1);
    }
    return kept_finish(&writer, status, err);
}

/* Frame 1 has two wrong tiles and a picture, frame 3 one wrong tile and none. */
static fm_status write_frames(const char *path, fm_error *err)
{
    enum { SIDE = 20 };
    static const kept_tile first[] = { { 0, 7 }, { 3, 1 } }, second[] = { { 2, 5 } };
    kept_writer writer;
    const kept_header header = {
        .kind = KEPT_FRAMES, .width_px = SIDE, .height_px = SIDE, .list_count = FRAMES
    };
    uint32_t picture[SIDE * SIDE];
    fm_status status = kept_begin(&writer, path, &header, err);
    if (status == FM_OK) {
        kept_add_list(&writer, NULL, 0);
        kept_add_list(&writer, first, 2);
        kept_add_list(&writer, NULL, 0);
        kept_add_list(&writer, second, 1);
        memset(picture, 1, sizeof picture);
        kept_add_words(&writer, picture, SIDE * SIDE);
        memset(picture, 2, sizeof picture);
        kept_add_words(&writer, picture, SIDE * SIDE);
    }
    return kept_finish(&writer, status, err);
}

/* As the fragments; the j-th to arrive lies at the end but j. */
static fm_status write_truth(const char *path, fm_error *err)
{
    kept_writer writer;
    const kept_header header = {
        .kind = KEPT_TRUTH, .width_px = WIDTH, .height_px = HEIGHT, .list_count = PIXELS
    };
    fm_status status = kept_begin(&writer, path, &header, err);
    for (uint32_t i = 0; i < PIXELS && status == FM_OK; i++) {
        fm_fragment fragments[PIXELS];
        uint32_t arrival[PIXELS];
        for (uint32_t j = 0; j < i; j++) {
            fragments[j] = (fm_fragment){ (float)j / 8, 10 * i + j };
            arrival[j] = i - 1 - j;
        }
        kept_add_list(&writer, fragments, i);
        kept_add_words(&writer, arrival, i);
    }
    return kept_finish(&writer, status, err);
}

static void fragments_come_back_as_they_were_written(void **state)
{
    place at;
    kept_map map = { .map = NULL };
    (void)state;
    make_place(&at);
    assert_int_equal(write_fragments(at.path, NULL), FM_OK);
    assert_int_equal(count_files(&at), 1);
    assert_int_equal(kept_open(&map, at.path, NULL), FM_OK);
    assert_int_equal(map.header->kind, KEPT_FRAGMENTS);
    assert_int_equal(map.header->wanted, 3);
    assert_int_equal(map.header->n, PIXELS - 1);
    assert_int_equal(map.header->nonempty, PIXELS - 1);
    const fm_fragment *fragments = map.items;
    for (uint32_t i = 0; i < PIXELS; i++) {
        assert_int_equal(map.offsets[i + 1] - map.offsets[i], i);
        for (uint32_t j = 0; j < i; j++) {
            assert_int_equal(fragments[map.offsets[i] + j].colour, 10 * i + j);
            assert_true(fragments[map.offsets[i] + j].depth >= (float)j / 8 &&
                        fragments[map.offsets[i] + j].depth <= (float)j / 8);
        }
        assert_int_equal(map.words[i], i == PIXELS - 1 ? 2 : 0);
    }
    kept_close(&map);
    remove_place(&at);
}

static void truth_opens_with_its_ranks_of_arrival(void **state)
{
    place at;
    fm_truth *truth;
    (void)state;
    make_place(&at);
    assert_int_equal(write_truth(at.path, NULL), FM_OK);
    assert_int_equal(truth_open(&truth, at.path, NULL), FM_OK);
    assert_int_equal(truth->n, PIXELS - 1);
    assert_int_equal(truth->fragment_count, 15);
    assert_int_equal(truth->nonempty_pixels, PIXELS - 1);
    assert_int_equal(truth->arrival[truth->offsets[5]], 4);
    truth_close(truth);
    remove_place(&at);
}

static void pictures_belong_to_the_first_wrong_frames(void **state)
{
    place at;
    kept_map map = { .map = NULL };
    const uint32_t *pictures[2];
    (void)state;
    make_place(&at);
    assert_int_equal(write_frames(at.path, NULL), FM_OK);
    assert_int_equal(kept_open(&map, at.path, NULL), FM_OK);
    assert_int_equal(kept_tile_count(map.header), 4);
    assert_false(kept_pictures(pictures, &map, 0)); /* it is right */
    assert_true(kept_pictures(pictures, &map, 1));
    assert_int_equal(pictures[0][0], 0x01010101);
    assert_int_equal(pictures[1][399], 0x02020202);
    assert_false(kept_pictures(pictures, &map, 3)); /* wrong, and not kept */
    assert_int_equal(((const kept_tile *)map.items)[2].tile, 2);
    kept_close(&map);
    remove_place(&at);
}

/* ---- what cannot be written ---- */

static void what_fails_before_its_end_leaves_nothing(void **state)
{
    place at;
    kept_writer writer;
    fm_error err = { 0 };
    const kept_header header = {
        .kind = KEPT_FRAMES, .width_px = 1, .height_px = 1, .list_count = 2
    };
    (void)state;
    make_place(&at);
    assert_int_equal(kept_begin(&writer, at.path, &header, &err), FM_OK);
    kept_add_list(&writer, NULL, 0);
    assert_int_equal(kept_finish(&writer, FM_DEVICE_LOST, &err), FM_DEVICE_LOST);
    assert_int_equal(count_files(&at), 0);
    remove_place(&at);
}

static void a_full_disk_is_told_and_leaves_the_file_of_before(void **state)
{
    place at;
    struct rlimit before;
    fm_error err = { 0 };
    kept_map map = { .map = NULL };
    (void)state;
    make_place(&at);
    assert_int_equal(write_fragments(at.path, NULL), FM_OK);
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    const struct rlimit limit = { 100, before.rlim_max };
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    const fm_status status = write_frames(at.path, &err);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_int_equal(status, FM_IO);
    assert_non_null(strstr(err.message, at.path));
    assert_non_null(strstr(err.message, "cannot be written: File too large"));
    assert_int_equal(count_files(&at), 1);
    assert_int_equal(kept_open(&map, at.path, NULL), FM_OK);
    assert_int_equal(map.header->kind, KEPT_FRAGMENTS);
    kept_close(&map);
    remove_place(&at);
}

static void a_folder_is_not_replaced(void **state)
{
    place at;
    fm_error err = { 0 };
    (void)state;
    make_place(&at);
    assert_int_equal(mkdir(at.path, 0777), 0);
    assert_int_equal(write_fragments(at.path, &err), FM_IO);
    assert_non_null(strstr(err.message, "is a folder"));
    remove_place(&at);
}

static void truth_gets_a_second_name(void **state)
{
    place at;
    fm_truth *truth;
    char kept[80];
    (void)state;
    make_place(&at);
    snprintf(kept, sizeof kept, "%s/b.truth", at.folder);
    assert_int_equal(write_truth(at.path, NULL), FM_OK);
    assert_int_equal(truth_open(&truth, at.path, NULL), FM_OK);
    for (int again = 0; again < 2; again++)
        assert_int_equal(truth_keep(kept, at.path, truth, NULL), FM_OK);
    assert_int_equal(count_files(&at), 2);
    /* where there is nothing to link to, as on a disk without links, it is copied */
    unlink(kept);
    assert_int_equal(truth_keep(kept, "/nowhere/a.truth", truth, NULL), FM_OK);
    truth_close(truth);
    assert_int_equal(truth_open(&truth, kept, NULL), FM_OK);
    assert_int_equal(truth->fragment_count, 15);
    assert_int_equal(truth_keep("/nowhere/b.truth", kept, truth, NULL), FM_IO);
    truth_close(truth);
    unlink(kept);
    remove_place(&at);
}

/* ---- what cannot be read ---- */

typedef fm_status write_function(const char *path, fm_error *err);
static write_function *const writers[] = { write_fragments, write_truth, write_frames };

typedef struct file_bytes {
    char bytes[8192];
    size_t count;
} file_bytes;

static void read_bytes(file_bytes *file, const char *path)
{
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    file->count = fread(file->bytes, 1, sizeof file->bytes, in);
    assert_true(file->count > sizeof(kept_header) && file->count < sizeof file->bytes);
    fclose(in);
}

static fm_status open_bytes(const char *path, const char *bytes, size_t count, fm_error *err)
{
    kept_map map = { .map = NULL };
    unlink(path); /* some file systems flush what is emptied and written again */
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, count, out), count);
    assert_int_equal(fclose(out), 0);
    const fm_status status = kept_open(&map, path, err);
    assert_true(map.is_damaged == (status != FM_OK));
    kept_close(&map);
    return status;
}

static void refuse(const char *path, const char *bytes, size_t count)
{
    fm_error err = { .message = "" };
    assert_int_equal(open_bytes(path, bytes, count, &err), FM_IO);
    assert_non_null(strstr(err.message, path));
    assert_non_null(strstr(err.message, "damaged: "));
}

static void each_cut_is_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof writers / sizeof writers[0]; i++) {
        place at;
        file_bytes file;
        make_place(&at);
        assert_int_equal(writers[i](at.path, NULL), FM_OK);
        read_bytes(&file, at.path);
        const size_t step = file.count > 1000 ? 7 : 1; /* pictures are long */
        for (size_t count = 0; count < file.count; count += count < 200 ? 1 : step)
            refuse(at.path, file.bytes, count);
        file.bytes[file.count] = 0;
        refuse(at.path, file.bytes, file.count + 1);
        remove_place(&at);
    }
}

/* None may be another but those of `wanted`, which may be anything. */
static void each_byte_of_the_header_counts(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof writers / sizeof writers[0]; i++) {
        place at;
        file_bytes file;
        make_place(&at);
        assert_int_equal(writers[i](at.path, NULL), FM_OK);
        read_bytes(&file, at.path);
        for (size_t at_byte = 0; at_byte < sizeof(kept_header); at_byte++) {
            if (at_byte / 4 == offsetof(kept_header, wanted) / 4)
                continue;
            file.bytes[at_byte] ^= 0x40;
            refuse(at.path, file.bytes, file.count);
            file.bytes[at_byte] ^= 0x40;
        }
        remove_place(&at);
    }
}

static void damage(write_function *writer, size_t offset, uint64_t value, size_t bytes)
{
    place at;
    file_bytes file;
    make_place(&at);
    assert_int_equal(writer(at.path, NULL), FM_OK);
    read_bytes(&file, at.path);
    memcpy(file.bytes + offset, &value, bytes);
    refuse(at.path, file.bytes, file.count);
    remove_place(&at);
}

static void offsets_that_lead_astray_are_refused(void **state)
{
    const size_t offsets = sizeof(kept_header);
    (void)state;
    damage(write_fragments, offsets, 1, 8);               /* the first is not 0 */
    damage(write_fragments, offsets + 8 * 3, 0, 8);       /* falling */
    damage(write_fragments, offsets + 8 * 3, 1 << 20, 8); /* beyond the items */
    damage(write_fragments, offsets + 8 * 3, UINT64_MAX, 8);
    damage(write_fragments, offsets + 8 * PIXELS, 14, 8); /* the last is not all of them */
    damage(write_truth, offsets + 8 * 3, 6, 8);           /* a pixel has more than n */
}

static void ranks_and_tiles_that_lead_astray_are_refused(void **state)
{
    const size_t truth_items = sizeof(kept_header) + 8 * (PIXELS + 1);
    const size_t frame_items = sizeof(kept_header) + 8 * (FRAMES + 1);
    (void)state;
    damage(write_truth, truth_items + 15 * 8, 1, 4); /* a pixel of one has no second */
    damage(write_frames, frame_items, 4, 4);         /* tiles are 0 to 3 */
    damage(write_frames, frame_items, 3, 4);         /* a tile twice */
}

/* Twice as many words as it has pixels are a small number, if counted in 64 bits. */
static void pictures_that_no_memory_holds_are_refused(void **state)
{
    (void)state;
    enum { WORDS = 12942 };
    struct {
        kept_header header;
        uint64_t offsets[2];
        kept_tile tile;
        uint32_t words[WORDS];
    } file = { .header = { .magic = "fmkept1",
                           .kind = KEPT_FRAMES,
                           .width_px = 3037012561,
                           .height_px = 3036988439,
                           .n = 1,
                           .list_count = 1,
                           .item_count = 1,
                           .word_count = WORDS,
                           .nonempty = 1 },
               .offsets = { 0, 1 } };
    const uint64_t pixels = (uint64_t)file.header.width_px * file.header.height_px;
    place at;
    assert_true(2 * pixels == WORDS);
    make_place(&at);
    refuse(at.path, (const char *)&file, sizeof file);
    remove_place(&at);
}

static void what_is_no_file_is_no_damage(void **state)
{
    kept_map map = { .map = NULL };
    fm_error err = { 0 };
    (void)state;
    assert_int_equal(kept_open(&map, "/nowhere/a.truth", &err), FM_IO);
    assert_false(map.is_damaged);
    assert_int_equal(kept_open(&map, "/dev/zero", &err), FM_INVALID);
    assert_int_equal(kept_open(&map, "/tmp", &err), FM_INVALID);
    assert_false(map.is_damaged);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fragments_come_back_as_they_were_written),
        cmocka_unit_test(truth_opens_with_its_ranks_of_arrival),
        cmocka_unit_test(pictures_belong_to_the_first_wrong_frames),
        cmocka_unit_test(what_fails_before_its_end_leaves_nothing),
        cmocka_unit_test(a_full_disk_is_told_and_leaves_the_file_of_before),
        cmocka_unit_test(a_folder_is_not_replaced),
        cmocka_unit_test(truth_gets_a_second_name),
        cmocka_unit_test(each_cut_is_refused),
        cmocka_unit_test(each_byte_of_the_header_counts),
        cmocka_unit_test(offsets_that_lead_astray_are_refused),
        cmocka_unit_test(ranks_and_tiles_that_lead_astray_are_refused),
        cmocka_unit_test(pictures_that_no_memory_holds_are_refused),
        cmocka_unit_test(what_is_no_file_is_no_damage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
