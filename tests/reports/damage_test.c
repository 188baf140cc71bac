/* Result files that are damaged, foreign or short: refused with file, line and column, or read with
 * a word on what is missing. */
#include <unistd.h>

#include "claims_kit.h"

static const fakes two = { { { ROW("a", 4, 0.25, 10) }, { ROW("b", 8, 0.25, 20) } } };

/* Where the cell of that row and column begins and ends; the kit quotes nothing. Row 0 is the
 * header. */
static void find_cell(const char *text, size_t row, size_t column, size_t *begin, size_t *end)
{
    size_t at = 0;
    for (size_t i = 0; i < row; i++)
        at += strcspn(text + at, "\n") + 1;
    for (size_t i = 0; i < column; i++)
        at += strcspn(text + at, ",\n") + 1;
    *begin = at;
    *end = at + strcspn(text + at, ",\n");
}

static size_t column_of(const char *text, const char *name)
{
    for (size_t i = 0;; i++) {
        size_t begin, end;
        find_cell(text, 0, i, &begin, &end);
        if (strlen(name) == end - begin && strncmp(text + begin, name, end - begin) == 0)
            return i;
        if (text[end] == '\n')
            fail_msg("no column %s", name);
    }
}

static char *read_file(const char *directory, const char *name)
{
    char path[256], *bytes = NULL;
    size_t count;
    snprintf(path, sizeof path, "%s/%s", directory, name);
    assert_int_equal(text_read_file(&bytes, &count, path, 1u << 20, NULL), FM_OK);
    return bytes;
}

/* value NULL: the line is written twice. */
static void damage_cell(const char *directory, const char *file, size_t row, const char *column,
                        const char *value)
{
    char *text = read_file(directory, file);
    size_t begin, end;
    fm_text damaged = { 0 };
    find_cell(text, row, value != NULL ? column_of(text, column) : 0, &begin, &end);
    if (value != NULL)
        text_add(&damaged, "%.*s%s%s", (int)begin, text, value, text + end);
    else
        text_add(&damaged, "%s%.*s\n", text, (int)strcspn(text + begin, "\n"), text + begin);
    kit_write_file(directory, file, damaged.bytes);
    text_free(&damaged);
    free(text);
}

static const char samples[] = "schema,run_id,case_id,launch,frame,metric,value,unit\n"
                              "1,r,c0,0,0,frame_ms,10,ms\n"
                              "1,r,c1,0,0,frame_ms,20,ms\n";

static void each_damaged_cell_is_named(void **state)
{
    (void)state;
    static const struct {
        const char *file;
        size_t row;
        const char *column, *value, *says;
    } damage[] = {
        { "summary.csv", 2, "schema", "2", "summary.csv:3: schema: \"2\"; this program reads sch" },
        { "summary.csv", 2, "", NULL,
          "summary.csv:4: case_id: \"c1\" has a row already, in line 3" },
        { "summary.csv", 1, "status", "fine", "summary.csv:2: status \"fine\" is none of" },
        { "summary.csv", 1, "frame_ms", "-5", "summary.csv:2: frame_ms: \"-5\": a number from 0" },
        { "summary.csv", 1, "frame_ms", "inf",
          "summary.csv:2: frame_ms: \"inf\": a number from 0" },
        { "summary.csv", 1, "store_ms", "nan",
          "summary.csv:2: store_ms: \"nan\": a number from 0" },
        { "summary.csv", 1, "frame_ms", "1x", "summary.csv:2: frame_ms: \"1x\" is not a number" },
        { "summary.csv", 1, "frame_ms_low", "99", "summary.csv:2: frame_ms_low: 99 is above" },
        { "summary.csv", 1, "missing", "-1", "summary.csv:2: missing: \"-1\": a whole number" },
        { "summary.csv", 1, "bytes_predicted", "-1", "bytes_predicted: \"-1\": a whole" },
        { "summary.csv", 1, "width_px", "-64", "summary.csv:2: width_px: \"-64\": a number" },
        { "summary.csv", 1, "pixel_density", "25", "pixel_density: 25: a share is at most 1" },
        { "summary.csv", 1, "order", "a,b", "summary.csv:2: 52 cells where the header has 51" },
        { "summary.csv", 0, "store_ms", "stor_ms",
          "summary.csv:1: no column \"store_ms\" (there " },
        { "summary.csv", 0, "store_ms", "clear_ms", "summary.csv:1: column \"clear_ms\" appears" },
        { "summary.csv", 0, "n", "n,mad", "summary.csv:1: column \"mad\" is unknown" },
        { "samples.csv", 1, "schema", "2", "samples.csv:2: schema: \"2\"; this program reads" },
        { "samples.csv", 1, "value", "-5", "samples.csv:2: value: \"-5\": a number from 0" },
        { "samples.csv", 1, "value", "inf", "samples.csv:2: value: \"inf\": a number from 0" },
        { "samples.csv", 2, "value", "many", "samples.csv:3: value: \"many\" is not a number" },
        { "samples.csv", 1, "frame", "0.5", "samples.csv:2: frame: \"0.5\" is not a whole number" },
        { "samples.csv", 1, "launch", "-1", "samples.csv:2: launch: \"-1\" is not a whole number" },
        { "samples.csv", 1, "launch", "", "samples.csv:2: launch: frame 0 is of none" },
        { "samples.csv", 1, "metric", "", "samples.csv:2: metric: the row has none" },
        { "samples.csv", 0, "schema", "shema", "samples.csv:1: no column \"schema\" (there is" },
    };
    for (size_t i = 0; i < sizeof damage / sizeof damage[0]; i++) {
        char directory[64];
        fm_error err = { 0 };
        fm_result_files *results = NULL;
        kit_make_results(directory, &two);
        kit_write_file(directory, "samples.csv", samples);
        damage_cell(directory, damage[i].file, damage[i].row, damage[i].column, damage[i].value);
        if (strcmp(damage[i].column, "n") == 0) /* as many cells as the header */
            for (size_t row = 1; row <= 2; row++)
                damage_cell(directory, damage[i].file, row, "n", "16,1");
        assert_int_equal(result_files_read(&results, directory, &err), FM_INVALID);
        if (strstr(err.message, damage[i].says) == NULL)
            fail_msg("%s\nlacks %s", err.message, damage[i].says);
        kit_remove_directory(directory);
    }
}

