/* What is written of a comparison: CSV, JSON, lines, a page with its chart. */
#include "compare_kit.h"

#include <jansson.h>

#include "base/table.h"
#include "draw/dumbbell.h"
#include "page/comparison_page.h"

/* One case of each kind, with texts that must be quoted. */
static void make_mixed(kit_comparison *kit)
{
    static const char *const base[] = { "k=1;method=\"a,<b>\"", "k=2", "k=3" };
    static const char *const now[] = { "k=1;method=\"a,<b>\";frame_ms=20;frame_ms_low=19;"
                                       "frame_ms_high=21",
                                       "k=2;status=crash;frame_ms=;frame_ms_low=;frame_ms_high=",
                                       "k=4;case_id=d" };
    kit_compare(kit, &(kit_run_desc){ ROWS(base) }, &(kit_run_desc){ ROWS(now) }, NULL);
    assert_int_equal(kit->status, FM_OK);
}

static const char *cell(const fm_table *table, size_t row, const char *column)
{
    assert_true(table_column(table, column) != FM_TABLE_NO_COLUMN);
    return table_cell(table, row, table_column(table, column));
}

static void csv_has_a_row_for_each_case_of_either_run(void **state)
{
    kit_comparison kit;
    fm_text csv = { 0 };
    fm_table *table = NULL;
    char path[128];
    (void)state;
    make_mixed(&kit);
    comparison_add_csv(&csv, &kit.made);
    snprintf(path, sizeof path, "%s/compare.csv", kit.now.directory);
    assert_int_equal(text_write_file(path, csv.bytes, csv.length, NULL), FM_OK);
    assert_int_equal(table_read(&table, path, NULL), FM_OK); /* strictly */
    assert_int_equal(table->row_count, 4);
    assert_string_equal(cell(table, 0, "exact"), "status ok -> crash");
    assert_string_equal(cell(table, 0, "ratio"), "");
    assert_string_equal(cell(table, 1, "method"), "a,<b>");
    assert_string_equal(cell(table, 1, "ratio"), "2");
    assert_string_equal(cell(table, 1, "verdict"), "slower");
    assert_string_equal(cell(table, 1, "exact"), "equal");
    assert_string_equal(cell(table, 1, "bytes_allocated_new"), "4096");
    assert_string_equal(cell(table, 2, "why"), "only in BASE");
    assert_string_equal(cell(table, 3, "case_id_new"), "d");
    table_close(table);
    text_free(&csv);
    kit_end(&kit);
}

/* Of the case that is twice as slow nothing but its time changed. */
static void what_is_exact_has_verdicts_of_its_own(void **state)
{
    kit_comparison kit;
    fm_text csv = { 0 }, json = { 0 };
    fm_table *table = NULL;
    char path[128];
    (void)state;
    make_mixed(&kit);
    comparison_add_exact_csv(&csv, &kit.made);
    snprintf(path, sizeof path, "%s/gate.csv", kit.now.directory);
    assert_int_equal(text_write_file(path, csv.bytes, csv.length, NULL), FM_OK);
    assert_int_equal(table_read(&table, path, NULL), FM_OK);
    assert_int_equal(table->row_count, 4);
    assert_true(table_column(table, "ratio") == FM_TABLE_NO_COLUMN);
    assert_string_equal(cell(table, 0, "verdict"), "worse");
    assert_string_equal(cell(table, 0, "exact"), "status ok -> crash");
    assert_string_equal(cell(table, 1, "verdict"), "equal");
    assert_string_equal(cell(table, 2, "verdict"), "only in BASE");
    assert_string_equal(cell(table, 3, "verdict"), "only in NEW");
    assert_string_equal(cell(table, 3, "bytes_allocated_new"), "4096");
    assert_int_equal(comparison_add_exact_json(&json, &kit.made, NULL), FM_OK);
    json_t *object = json_loadb(json.bytes, json.length, 0, NULL);
    const json_t *counts = json_object_get(object, "counts");
    assert_int_equal(json_integer_value(json_object_get(counts, "worse")), 1);
    assert_int_equal(json_integer_value(json_object_get(counts, "differs")), 0);
    assert_int_equal(json_integer_value(json_object_get(counts, "equal")), 1);
    const json_t *slow = json_array_get(json_object_get(object, "cases"), 1);
    assert_string_equal(json_string_value(json_object_get(slow, "verdict")), "equal");
    assert_null(json_object_get(slow, "ratio"));
    assert_int_equal(json_array_size(json_object_get(object, "only_in_base")), 1);
    json_decref(object);
    table_close(table);
    text_free(&json);
    text_free(&csv);
    kit_end(&kit);
}

