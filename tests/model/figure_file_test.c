/* The head of a figure's file, which both programs read. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <glob.h>

#include "base/text.h"
#include "model/figure_file.h"
#include "model/metrics.h"

/* Reads the text as a figure's file, which the caller closes. */
static fm_status read_text(fm_figure_file *file, const char *text, fm_error *err)
{
    char path[] = "/tmp/fragmark-figure-XXXXXX";
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    assert_int_equal(text_write_file(path, text, strlen(text), NULL), FM_OK);
    const fm_status status = figure_file_read(file, path, err);
    unlink(path);
    return status;
}

static void figure_file_hands_out_its_parts(void **state)
{
    (void)state;
    fm_figure_file file;
    fm_error err;
    assert_int_equal(read_text(&file,
                               "id: f-1\npaper: f\ntitle: t\npictures: true\nuntimed: true\n"
                               "run: { k: 4 }\nclaims: [{ id: F-1 }]\n",
                               &err),
                     FM_OK);
    assert_string_equal(file.id, "f-1");
    assert_string_equal(file.source, "");
    assert_true(file.keeps_pictures);
    assert_true(file.is_untimed);
    assert_non_null(yaml_tree_find(file.run, "k"));
    assert_int_equal(file.claims->count, 1);
    assert_null(file.smoke);
    figure_file_close(&file);
}

static void figure_file_refuses_with_the_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *says;
    } damaged[] = {
        { "id: f\npaper: f\ntitle: t\nrnu: {}\n", ":4: unknown key \"rnu\" of a figure" },
        { "id: f\npaper: f\n", ":1: title is missing" },
        { "id: F\npaper: f\ntitle: t\n", "id \"F\": lower case" },
        { "id: f\npaper: f\ntitle: t\npictures: yes\n", ":4: unknown pictures \"yes\"" },
        { "id: f\npaper: f\ntitle: t\nuntimed: 1\n", ":4: unknown untimed \"1\"" },
    };
    for (size_t i = 0; i < sizeof damaged / sizeof damaged[0]; i++) {
        fm_figure_file file;
        fm_error err = { 0 };
        assert_int_equal(read_text(&file, damaged[i].text, &err), FM_INVALID);
        if (strstr(err.message, damaged[i].says) == NULL)
            fail_msg("\"%s\" is not in \"%s\"", damaged[i].says, err.message);
        figure_file_close(&file);
    }
}

static void a_damaged_figure_still_tells_its_title(void **state)
{
    (void)state;
    fm_figure_file file;
    fm_error err;
    assert_int_equal(read_text(&file, "title: t\nrnu: {}\n", &err), FM_INVALID);
    assert_string_equal(file.title, "t");
    assert_string_equal(file.id, "");
    figure_file_close(&file);
    assert_int_equal(figure_file_read(&file, "/nowhere/f.yml", &err), FM_IO);
    assert_string_equal(file.title, "");
    figure_file_close(&file);
}

/* What a spec says in this block of `run`, or the smoke size in its place; NULL: neither. */
static const char *said(const fm_yaml *block, const fm_yaml *smoke, const char *key)
{
    const fm_yaml *value = smoke != NULL ? yaml_tree_find(smoke, key) : NULL;
    value = value != NULL ? value : yaml_tree_find(block, key);
    return value != NULL ? value->text : NULL;
}

static void expect_launches(const fm_figure_file *file, const fm_yaml *block, const fm_yaml *smoke)
{
    const fm_yaml *feeds = yaml_tree_find(block, "feeds");
    const char *launches = said(block, smoke, "launches");
    const bool is_simulated =
        feeds != NULL && feeds->count == 1 && strcmp(feeds->items[0].text, "frames") == 0;
    if (!is_simulated && !file->is_untimed && launches != NULL &&
        atoi(launches) < FM_LAUNCHES_WANTED)
        fail_msg("%s: %s launches, of which times have no useful interval", file->id, launches);
}

static void figures_have_as_many_launches_as_intervals_need(void **state)
{
    (void)state;
    char pattern[512];
    glob_t files;
    snprintf(pattern, sizeof pattern, "%s/reports/figures/*.yml", getenv("FRAGMARK_SOURCE_DIR"));
    assert_int_equal(glob(pattern, 0, NULL, &files), 0);
    for (size_t i = 0; i < files.gl_pathc; i++) {
        fm_figure_file file;
        fm_error err = { 0 };
        assert_int_equal(figure_file_read(&file, files.gl_pathv[i], &err), FM_OK);
        const bool is_list = file.run != NULL && file.run->kind == FM_YAML_LIST;
        const size_t count = is_list ? file.run->count : file.run != NULL;
        for (size_t j = 0; j < count; j++) {
            const fm_yaml *block = is_list ? &file.run->items[j] : file.run;
            expect_launches(&file, block, NULL);
            expect_launches(&file, block, file.smoke);
        }
        figure_file_close(&file);
    }
    globfree(&files);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figure_file_hands_out_its_parts),
        cmocka_unit_test(figure_file_refuses_with_the_line),
        cmocka_unit_test(a_damaged_figure_still_tells_its_title),
        cmocka_unit_test(figures_have_as_many_launches_as_intervals_need),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