/* Reads the kit's rows, with the column `reason` behind the others. */
static fm_status read_with_reason(fm_result_files **results, const char *status, const char *reason,
                                  fm_error *err)
{
    char directory[64];
    fm_text longer = { 0 };
    fakes rows = two;
    rows.rows[0].status = status;
    kit_make_results(directory, &rows);
    char *text = read_file(directory, "summary.csv");
    const char *line = text;
    const char *const cells[] = { "reason", reason, "" };
    for (size_t row = 0; row < 3; row++, line += strcspn(line, "\n") + 1)
        text_add(&longer, "%.*s,%s\n", (int)strcspn(line, "\n"), line, cells[row]);
    kit_write_file(directory, "summary.csv", longer.bytes);
    const fm_status read = result_files_read(results, directory, err);
    text_free(&longer);
    free(text);
    kit_remove_directory(directory);
    return read;
}

static void a_reason_is_a_known_word_of_what_is_not_supported(void **state)
{
    (void)state;
    fm_error err = { 0 };
    fm_result_files *results = NULL;
    assert_int_equal(read_with_reason(&results, "not_supported", "loops", &err), FM_OK);
    assert_string_equal(results->cases[0].reason, "loops");
    assert_string_equal(results->cases[1].reason, "");
    result_files_close(results);
    assert_int_equal(read_with_reason(&results, "not_supported", "", &err), FM_OK);
    result_files_close(results);
    assert_int_equal(read_with_reason(&results, "not_supported", "loop", &err), FM_INVALID);
    assert_non_null(
        strstr(err.message, "summary.csv:2: reason \"loop\" is unknown; the nearest is \"loops\""));
    assert_int_equal(read_with_reason(&results, "ok", "loops", &err), FM_INVALID);
    assert_non_null(strstr(err.message, "summary.csv:2: reason \"loops\" of a case that is ok"));
}

static void rows_of_before_the_column_have_no_reason(void **state)
{
    (void)state;
    char directory[64];
    fm_result_files *results = NULL;
    kit_make_results(directory, &two);
    assert_int_equal(result_files_read(&results, directory, NULL), FM_OK);
    assert_string_equal(results->cases[0].reason, "");
    result_files_close(results);
    kit_remove_directory(directory);
}

