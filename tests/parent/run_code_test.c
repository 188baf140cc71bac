/* Rows that were begun with other code, with a shell script in a worker's place. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "code/code.h"
#include "image/image_range.h"
#include "kit/fake_plan.h"
#include "parent/run.h"

/* $2 is the request, $3 the result. Answers have the code in the file `code`, if there is one; the
 * one in `later` from the second launch on. These leave the range in `range.low.rgba32f` and
 * `range.high.rgba32f`, if there is one. */
static const char worker_script[] =
    "#!/bin/sh\n"
    "here=$(dirname \"$0\")\n"
    "job=$(sed -n 's,.*\"job\": \"\\(.*\\)\".*,\\1,p' \"$2\")\n"
    "launch=$(sed -n 's,.*\"launch\": \\([0-9]*\\).*,\\1,p' \"$2\")\n"
    "echo \"$job $launch\" >>\"$here/calls\"\n"
    "code=code\n"
    "[ \"$launch\" = 0 ] || [ ! -e \"$here/later\" ] || code=later\n"
    "[ $job != truth ] || ! ls \"$here\"/out/truth/*.code >/dev/null 2>&1 || echo stale "
    ">>\"$here/calls\"\n"
    "[ $job != truth ] || touch \"$(sed -n 's,.*\"truth\": \"\\(.*\\)\".*,\\1,p' \"$2\")\"\n"
    "[ $job != device ] || [ ! -e \"$here/no-device\" ] || {\n"
    "    echo '{\"status\":\"not_supported\",\"reason\":\"driver\",\"message\":\"no driver\"}' "
    ">\"$3\"; exit 0; }\n"
    "range=$(sed -n 's,.*\"range\": \"\\(..*\\)\".*,\\1,p' \"$2\")\n"
    "[ \"$launch\" = 0 ] || [ -z \"$range\" ] || for end in low high; do\n"
    "    [ ! -e \"$here/range.$end.rgba32f\" ] ||\n"
    "        cp \"$here/range.$end.rgba32f\" \"$range.$end.rgba32f\"\n"
    "done\n"
    "[ ! -e \"$here/stop\" ] || [ \"$launch\" = 0 ] || { kill -TERM $FAKE_PARENT; sleep 9; }\n"
    "{ echo '{\"status\":\"ok\",\"message\":\"\",\"image_hashes\":[\"00000000000000aa\"],'\n"
    "  [ ! -e \"$here/$code\" ] || { echo '\"code\":'; cat \"$here/$code\"; echo ,; }\n"
    "  echo '\"device_name\":\"fake\",\"metrics\":{\"rmse\":0.0,\"n\":4,\"tied_pixels\":0},'\n"
    "  echo '\"samples\":[{\"frame\":0,\"metric\":\"frame_ms\",\"value\":2.0,\"unit\":\"ms\"}]}'\n"
    "} >\"$3\"\n";

static const char *const one_case[] = { "a", NULL };

static void open_with_worker(fake_plan *fake, uint32_t launches)
{
    char self[16];
    fake_open(fake, one_case, launches);
    snprintf(self, sizeof self, "%d", getpid());
    setenv("FAKE_PARENT", self, 1); /* between it and the worker is a guard */
    fake_write(fake, "worker.sh", worker_script, "w");
    assert_int_equal(chmod(fake->worker, 0755), 0);
}

static fm_status run_in(fm_run_result *result, const fake_plan *fake, bool is_fresh, fm_error *err)
{
    char directory[96];
    snprintf(directory, sizeof directory, "%s/out", fake->folder);
    const fm_run_desc desc = { .directory = directory,
                               .command = "fragmark run",
                               .timeout_s = 20,
                               .worker = fake->worker,
                               .is_fresh = is_fresh };
    return run_cases(result, &fake->plan, &fake->list, &desc, err);
}

