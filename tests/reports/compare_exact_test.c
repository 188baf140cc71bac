/* Two runs compared: what needs no interval, status, fragments, errors, pictures and code. */
#include "compare_kit.h"

#include <sys/stat.h>

static void expect_changes(const kit_comparison *kit, const char *id, const char *expected)
{
    fm_text changes = { 0 };
    compared_add_changes(&changes, kit_case(kit, id));
    assert_string_equal(changes.bytes != NULL ? changes.bytes : "", expected);
    text_free(&changes);
}

static void what_is_exact_is_compared_without_intervals(void **state)
{
    static const char *const base[] = {
        "k=1",
        "k=2;rmse=1e-8",
        "k=3;rmse=0.1;total_rmse=0.1",
        "method=racy;missing=5;rmse=0.1",
        "k=5",
        "k=6;missing=;distinct_images=3",
    };
    static const char *const now[] = {
        "k=1;bytes_allocated=4100;method_version=2",
        "k=2;rmse=3e-8", /* rounding */
        "k=3;rmse=0.2;total_rmse=0.2;missing=7",
        "method=racy;missing=6;rmse=0.2;bytes_allocated=8",
        "k=5;status=wrong_image;extra=1",
        "k=6;missing=4;extra=9;distinct_images=1", /* need not repeat, and now does */
    };
    kit_comparison kit;
    (void)state;
    kit_compare(&kit, &(kit_run_desc){ ROWS(base) }, &(kit_run_desc){ ROWS(now) }, NULL);
    expect_changes(&kit, "c0", "method_version 1 -> 2; bytes_allocated 4096 -> 4100");
    expect_changes(&kit, "c1", "");
    expect_changes(&kit, "c2", "missing 0 -> 7; rmse 0.1 -> 0.2; total_rmse 0.1 -> 0.2");
    expect_changes(&kit, "c3", "bytes_allocated 4096 -> 8");
    expect_changes(&kit, "c4", "status ok -> wrong_image; extra 0 -> 1");
    expect_changes(&kit, "c5", "distinct_images 3 -> 1");
    assert_int_equal(comparison_changed(&kit.made), 5);
    kit_end(&kit);
}

/* Only the trait, or a BASE that did not repeat either, excuses errors that do not. */
static void methods_that_became_unsteady_hide_nothing(void **state)
{
    static const char *const base[] = {
        "k=1;frames_rmse_max=0",
        "method=racy;distinct_images=1",
        "k=3;distinct_images=2;missing=4;frames_rmse_max=0.1",
        "k=4;distinct_images=",
    };
    static const char *const now[] = {
        "k=1;distinct_images=2;missing=5;rmse=0.3;frames_rmse_max=0.4",
        "method=racy;distinct_images=2;missing=5;frames_rmse_max=0.4",
        "k=3;distinct_images=3;missing=5;frames_rmse_max=0.2",
        "k=4;distinct_images=2",
    };
    kit_comparison kit;
    (void)state;
    kit_compare(&kit, &(kit_run_desc){ ROWS(base) }, &(kit_run_desc){ ROWS(now) }, NULL);
    expect_changes(&kit, "c0",
                   "missing 0 -> 5; rmse 0 -> 0.3; distinct_images 1 -> 2; "
                   "frames_rmse_max 0 -> 0.4");
    expect_changes(&kit, "c1", "");
    expect_changes(&kit, "c2", "");
    expect_changes(&kit, "c3", "");
    kit_end(&kit);
}

static void a_cell_that_one_run_leaves_empty_is_a_change(void **state)
{
    static const char *const base[] = { "k=1", "k=2;missing=", "k=3;missing=", "k=4;rmse=" };
    static const char *const now[] = { "k=1;rmse=", "k=2", "k=3;missing=", "k=4;rmse=0" };
    kit_comparison kit;
    (void)state;
    kit_compare(&kit, &(kit_run_desc){ ROWS(base) }, &(kit_run_desc){ ROWS(now) }, NULL);
    expect_changes(&kit, "c0", "rmse 0 -> (empty)");
    expect_changes(&kit, "c1", "missing (empty) -> 0");
    expect_changes(&kit, "c2", "");
    expect_changes(&kit, "c3", "rmse (empty) -> 0");
    kit_end(&kit);
}

#define DREW(id, hashes)                                                                           \
    "{\"event\":\"end\",\"case\":\"" id "\",\"launch\":0,\"result\":{\"image_hashes\":[" hashes    \
    "]}}\n"

