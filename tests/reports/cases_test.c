/* Result files become cases. */
#include "claims_kit.h"
#include "model/columns.h"
#include "read/case_metrics.h"

static const fakes one = { { { ROW("a", 4, 0.25, 10) } } };

static void every_number_of_the_summary_is_read(void **state)
{
    (void)state;
    static const char *const texts[] = { "order", "seed" };
    char directory[64];
    fm_result_files *results = NULL;
    kit_make_results(directory, &one);
    assert_int_equal(result_files_read(&results, directory, NULL), FM_OK);
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++) {
        double value;
        const char *name = column_name(&fm_columns[i]);
        const bool is_text = fm_columns[i].kind == FM_COLUMN_FACT || strcmp(name, texts[0]) == 0 ||
                             strcmp(name, texts[1]) == 0;
        if (case_number(&value, &results->cases[0], name) == is_text)
            fail_msg("%s is %s", name, is_text ? "a text" : "a number");
    }
    result_files_close(results);
    kit_remove_directory(directory);
}

/* The kit's summary.csv is as old as schema 1: wrong_tiles had no column then. */
static void a_metric_from_before_its_column_is_read_from_the_samples(void **state)
{
    (void)state;
    char directory[64];
    fm_result_files *results = NULL;
    kit_make_results(directory, &one);
    kit_write_file(directory, "samples.csv",
                   "schema,run_id,case_id,launch,frame,metric,value,unit\n"
                   "1,r,c0,,,wrong_tiles,7,\n");
    assert_int_equal(result_files_read(&results, directory, NULL), FM_OK);
    assert_true(case_metric(results, &results->cases[0], "wrong_tiles") >= 7.0);
    result_files_close(results);
    kit_remove_directory(directory);
}

/* A bit of a case says whose it is: one figure too many would have no case, and no error. */
static void figures_beyond_the_bits_are_refused(void **state)
{
    (void)state;
    char directory[64];
    fm_text csv = { 0 };
    fm_error err = { 0 };
    fm_result_files *results = NULL;
    kit_make_results(directory, &one);
    text_add(&csv, "figure,case_id\n");
    for (int i = 0; i <= FM_RESULT_FIGURES; i++)
        text_add(&csv, "f-%d,c0\n", i);
    kit_write_file(directory, "figures.csv", csv.bytes);
    assert_int_equal(result_files_read(&results, directory, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "figures.csv:66: more than 64 figures"));
    text_free(&csv);
    kit_remove_directory(directory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_number_of_the_summary_is_read),
        cmocka_unit_test(a_metric_from_before_its_column_is_read_from_the_samples),
        cmocka_unit_test(figures_beyond_the_bits_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