static void run_well(const fake_plan *fake, bool is_fresh)
{
    fm_run_result result;
    fm_error err = { 0 };
    if (run_in(&result, fake, is_fresh, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_true(result.is_counted);
    assert_int_equal(result.ok, 1);
}

static void expect_other_code(const fake_plan *fake, const char *words)
{
    fm_run_result result;
    fm_error err = { 0 };
    assert_int_equal(run_in(&result, fake, false, &err), FM_INVALID);
    assert_true(result.is_other_code);
    if (strstr(err.message, words) == NULL)
        fail_msg("'%s' is not in: %s", words, err.message);
}

static size_t count_in_file(const fake_plan *fake, const char *name, const char *words)
{
    size_t count = 0;
    char *text = fake_read(fake, name);
    for (const char *at = text; at != NULL && (at = strstr(at, words)) != NULL; at++)
        count++;
    free(text);
    return count;
}

/* A code whose program is the worker that is there now. */
static void write_code(const fake_plan *fake, const char *name, const char *driver)
{
    char text[256], digits[17];
    code_digits(digits, code_hash_file(fake->worker));
    snprintf(text, sizeof text,
             "{\"program\":\"%s\",\"driver\":\"%s\",\"files\":{\"method\":{},\"floor\":{}}}",
             digits, driver);
    fake_write(fake, name, text, "w");
}

static void change_worker(const fake_plan *fake)
{
    fake_write(fake, "worker.sh", "# edited\n", "a");
}

static void finished_run_of_another_program_is_refused_and_stays(void **state)
{
    (void)state;
    static const char *const names[] = { "out/journal.jsonl", "out/samples.csv", "out/summary.csv",
                                         "out/manifest.json" };
    char *before[4];
    fake_plan fake;
    open_with_worker(&fake, 2);
    run_well(&fake, false);
    run_well(&fake, false); /* the same code: nothing to do */
    assert_int_equal(count_in_file(&fake, "calls", "measure"), 2);
    change_worker(&fake);
    for (size_t i = 0; i < 4; i++)
        before[i] = fake_read(&fake, names[i]);
    expect_other_code(&fake, "1 row of a (program)");
    for (size_t i = 0; i < 4; i++) {
        char *after = fake_read(&fake, names[i]);
        assert_string_equal(after, before[i]);
        free(after);
        free(before[i]);
    }
    assert_int_equal(count_in_file(&fake, "calls", "measure"), 2);
    fake_close(&fake);
}

static void fresh_run_measures_anew_and_forgets(void **state)
{
    (void)state;
    fake_plan fake;
    open_with_worker(&fake, 2);
    run_well(&fake, false);
    change_worker(&fake);
    run_well(&fake, true);
    assert_int_equal(count_in_file(&fake, "calls", "measure"), 4);
    assert_int_equal(count_in_file(&fake, "out/samples.csv", "frame_ms"), 2);
    assert_int_equal(count_in_file(&fake, "out/journal.jsonl",
                                   "{\"event\":\"forget\",\"case\":\"0000000000000001\"}"),
                     1);
    run_well(&fake, false); /* and goes on from there */
    change_worker(&fake);
    run_well(&fake, true);
    run_well(&fake, true); /* nothing changed */
    assert_int_equal(count_in_file(&fake, "calls", "measure"), 6);
    assert_int_equal(count_in_file(&fake, "out/samples.csv", "frame_ms"), 2);
    fake_close(&fake);
}

/* Launch 0 of an older program has no tied_pixels, so that launch 1 would not be compared. */
static void journal_without_codes_is_other_code(void **state)
{
    (void)state;
    fake_plan fake;
    open_with_worker(&fake, 1);
    run_well(&fake, false);
    char *journal = fake_read(&fake, "out/journal.jsonl");
    char *code = strstr(journal, ",\"code\":{");
    assert_non_null(code);
    char *end = strstr(code, "}}}");
    assert_non_null(end);
    memmove(code, end + 3, strlen(end + 3) + 1);
    fake_write(&fake, "out/journal.jsonl", journal, "w");
    free(journal);
    expect_other_code(&fake, "1 row of a (recorded before codes were kept)");
    run_well(&fake, true);
    assert_int_equal(count_in_file(&fake, "calls", "measure"), 2);
    fake_close(&fake);
}

static void code_that_changes_under_a_run_ends_it(void **state)
{
    (void)state;
    fake_plan fake;
    open_with_worker(&fake, 2);
    write_code(&fake, "code", "00000000000000d1");
    write_code(&fake, "later", "00000000000000d2");
    expect_other_code(&fake, "other code than the row began with: driver");
    assert_int_equal(count_in_file(&fake, "out/journal.jsonl", "\"event\":\"end\""), 1);
    assert_int_equal(count_in_file(&fake, "out/journal.jsonl", "\"event\":\"stop\""), 1);
    assert_int_equal(count_in_file(&fake, "out/samples.csv", "frame_ms"), 1);
    fake_close(&fake);
}

static void write_range(const fake_plan *fake)
{
    char path[96];
    fm_image *image = NULL;
    fm_image_range range = { NULL, NULL };
    snprintf(path, sizeof path, "%s/range", fake->folder);
    assert_int_equal(image_create(&image, 2, 1, NULL), FM_OK);
    assert_int_equal(image_range_add(&range, image, NULL), FM_OK);
    assert_int_equal(image_range_write(path, &range, NULL), FM_OK);
    image_range_free(&range);
    image_destroy(image);
}

static bool has_file(const fake_plan *fake, const char *folder, const char *ending)
{
    char path[128];
    snprintf(path, sizeof path, "%s/out/%s/%s%s", fake->folder, folder, fake->cases[0].id, ending);
    return access(path, F_OK) == 0;
}

/* What it drew is not the row's, either. */
static void a_launch_of_other_code_leaves_no_range(void **state)
{
    (void)state;
    fake_plan fake;
    open_with_worker(&fake, 2);
    write_range(&fake);
    write_code(&fake, "code", "00000000000000d1");
    run_well(&fake, false);
    assert_true(has_file(&fake, "images", FM_RANGE_LOW_ENDING));
    assert_false(has_file(&fake, "work", FM_RANGE_LOW_ENDING));
    fake_close(&fake);
    open_with_worker(&fake, 2);
    write_range(&fake);
    write_code(&fake, "code", "00000000000000d1");
    write_code(&fake, "later", "00000000000000d2");
    expect_other_code(&fake, "other code than the row began with: driver");
    assert_false(has_file(&fake, "images", FM_RANGE_LOW_ENDING));
    assert_false(has_file(&fake, "images", FM_RANGE_HIGH_ENDING));
    assert_false(has_file(&fake, "work", FM_RANGE_LOW_ENDING));
    fake_close(&fake);
}

static void driver_is_looked_at_once_and_only_where_a_row_has_one(void **state)
{
    (void)state;
    fake_plan fake;
    open_with_worker(&fake, 1);
    run_well(&fake, false);
    run_well(&fake, false);
    assert_int_equal(count_in_file(&fake, "calls", "device"), 0); /* its answers have no driver */
    fake_close(&fake);
    open_with_worker(&fake, 1);
    write_code(&fake, "code", "00000000000000d1");
    run_well(&fake, false);
    assert_int_equal(count_in_file(&fake, "calls", "device"), 0);
    run_well(&fake, false);
    assert_int_equal(count_in_file(&fake, "calls", "device"), 1);
    write_code(&fake, "code", "00000000000000d2");
    expect_other_code(&fake, "1 row of a (driver)");
    fake_close(&fake);
}

static void device_that_cannot_be_opened_is_nobodys_fault(void **state)
{
    (void)state;
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    open_with_worker(&fake, 1);
    write_code(&fake, "code", "00000000000000d1");
    run_well(&fake, false);
    fake_write(&fake, "no-device", "", "w");
    assert_int_equal(run_in(&result, &fake, false, &err), FM_IO);
    assert_non_null(strstr(err.message, "dummy:0: rows were measured on it"));
    assert_non_null(strstr(err.message, "no driver"));
    assert_false(result.is_other_code || result.is_damaged);
    assert_false(result.is_counted); /* one row is ok, but none was read */
    assert_int_equal(count_in_file(&fake, "out/summary.csv", ",ok,"), 1);
    fake_close(&fake);
}

/* A truth is no row: what other code captured is captured again, and nobody is asked. */
static void truth_of_other_code_is_captured_again(void **state)
{
    (void)state;
    fake_plan fake;
    fm_run_result result;
    open_with_worker(&fake, 2);
    fake_write(&fake, "stop", "", "w");
    assert_int_equal(run_in(&result, &fake, false, NULL), FM_OK);
    assert_int_equal(result.stop_signal, SIGTERM);
    assert_int_equal(run_in(&result, &fake, false, NULL), FM_OK); /* the truth is as it was */
    assert_int_equal(count_in_file(&fake, "calls", "truth"), 1);
    change_worker(&fake);
    assert_int_equal(run_in(&result, &fake, true, NULL), FM_OK);
    assert_int_equal(count_in_file(&fake, "calls", "truth"), 2);
    fake_close(&fake);
}

/* A truth that was of no use is gone, and what captured it lies there still. */
static void code_of_a_lost_truth_is_not_the_next_ones(void **state)
{
    (void)state;
    fake_plan fake;
    fm_run_result result;
    char command[256];
    open_with_worker(&fake, 2);
    fake_write(&fake, "stop", "", "w");
    assert_int_equal(run_in(&result, &fake, false, NULL), FM_OK);
    snprintf(command, sizeof command, "ls %s/out/truth/*.code && rm %s/out/truth/*.truth",
             fake.folder, fake.folder);
    assert_int_equal(system(command), 0);
    assert_int_equal(run_in(&result, &fake, false, NULL), FM_OK);
    assert_int_equal(count_in_file(&fake, "calls", "truth"), 2);
    assert_int_equal(count_in_file(&fake, "calls", "stale"), 0);
    fake_close(&fake);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finished_run_of_another_program_is_refused_and_stays),
        cmocka_unit_test(fresh_run_measures_anew_and_forgets),
        cmocka_unit_test(journal_without_codes_is_other_code),
        cmocka_unit_test(code_that_changes_under_a_run_ends_it),
        cmocka_unit_test(a_launch_of_other_code_leaves_no_range),
        cmocka_unit_test(driver_is_looked_at_once_and_only_where_a_row_has_one),
        cmocka_unit_test(device_that_cannot_be_opened_is_nobodys_fault),
        cmocka_unit_test(truth_of_other_code_is_captured_again),
        cmocka_unit_test(code_of_a_lost_truth_is_not_the_next_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
