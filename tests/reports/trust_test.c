/* What the first lines of a report say of how far its times are to be trusted. */
#include "claims_kit.h"

#include "page/page.h"
#include "page/report.h"
#include "page/verdict_table.h"

/* Adds column `noisy` to summary.csv, with this text in each row. */
static void mark_rows(const char *directory, const char *noisy)
{
    char path[1024], *bytes = NULL;
    size_t count = 0;
    fm_text marked = { 0 };
    snprintf(path, sizeof path, "%s/summary.csv", directory);
    assert_int_equal(text_read_file(&bytes, &count, path, 1u << 20, NULL), FM_OK);
    const char *ending = "noisy";
    for (const char *line = bytes; *line != '\0'; line += strcspn(line, "\n") + 1) {
        text_add(&marked, "%.*s,%s\n", (int)strcspn(line, "\n"), line, ending);
        ending = noisy;
    }
    kit_write_file(directory, "summary.csv", marked.bytes);
    text_free(&marked);
    free(bytes);
}

/* The page up to its first list of facts. */
static void begin_page(char start[4096], const fakes *rows, const char *noisy)
{
    char directory[64];
    fm_error err = { 0 };
    fm_result_files *results = NULL;
    fm_text page = { 0 };
    kit_make_results(directory, rows);
    if (noisy != NULL)
        mark_rows(directory, noisy);
    if (result_files_read(&results, directory, &err) != FM_OK)
        fail_msg("%s", err.message);
    page_begin(&page, results, false);
    const char *body = strstr(page.bytes, "<h1>");
    assert_non_null(body);
    snprintf(start, 4096, "%.*s", (int)(strstr(body, "<dl>") - body), body);
    text_free(&page);
    result_files_close(results);
    kit_remove_directory(directory);
}

static const fakes usual = { { { ROW("a", 4, 1, 10) }, { ROW("b", 4, 1, 20) } } };

static void a_busy_machine_is_told_before_anything_else(void **state)
{
    (void)state;
    char start[4096];
    begin_page(start, &usual, "threads waited <40 % of the time");
    assert_non_null(strstr(start, "2 of 2 timed cases are noisy"));
    assert_non_null(strstr(start, "threads waited &#60;40 %"));
}

static void a_quiet_run_is_not_called_noisy(void **state)
{
    (void)state;
    char start[4096];
    begin_page(start, &usual, "");
    assert_null(strstr(start, "class=note"));
}

/* Files of before have no such column. */
static void a_file_without_the_column_is_read(void **state)
{
    (void)state;
    char start[4096];
    begin_page(start, &usual, NULL);
    assert_null(strstr(start, "class=note"));
}

static void cases_of_one_launch_are_told(void **state)
{
    (void)state;
    char start[4096];
    const fakes once = { { { ROW("a", 4, 1, 10), .launches = 1 }, { ROW("b", 4, 1, 20) } } };
    begin_page(start, &once, NULL);
    assert_non_null(strstr(start, "1 of 2 timed cases had one launch"));
}

/* The report of two cases of one launch, made for a figure with this head. */
static char *report_for(const char *head)
{
    char directory[64], path[96], *html = NULL;
    size_t count;
    fm_error err = { 0 };
    fm_result_files *results = NULL;
    fm_paper_figure *figure = NULL;
    fm_report_outcome outcome;
    const fakes once = { { { ROW("a", 4, 1, 10), .launches = 1 },
                           { ROW("b", 4, 1, 20), .launches = 1 } } };
    kit_make_results(directory, &once);
    kit_write_file(directory, "f.yml", head);
    snprintf(path, sizeof path, "%s/f.yml", directory);
    assert_int_equal(paper_figure_read(&figure, path, &err), FM_OK);
    assert_int_equal(result_files_read(&results, directory, &err), FM_OK);
    const fm_paper_figure *const figures[] = { figure };
    const fm_report_desc desc = { .results = results,
                                  .figures = figures,
                                  .figure_count = 1,
                                  .error = error_kind_find(NULL, NULL) };
    assert_int_equal(report_write(&outcome, &desc, &err), FM_OK);
    snprintf(path, sizeof path, "%s/report.html", directory);
    assert_int_equal(text_read_file(&html, &count, path, 64 << 20, &err), FM_OK);
    paper_figure_close(figure);
    result_files_close(results);
    kit_remove_directory(directory);
    return html;
}

/* One launch is what such figures ask for. */
static void one_launch_of_an_untimed_figure_is_no_fault(void **state)
{
    (void)state;
    char *timed = report_for("id: f\npaper: p\ntitle: t\n");
    char *untimed = report_for("id: f\npaper: p\ntitle: t\nuntimed: true\n");
    assert_non_null(strstr(timed, "2 of 2 timed cases had one launch"));
    assert_non_null(strstr(timed, "One launch only"));
    assert_null(strstr(timed, "enough for figures without times"));
    assert_null(strstr(untimed, "timed cases had one launch"));
    assert_null(strstr(untimed, "One launch only"));
    assert_non_null(strstr(untimed, "enough for figures without times"));
    free(timed);
    free(untimed);
}

/* Beside the number of a claim stands its interval, or that there is none. */
static void a_claim_without_an_interval_says_so(void **state)
{
    (void)state;
    char directory[64];
    fm_error err = { 0 };
    fm_result_files *results = NULL;
    fm_paper_figure *figure = NULL;
    fm_claim_results verdicts;
    fm_text page = { 0 };
    const fakes once = { { { ROW("a", 4, 1, 10), .launches = 1 } } };
    kit_make_results(directory, &once);
    assert_int_equal(kit_read_figure(&figure, directory, "at_most: 99\nof: { method: a }\n", &err),
                     FM_OK);
    assert_int_equal(result_files_read(&results, directory, &err), FM_OK);
    const fm_paper_figure *const figures[] = { figure };
    const fm_verdicts_desc desc = { results, NULL, figures, 1 };
    assert_int_equal(verdicts_make(&verdicts, &desc, &err), FM_OK);
    verdict_table_add(&page, &verdicts, "f");
    assert_non_null(strstr(page.bytes, "one launch, no interval"));
    assert_null(strstr(page.bytes, "nan"));
    text_free(&page);
    verdicts_free(&verdicts);
    paper_figure_close(figure);
    result_files_close(results);
    kit_remove_directory(directory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_busy_machine_is_told_before_anything_else),
        cmocka_unit_test(a_quiet_run_is_not_called_noisy),
        cmocka_unit_test(a_file_without_the_column_is_read),
        cmocka_unit_test(cases_of_one_launch_are_told),
        cmocka_unit_test(one_launch_of_an_untimed_figure_is_no_fault),
        cmocka_unit_test(a_claim_without_an_interval_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