static void json_tells_the_same(void **state)
{
    kit_comparison kit;
    fm_text text = { 0 };
    (void)state;
    make_mixed(&kit);
    assert_int_equal(comparison_add_json(&text, &kit.made, NULL), FM_OK);
    json_t *object = json_loadb(text.bytes, text.length, 0, NULL);
    assert_non_null(object);
    const json_t *cases = json_object_get(object, "cases");
    assert_int_equal(json_array_size(cases), 2);
    const json_t *slow = json_array_get(cases, 1);
    assert_string_equal(json_string_value(json_object_get(slow, "verdict")), "slower");
    const json_t *ratio = json_object_get(slow, "ratio");
    assert_true(json_real_value(json_object_get(ratio, "median")) == 2.0);
    assert_true(json_is_null(
        json_object_get(json_object_get(json_array_get(cases, 0), "ratio"), "median")));
    assert_int_equal(json_array_size(json_object_get(object, "only_in_new")), 1);
    assert_int_equal(
        json_integer_value(json_object_get(json_object_get(object, "counts"), "untimed")), 1);
    json_decref(object);
    text_free(&text);
    kit_end(&kit);
}

static void lines_name_the_cases_and_sum_up(void **state)
{
    static const char *const words[] = {
        "slower   2.000",
        "a,<b>, k 1, n 16, layers, vulkan, raster, 64 x 32",
        "status ok -> crash",
        "only in BASE  a, k 3, n 16",
        "only in NEW  a, k 4, n 16",
        "2 cases: 1 slower, 0 unclear, 0 same, 0 faster, 1 untimed; status, memory, fragments and",
        "errors: 1 equal, 1 changed; 1 only in BASE, 1 only in NEW\n",
    };
    kit_comparison kit;
    fm_text text = { 0 };
    (void)state;
    make_mixed(&kit);
    comparison_add_lines(&text, &kit.made);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strstr(text.bytes, words[i]) == NULL)
            fail_msg("'%s' is not in:\n%s", words[i], text.bytes);
    text_free(&text);
    kit_end(&kit);
}

static void page_holds_chart_and_names_but_no_foreign_tags(void **state)
{
    kit_comparison kit;
    fm_error err = { 0 };
    char path[128], *bytes = NULL;
    size_t count;
    (void)state;
    make_mixed(&kit);
    snprintf(path, sizeof path, "%s/compare.html", kit.now.directory);
    if (comparison_page_write(path, &kit.made, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_int_equal(text_read_file(&bytes, &count, path, 1 << 24, NULL), FM_OK);
    assert_non_null(strstr(bytes, "<svg"));
    assert_non_null(strstr(bytes, "<td>a,&#60;b&#62;, k 1"));
    assert_null(strstr(bytes, "a,<b>"));
    assert_non_null(strstr(bytes, "status ok -&#62; crash"));
    assert_non_null(strstr(bytes, "</body></html>"));
    free(bytes);
    kit_end(&kit);
}

/* BASE and NEW of the worst sixty; a run without times has no chart. */
static void dumbbells_are_of_the_worst_cases(void **state)
{
    enum { CASES = 70 };
    static char cells[CASES][32];
    static const char *rows[CASES];
    static const char *const untimed[] = { "seed=1;status=crash;frame_ms=" };
    kit_comparison kit;
    fm_chart chart;
    (void)state;
    for (int i = 0; i < CASES; i++) {
        snprintf(cells[i], sizeof cells[i], "seed=%d", i + 1);
        rows[i] = cells[i];
    }
    kit_compare(&kit, &(kit_run_desc){ ROWS(rows) }, &(kit_run_desc){ ROWS(rows) }, NULL);
    assert_int_equal(dumbbell_chart(&chart, &kit.made, NULL), FM_OK);
    assert_int_equal(chart.label_count, FM_DUMBBELL_CASES);
    assert_int_equal(chart.series_count, FM_DUMBBELL_CASES + 2); /* lines, BASE, NEW */
    assert_string_equal(chart.subtitle, "the worst 60 of 70 cases");
    chart_free(&chart);
    kit_end(&kit);
    kit_compare(&kit, &(kit_run_desc){ ROWS(untimed) }, &(kit_run_desc){ ROWS(untimed) }, NULL);
    assert_int_equal(dumbbell_chart(&chart, &kit.made, NULL), FM_UNSUPPORTED);
    kit_end(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(csv_has_a_row_for_each_case_of_either_run),
        cmocka_unit_test(what_is_exact_has_verdicts_of_its_own),
        cmocka_unit_test(json_tells_the_same),
        cmocka_unit_test(lines_name_the_cases_and_sum_up),
        cmocka_unit_test(page_holds_chart_and_names_but_no_foreign_tags),
        cmocka_unit_test(dumbbells_are_of_the_worst_cases),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
