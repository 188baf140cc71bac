#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/data.h"

/* A folder with one figure, as the variable names it. */
typedef struct place {
    char folder[64], file[96];
} place;

static void place_create(place *at)
{
    strcpy(at->folder, "/tmp/fragmark-data-XXXXXX");
    assert_non_null(mkdtemp(at->folder));
    snprintf(at->file, sizeof at->file, "%s/mine-1.yml", at->folder);
    assert_int_equal(text_write_file(at->file, "id: mine-1\n", 11, NULL), FM_OK);
    setenv("FRAGMARK_FIGURE_PATH", at->folder, 1);
}

static void place_destroy(const place *at)
{
    unsetenv("FRAGMARK_FIGURE_PATH");
    unlink(at->file);
    rmdir(at->folder);
}

static void data_find_looks_where_the_variable_says(void **state)
{
    (void)state;
    place at;
    char path[FM_PATH_MAX_BYTES];
    fm_error err = { 0 };
    place_create(&at);
    assert_int_equal(data_find(path, DATA_FIGURES, "mine-1", ".yml", &err), FM_OK);
    assert_string_equal(path, at.file);
    place_destroy(&at);
}

static void data_find_names_the_nearest(void **state)
{
    (void)state;
    place at;
    char path[FM_PATH_MAX_BYTES];
    fm_error err = { 0 };
    place_create(&at);
    assert_int_equal(data_find(path, DATA_FIGURES, "mine1", ".yml", &err), FM_INVALID);
    assert_non_null(strstr(err.message, "no figure 'mine1' in "));
    assert_non_null(strstr(err.message, "the nearest is 'mine-1'"));
    place_destroy(&at);
}

/* What is given must be there; `is` says how the message ends. */
static void expect_refused(const char *folders, const char *is)
{
    fm_text_list found = { 0 };
    fm_error err = { 0 };
    setenv("FRAGMARK_SCENE_PATH", folders, 1);
    assert_int_equal(data_folders(&found, DATA_SCENES, &err), FM_IO);
    assert_string_equal(err.message, is);
    unsetenv("FRAGMARK_SCENE_PATH");
    text_list_free(&found);
}

static void data_folders_refuses_what_is_no_folder(void **state)
{
    (void)state;
    expect_refused("/tmp:/nowhere/at/all",
                   "FRAGMARK_SCENE_PATH: /nowhere/at/all: No such file or directory");
    expect_refused("/etc/passwd", "FRAGMARK_SCENE_PATH: /etc/passwd: is not a folder");
}

static void data_folders_skips_empty_parts(void **state)
{
    (void)state;
    fm_text_list found = { 0 };
    fm_error err = { 0 };
    setenv("FRAGMARK_SCENE_PATH", ":/tmp::", 1);
    assert_int_equal(data_folders(&found, DATA_SCENES, &err), FM_OK);
    assert_true(found.count >= 1);
    assert_string_equal(found.items[0], "/tmp");
    unsetenv("FRAGMARK_SCENE_PATH");
    text_list_free(&found);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(data_find_looks_where_the_variable_says),
        cmocka_unit_test(data_find_names_the_nearest),
        cmocka_unit_test(data_folders_refuses_what_is_no_folder),
        cmocka_unit_test(data_folders_skips_empty_parts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