#define HASH(first, last) "\"" #first "00000000000000" #last "\""

/* Case 0 has another picture, 1 the same, 2 one that is forgotten, 3 several, 4 another driver's,
 * 5 none that is told. */
static void pictures_are_compared_by_their_hashes(void **state)
{
    static const char *const rows[] = { "k=1", "k=2", "k=3", "k=4", "k=5", "k=6" };
    static const char *const others[] = { "k=1", "k=2", "k=3", "k=4", "k=5;code_driver=e", "k=6" };
    const kit_run_desc base = { ROWS(rows),
                                .journal = DREW("c0", HASH(0, a)) DREW("c1", HASH(0, b))
                                    DREW("c2", HASH(0, c)) "not JSON\n" DREW("c3", HASH(0, d))
                                        DREW("c4", HASH(0, e)) DREW("other", HASH(0, f)) };
    const kit_run_desc now = {
        ROWS(others),
        .journal = DREW("c0", HASH(1, a)) DREW("c0", HASH(1, a)) DREW("c1", HASH(0, b))
            DREW("c2", HASH(9, c)) "{\"event\":\"forget\",\"case\":\"c2\"}\n" DREW("c2", HASH(0, c))
                DREW("c3", HASH(1, d) "," HASH(2, d)) DREW("c4", HASH(1, e))
    };
    kit_comparison kit;
    (void)state;
    kit_compare(&kit, &base, &now, NULL);
    expect_changes(&kit, "c0", "image 000000000000000a -> 100000000000000a");
    assert_int_equal(comparison_changed(&kit.made), 1);
    kit_end(&kit);
}

/* "several" stands for more than one; a journal that says so itself has no hash. */
static void what_is_no_hash_is_no_picture(void **state)
{
    static const char *const rows[] = { "k=1", "k=2", "k=3" };
    const kit_run_desc base = { ROWS(rows), .journal = DREW("c0", HASH(0, a)) DREW("c1", HASH(0, b))
                                                DREW("c2", HASH(0, c)) };
    const kit_run_desc now = { ROWS(rows), .journal = DREW("c0", "\"several\"")
                                               DREW("c1", "\"123456789ABCDEF0\",7")
                                                   DREW("c2", "\"several\"," HASH(1, c)) };
    kit_comparison kit;
    (void)state;
    kit_compare(&kit, &base, &now, NULL);
    expect_changes(&kit, "c2", "image 000000000000000c -> 100000000000000c");
    assert_int_equal(comparison_changed(&kit.made), 1);
    kit_end(&kit);
}

static void a_journal_that_cannot_be_read_is_an_error(void **state)
{
    static const char *const one[] = { "k=1" };
    char path[96];
    kit_run run;
    fm_images images;
    fm_error err = { 0 };
    (void)state;
    kit_open(&run, &(kit_run_desc){ ROWS(one) });
    snprintf(path, sizeof path, "%s/journal.jsonl", run.directory);
    assert_int_equal(mkdir(path, 0700), 0);
    assert_int_equal(images_read(&images, run.results, &err), FM_IO);
    assert_non_null(strstr(err.message, path));
    images_free(&images);
    kit_close(&run);
}

static void other_code_is_told_by_its_parts(void **state)
{
    static const char *const base[] = { "k=1", "k=2", "k=3;code_driver=" };
    static const char *const now[] = { "k=1;code_program=q;code_shaders=t", "k=2",
                                       "k=3;code_driver=e;code_plugin=m" };
    kit_comparison kit;
    (void)state;
    kit_compare(&kit, &(kit_run_desc){ ROWS(base) }, &(kit_run_desc){ ROWS(now) }, NULL);
    assert_string_equal(kit_case(&kit, "c0")->code, "program shaders");
    assert_string_equal(kit_case(&kit, "c1")->code, "");
    assert_string_equal(kit_case(&kit, "c2")->code,
                        "plugin"); /* which driver it was is not known */
    kit_end(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_exact_is_compared_without_intervals),
        cmocka_unit_test(methods_that_became_unsteady_hide_nothing),
        cmocka_unit_test(a_cell_that_one_run_leaves_empty_is_a_change),
        cmocka_unit_test(pictures_are_compared_by_their_hashes),
        cmocka_unit_test(what_is_no_hash_is_no_picture),
        cmocka_unit_test(a_journal_that_cannot_be_read_is_an_error),
        cmocka_unit_test(other_code_is_told_by_its_parts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
