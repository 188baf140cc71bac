/* A report that fails, or that would be poorer, leaves the one that is there. */
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "claims_kit.h"

static const fakes two = { { { ROW("a", 4, 0.25, 10) }, { ROW("b", 4, 0.25, 20) } } };
static const char figure[] = "id: f-1\npaper: f\ntitle: t\ncharts:\n"
                             "  - { id: c, title: c, x: k, y: frame_ms }\n"
                             "claims:\n  - { id: F-1, text: t, at_most: 9, of: { method: b },"
                             " over: { method: a } }\n";

/* The exit status of fragmark-report; what it says goes to DIRECTORY/said. */
static int report(const char *directory, const char *arguments)
{
    char command[8192];
    snprintf(command, sizeof command,
             "FRAGMARK_FIGURE_PATH=%s %s %s --reference none %s >/dev/null 2>%s/said", directory,
             FM_REPORT_PROGRAM, directory, arguments, directory);
    const int status = system(command);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static char *read_file(const char *directory, const char *name)
{
    char path[256], *bytes = NULL;
    size_t count;
    snprintf(path, sizeof path, "%s/%s", directory, name);
    return text_read_file(&bytes, &count, path, 64u << 20, NULL) == FM_OK ? bytes : NULL;
}

static bool is_there(const char *directory, const char *name)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    return access(path, F_OK) == 0;
}

static void remove_file(const char *directory, const char *name)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    assert_int_equal(unlink(path), 0);
}

static void assert_holds(const char *directory, const char *name, const char *says)
{
    char *text = read_file(directory, name);
    assert_non_null(text);
    if (strstr(text, says) == NULL)
        fail_msg("%s lacks '%s'", name, says);
    free(text);
}

/* Results of a run for figure f-1, with a report. */
static void make_reported(char directory[64])
{
    kit_make_results(directory, &two);
    kit_write_file(directory, "f-1.yml", figure);
    kit_write_file(directory, "manifest.json", "{\"schema\": 1, \"figures\": [\"f-1\"]}");
    assert_int_equal(report(directory, ""), 0);
    assert_true(is_there(directory, "claims.csv"));
    assert_false(is_there(directory, "charts.partial"));
}

/* Report, claims and charts are those of before, byte for byte. */
static void assert_stays(const char *directory, int code, const char *arguments, const char *says)
{
    char *page = read_file(directory, "report.html"), *claims = read_file(directory, "claims.csv");
    assert_int_equal(report(directory, arguments), code);
    assert_holds(directory, "said", says);
    char *page_after = read_file(directory, "report.html"),
         *claims_after = read_file(directory, "claims.csv");
    assert_string_equal(page_after, page);
    assert_string_equal(claims_after, claims);
    free(page);
    free(claims);
    free(page_after);
    free(claims_after);
}

static void a_figure_of_the_run_that_is_gone_replaces_nothing(void **state)
{
    (void)state;
    char directory[64];
    make_reported(directory);
    remove_file(directory, "f-1.yml");
    assert_stays(directory, 8, "", "no figure 'f-1'");
    kit_remove_directory(directory);
}

static void a_reference_that_is_not_there_replaces_nothing(void **state)
{
    (void)state;
    char directory[64];
    make_reported(directory);
    assert_stays(directory, 2, "--reference nobody", "no reference 'nobody'");
    kit_remove_directory(directory);
}

static void results_that_are_damaged_since_replace_nothing(void **state)
{
    (void)state;
    char directory[64];
    make_reported(directory);
    kit_write_file(directory, "manifest.json", "{\"schema\": 2}");
    assert_stays(directory, 8, "", "this program reads schema 1");
    kit_remove_directory(directory);
}

static void a_report_that_cannot_be_written_replaces_nothing(void **state)
{
    (void)state;
    char directory[64];
    make_reported(directory);
    kit_write_file(directory, "charts.partial", "in the way of a folder");
    assert_stays(directory, 5, "", "charts.partial: Not a directory");
    kit_remove_directory(directory);
}

/* One of the files cannot be put in place after all charts were drawn. */
static void claims_that_cannot_be_written_replace_nothing(void **state)
{
    (void)state;
    char directory[64], path[128];
    make_reported(directory);
    snprintf(path, sizeof path, "%s/claims.csv.new", directory);
    assert_int_equal(mkdir(path, 0777), 0);
    assert_stays(directory, 5, "", "claims.csv.new");
    assert_false(is_there(directory, "charts.partial"));
    kit_remove_directory(directory);
}

static void a_poorer_report_is_drawn_where_there_is_no_better_one(void **state)
{
    (void)state;
    char directory[64];
    make_reported(directory);
    remove_file(directory, "samples.csv");
    assert_stays(directory, 8, "", "lacked less than these do, and stays");
    remove_file(directory, "report.html");
    assert_int_equal(report(directory, ""), 5);
    assert_holds(directory, "said", "samples.csv is not there");
    assert_holds(directory, "report.html", "<p class=note>samples.csv is not there");
    assert_int_equal(report(directory, ""), 5); /* as poor as that one */
    kit_remove_directory(directory);
}

static void claims_and_charts_of_before_go_with_their_report(void **state)
{
    (void)state;
    char directory[64];
    make_reported(directory);
    assert_true(is_there(directory, "charts/speed-error-layers-soft-raster.svg"));
    kit_write_file(directory, "charts/old.svg", "<svg/>");
    kit_write_file(directory, "charts/notes.txt", "mine");
    kit_write_file(directory, "manifest.json", "{\"schema\": 1}");
    assert_int_equal(report(directory, ""), 0);
    assert_false(is_there(directory, "claims.csv"));
    assert_false(is_there(directory, "charts/old.svg"));
    assert_true(is_there(directory, "charts/notes.txt"));
    assert_true(is_there(directory, "charts/speed-error-layers-soft-raster.svg"));
    kit_remove_directory(directory);
}

static void no_figure_is_left_out_in_silence(void **state)
{
    (void)state;
    enum { FIGURES = 70 };
    char directory[64];
    fm_text arguments = { 0 };
    make_reported(directory);
    for (int i = 0; i < FIGURES; i++)
        text_add(&arguments, " -f f-1");
    assert_int_equal(report(directory, arguments.bytes), 0);
    fm_table *claims = NULL;
    char path[128];
    snprintf(path, sizeof path, "%s/claims.csv", directory);
    assert_int_equal(table_read(&claims, path, NULL), FM_OK);
    assert_int_equal(claims->row_count, FIGURES);
    table_close(claims);
    text_free(&arguments);
    kit_remove_directory(directory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_figure_of_the_run_that_is_gone_replaces_nothing),
        cmocka_unit_test(a_reference_that_is_not_there_replaces_nothing),
        cmocka_unit_test(results_that_are_damaged_since_replace_nothing),
        cmocka_unit_test(a_report_that_cannot_be_written_replaces_nothing),
        cmocka_unit_test(claims_that_cannot_be_written_replace_nothing),
        cmocka_unit_test(a_poorer_report_is_drawn_where_there_is_no_better_one),
        cmocka_unit_test(claims_and_charts_of_before_go_with_their_report),
        cmocka_unit_test(no_figure_is_left_out_in_silence),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