/* A wrong image may have no finite error; nobody else's row is lost for that. */
static void errors_without_a_number_are_read(void **state)
{
    (void)state;
    char directory[64];
    fm_error err = { 0 };
    fm_result_files *results = NULL;
    kit_make_results(directory, &two);
    damage_cell(directory, "summary.csv", 1, "rmse", "inf");
    damage_cell(directory, "summary.csv", 1, "max_abs", "nan");
    damage_cell(directory, "summary.csv", 2, "rmse", "nan");
    kit_write_file(directory, "samples.csv",
                   "schema,run_id,case_id,launch,frame,metric,value,unit\n"
                   "1,r,c0,,,total_rmse,inf,\n"
                   "1,r,c1,,,self_max_abs,nan,\n");
    if (result_files_read(&results, directory, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_true(isinf(results->cases[0].metric[FM_METRIC_RMSE]));
    assert_true(isinf(results->cases[0].metric[FM_METRIC_TOTAL_RMSE]));
    assert_true(isnan(results->cases[0].metric[FM_METRIC_MAX_ABS]));
    assert_true(isnan(results->cases[1].metric[FM_METRIC_RMSE]));
    result_files_close(results);
    kit_remove_directory(directory);
}

static void columns_of_newer_programs_stand_at_the_end(void **state)
{
    (void)state;
    char directory[64];
    fm_error err = { 0 };
    fm_result_files *results = NULL;
    kit_make_results(directory, &two);
    damage_cell(directory, "summary.csv", 0, "fragments_per_s", "fragments_per_s,newer");
    for (size_t row = 1; row <= 2; row++)
        damage_cell(directory, "summary.csv", row, "fragments_per_s", "1,x");
    if (result_files_read(&results, directory, &err) != FM_OK)
        fail_msg("%s", err.message);
    result_files_close(results);
    kit_remove_directory(directory);
}

static void each_damaged_manifest_is_named(void **state)
{
    (void)state;
    static const struct {
        const char *json, *says;
    } damage[] = {
        { "{\"schema\": 2}", "manifest.json: schema: \"2\"; this program reads schema 1" },
        { "{\"schema\": \"one\"}", "manifest.json: schema: \"one\"; this program reads schema 1" },
        { "{\"schema\": 1, \"figures\": {}}", "manifest.json: figures: not a list" },
        { "{\"schema\": 1,\n\"schema\": 1}", "manifest.json:2: duplicate object key" },
        { "{\"schema\": 1", "manifest.json:1: " },
        { "", "manifest.json:" },
    };
    for (size_t i = 0; i < sizeof damage / sizeof damage[0]; i++) {
        char directory[64];
        fm_error err = { 0 };
        fm_result_files *results = NULL;
        kit_make_results(directory, &two);
        kit_write_file(directory, "manifest.json", damage[i].json);
        assert_int_equal(result_files_read(&results, directory, &err), FM_INVALID);
        if (strstr(err.message, damage[i].says) == NULL)
            fail_msg("%s\nlacks %s", err.message, damage[i].says);
        kit_remove_directory(directory);
    }
}

static void remove_file(const char *directory, const char *name)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    assert_int_equal(unlink(path), 0);
}

static void a_missing_manifest_is_named(void **state)
{
    (void)state;
    char directory[64];
    fm_error err = { 0 };
    fm_result_files *results = NULL;
    kit_make_results(directory, &two);
    remove_file(directory, "manifest.json");
    assert_int_equal(result_files_read(&results, directory, &err), FM_IO);
    assert_non_null(strstr(err.message, "manifest.json: No such file"));
    kit_remove_directory(directory);
}

/* What is said of a folder with these files; NULL: there is none of the name. */
static void assert_missing(const char *sample_rows, const char *journal, const char *says)
{
    char directory[64];
    fm_error err = { 0 };
    fm_result_files *results = NULL;
    kit_make_results(directory, &two);
    if (sample_rows != NULL)
        kit_write_file(directory, "samples.csv", sample_rows);
    else
        remove_file(directory, "samples.csv");
    if (journal != NULL)
        kit_write_file(directory, "journal.jsonl", journal);
    if (result_files_read(&results, directory, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_int_equal(results->missing.count, says[0] != '\0');
    if (says[0] != '\0' && strstr(results->missing.items[0], says) == NULL)
        fail_msg("%s\nlacks %s", results->missing.items[0], says);
    assert_int_equal(results->count, 2);
    result_files_close(results);
    kit_remove_directory(directory);
}

static void what_a_folder_lacks_is_said(void **state)
{
    (void)state;
    static const char plan[] = "{\"event\":\"plan\",\"plan\":\"0\"}\n";
    char torn[256], rotten[256];
    snprintf(torn, sizeof torn, "%s{\"event\":\"beg", plan);
    snprintf(rotten, sizeof rotten, "%s\"event\":\"begin\"}\n%s", plan, plan);
    assert_missing(samples, NULL, "");
    assert_missing(samples, plan, "");
    assert_missing(samples, torn, "");
    assert_missing(samples, rotten, "journal.jsonl is damaged in line 2");
    assert_missing(samples, "{\"event\":\"end\"}\n", "journal.jsonl is damaged in line 1");
    assert_missing(NULL, plan, "samples.csv is not there");
    assert_missing("schema,run_id,case_id,launch,frame,metric,value,unit\n", NULL,
                   "samples.csv has no row of 2 of 2 measured cases");
    assert_missing("schema,run_id,case_id,launch,frame,metric,value,unit\n"
                   "1,r,c0,0,0,frame_ms,10,ms\n",
                   NULL, "samples.csv has no row of 1 of 2 measured cases");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_damaged_cell_is_named),
        cmocka_unit_test(a_reason_is_a_known_word_of_what_is_not_supported),
        cmocka_unit_test(rows_of_before_the_column_have_no_reason),
        cmocka_unit_test(errors_without_a_number_are_read),
        cmocka_unit_test(columns_of_newer_programs_stand_at_the_end),
        cmocka_unit_test(each_damaged_manifest_is_named),
        cmocka_unit_test(a_missing_manifest_is_named),
        cmocka_unit_test(what_a_folder_lacks_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
