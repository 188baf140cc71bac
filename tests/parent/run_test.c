/* The parent, with a shell script in a worker's place. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/resource.h>

#include <cmocka.h>

#include "fake_worker.h"

static void run_measures_each_case_in_each_round(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "b", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 3);
    const fm_run_result result = run_well(&fake);
    assert_int_equal(result.ok, 2);
    assert_int_equal(result.failed + result.not_supported + result.skipped, 0);
    assert_int_equal(count_in_file(&fake, "calls", "truth\n"), 1); /* shared by both */
    assert_int_equal(count_in_file(&fake, "calls", "a "), 3);
    assert_int_equal(count_in_file(&fake, "calls", "b "), 3);
    assert_int_equal(count_in_file(&fake, "out/samples.csv", "frame_ms"), 12);
    assert_in_file(&fake, "out/summary.csv", "1,0000000000000001,ok,,a,7,dummy:0,fake,raster,");
    assert_in_file(&fake, "out/manifest.json", "\"ended\": \"20");
    assert_null(fake_read(&fake, "out/work/0000000000000001.request.json"));
    char path[128];
    snprintf(path, sizeof path, "%s/out/truth", fake.folder);
    assert_int_not_equal(access(path, F_OK), 0); /* done: no truth is left */
    fake_close(&fake);
}

static void use_mesh(fake_plan *fake, const char *file)
{
    for (size_t i = 0; i < fake->plan.count; i++) {
        fake->cases[i].settings.generator = FM_GENERATOR_MESH;
        fake->cases[i].settings.mesh = text_shared(file);
    }
}

/* Not once a case or a launch, and not again when a run goes on. */
static void run_tells_a_mesh_once(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "b", NULL };
    fake_plan fake;
    char told[96], directory[96];
    fm_run_result result;
    open_with_worker(&fake, ids, 2);
    use_mesh(&fake, "/fake/cube.ply");
    snprintf(told, sizeof told, "%s/told", fake.folder);
    snprintf(directory, sizeof directory, "%s/out", fake.folder);
    FILE *progress = fopen(told, "w");
    const fm_run_desc desc = {
        .directory = directory, .timeout_s = 20, .worker = fake.worker, .progress = progress
    };
    for (int i = 0; i < 2; i++)
        assert_int_equal(run_cases(&result, &fake.plan, &fake.list, &desc, NULL), FM_OK);
    fclose(progress);
    assert_int_equal(count_in_file(&fake, "told", "/fake/cube.ply: a cube\n"), 1);
    assert_int_equal(count_in_file(&fake, "out/manifest.json", "\"told\": \"a cube\""), 1);
    fake_close(&fake);
}

/* Libraries that read meshes crash too: who looks for the reason needs the file. */
static void run_names_the_mesh_of_a_crash(void **state)
{
    (void)state;
    static const char *const ids[] = { "crash", "hang", NULL };
    fake_plan fake;
    fm_run_result result;
    open_with_worker(&fake, ids, 1);
    use_mesh(&fake, "/fake/bad.3ds");
    assert_int_equal(run_in(&result, &fake, 3, NULL), FM_OK);
    assert_in_file(&fake, "out/summary.csv",
                   "crash,\"killed by SIGSEGV; its scene reads /fake/bad.3ds; its last words: ");
    assert_in_file(&fake, "out/summary.csv",
                   "timeout,no answer within 3 s; its scene reads /fake/bad.3ds,");
    fake_close(&fake);
}

static void run_writes_a_command_that_is_not_utf8(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 1);
    run_well(&fake);
    assert_in_file(&fake, "out/manifest.json", "\"fragmark run -o caf?\"");
    fake_close(&fake);
}

static void run_interleaves_the_cases(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "b", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 2);
    run_well(&fake);
    char *calls = fake_read(&fake, "calls");
    assert_non_null(calls);
    const char *second_round = strstr(calls, " 1\n");
    assert_non_null(strstr(calls, "a 0\n"));
    assert_true(strstr(calls, "a 0\n") < second_round);
    assert_true(strstr(calls, "b 0\n") < second_round);
    free(calls);
    fake_close(&fake);
}

static void run_records_every_way_a_worker_can_fail(void **state)
{
    (void)state;
    static const char *const ids[] = {
        "crash", "garbage", "good", "hang", "silent", "status", NULL
    };
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    open_with_worker(&fake, ids, 2);
    assert_int_equal(run_in(&result, &fake, 2, &err), FM_OK);
    assert_int_equal(result.ok, 1);
    assert_int_equal(result.failed, 5);
    assert_in_file(&fake, "out/summary.csv",
                   "crash,\"killed by SIGSEGV; its last words: \"\"last words\"\"; and so the "
                   "first time\",crash");
    assert_in_file(&fake, "out/summary.csv", "crash,the worker's result cannot be used: ");
    assert_in_file(&fake, "out/summary.csv", "timeout,no answer within 2 s,hang");
    assert_in_file(&fake, "out/summary.csv",
                   "crash,exited with status 3 and left no result; and so the first time,silent");
    assert_in_file(&fake, "out/summary.csv", "'status' is none of the known words");
    assert_int_equal(count_in_file(&fake, "calls", "crash"), 2); /* its first launch, twice */
    assert_int_equal(count_in_file(&fake, "calls", "hang"), 1);
    assert_int_equal(count_in_file(&fake, "calls", "good"), 2);
    fake_close(&fake);
}

static void run_takes_missing_support_as_a_result(void **state)
{
    (void)state;
    static const char *const ids[] = { "unsupported", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 3);
    const fm_run_result result = run_well(&fake);
    assert_int_equal(result.not_supported, 1);
    assert_int_equal(count_in_file(&fake, "calls", "unsupported"), 1);
    assert_in_file(&fake, "out/summary.csv", "not_supported,no interlock,unsupported");
    assert_in_file(&fake, "out/summary.csv", ",feature,");
    fake_close(&fake);
}

/* Whoever counts refusals by their reason misses none. */
static void run_takes_no_refusal_without_a_reason(void **state)
{
    (void)state;
    static const char *const ids[] = { "unreasoned", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 1);
    const fm_run_result result = run_well(&fake);
    assert_int_equal(result.not_supported, 0);
    assert_int_equal(result.failed, 1);
    assert_in_file(&fake, "out/summary.csv",
                   "'status' is 'not_supported' without a 'reason': no interlock");
    fake_close(&fake);
}

/* Programs before that column wrote such journals. */
static void run_goes_on_with_a_journal_without_reasons(void **state)
{
    (void)state;
    static const char *const ids[] = { "unsupported", NULL };
    static const char field[] = "\"reason\":\"feature\",";
    fake_plan fake;
    open_with_worker(&fake, ids, 1);
    run_well(&fake);
    char *journal = fake_read(&fake, "out/journal.jsonl"), *at = strstr(journal, field);
    assert_non_null(at);
    memmove(at, at + strlen(field), strlen(at + strlen(field)) + 1);
    fake_write(&fake, "out/journal.jsonl", journal, "w");
    free(journal);
    assert_int_equal(run_well(&fake).not_supported, 1);
    assert_int_equal(count_in_file(&fake, "calls", "unsupported"), 1);
    assert_in_file(&fake, "out/summary.csv", "not_supported,no interlock,unsupported");
    assert_int_equal(count_in_file(&fake, "out/summary.csv", ",feature,"), 0);
    fake_close(&fake);
}

static void run_fails_the_cases_of_a_truth_for_its_reason(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "b", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 1);
    fake_write(&fake, "deep-truth", "", "w");
    assert_int_equal(run_well(&fake).not_supported, 2);
    assert_int_equal(count_in_file(&fake, "out/summary.csv", "not_supported,no truth: too deep"),
                     2);
    assert_int_equal(count_in_file(&fake, "out/summary.csv", ",suite-limit,"), 2);
    fake_close(&fake);
}

static void run_fails_the_cases_of_a_truth_that_failed(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "b", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 1);
    fake_write(&fake, "no-truth", "", "w");
    const fm_run_result result = run_well(&fake);
    assert_int_equal(result.failed, 2);
    assert_int_equal(
        count_in_file(&fake, "out/summary.csv", "out_of_memory,no truth: too many fragments"), 2);
    assert_int_equal(count_in_file(&fake, "calls", "a 0"), 0);
    fake_close(&fake);
}

static void run_finds_an_exact_method_that_draws_differently(void **state)
{
    (void)state;
    static const char *const ids[] = { "unlike", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 2);
    fm_run_result result = run_well(&fake);
    assert_int_equal(result.failed, 1);
    assert_in_file(&fake, "out/summary.csv",
                   "wrong_image,launch 1: drew another image than the checked launch 0");
    fake_close(&fake);
    open_with_worker(&fake, ids, 2);
    fake.methods[0].traits = FM_TRAIT_RACY;
    result = run_well(&fake);
    assert_int_equal(result.ok, 1);
    fake_close(&fake);
}

static void run_repeats_nothing_that_is_finished(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "b", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 2);
    run_well(&fake);
    char *first = fake_read(&fake, "out/summary.csv"),
         *samples = fake_read(&fake, "out/samples.csv");
    char *calls = fake_read(&fake, "calls");
    run_well(&fake);
    assert_in_file(&fake, "out/summary.csv", first);
    assert_in_file(&fake, "out/samples.csv", samples);
    char *calls_again = fake_read(&fake, "calls");
    assert_string_equal(calls, calls_again);
    free(first);
    free(samples);
    free(calls);
    free(calls_again);
    fake_close(&fake);
}

/* Rows of an earlier run that are not wanted any more, and no others. */
static void run_measures_anew_what_is_to_be_retried(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "crash", "silent", "unlike", NULL };
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    char directory[96], image[160], kept[160];
    open_with_worker(&fake, ids, 2);
    assert_int_equal(run_well(&fake).failed, 3);
    const size_t samples = count_in_file(&fake, "out/samples.csv", ",frame_ms,");
    fake_write(&fake, "room", "", "w");
    assert_int_equal(run_well(&fake).failed, 3); /* what is measured stays */
    snprintf(directory, sizeof directory, "%s/out", fake.folder);
    snprintf(image, sizeof image, "%s/images/%s.rgba32f", directory, fake.cases[3].id);
    assert_int_equal(text_write_file(image, "old", 3, NULL), FM_OK);
    snprintf(kept, sizeof kept, "%s/kept", directory);
    assert_int_equal(mkdir(kept, 0777), 0);
    snprintf(kept, sizeof kept, "%s/kept/%s.fragments", directory, fake.cases[3].id);
    assert_int_equal(text_write_file(kept, "old", 3, NULL), FM_OK);
    const fm_run_desc desc = { .directory = directory,
                               .timeout_s = 20,
                               .retried = 1u << FM_CASE_CRASH | 1u << FM_CASE_WRONG_IMAGE,
                               .worker = fake.worker };
    assert_int_equal(run_cases(&result, &fake.plan, &fake.list, &desc, &err), FM_OK);
    assert_int_equal(result.forgotten, 3);
    assert_int_equal(result.ok, 2); /* a, silent */
    assert_int_not_equal(access(image, F_OK), 0);
    assert_int_not_equal(access(kept, F_OK), 0);
    assert_int_equal(count_in_file(&fake, "calls", "a "), 2);
    assert_int_equal(count_in_file(&fake, "calls", "unlike "), 4);
    assert_int_equal(count_in_file(&fake, "out/samples.csv", ",frame_ms,"), samples + 4);
    assert_int_equal(run_well(&fake).ok, 2); /* and so it is read again */
    assert_int_equal(count_in_file(&fake, "out/samples.csv", ",frame_ms,"), samples + 4);
    fake_close(&fake);
}

/* The journal has no room for the line: what it still has of the case keeps its image. */
static void run_that_cannot_forget_removes_nothing(void **state)
{
    (void)state;
    static const char *const ids[] = { "unlike", NULL };
    fake_plan fake;
    fm_run_result result;
    struct rlimit before;
    char directory[96], image[160];
    open_with_worker(&fake, ids, 2);
    assert_int_equal(run_well(&fake).failed, 1);
    snprintf(directory, sizeof directory, "%s/out", fake.folder);
    snprintf(image, sizeof image, "%s/images/%s.rgba32f", directory, fake.cases[0].id);
    assert_int_equal(text_write_file(image, "old", 3, NULL), FM_OK);
    const fm_run_desc desc = { .directory = directory,
                               .retried = 1u << FM_CASE_WRONG_IMAGE,
                               .worker = fake.worker };
    char *journal = fake_read(&fake, "out/journal.jsonl");
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    const struct rlimit limit = { .rlim_cur = strlen(journal), .rlim_max = before.rlim_max };
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    const fm_status status = run_cases(&result, &fake.plan, &fake.list, &desc, NULL);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_int_equal(status, FM_IO);
    assert_int_equal(result.forgotten, 0);
    assert_int_equal(access(image, F_OK), 0);
    free(journal);
    fake_close(&fake);
}

static void run_refuses_a_folder_of_another_plan(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    fake_plan fake;
    fm_run_result result;
    char reason[] = "no hook 'after'";
    fm_error err = { 0 };
    open_with_worker(&fake, ids, 1);
    run_well(&fake);
    fake.plan.seed = 2;
    assert_int_equal(run_in(&result, &fake, 5, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "another plan"));
    assert_null(strstr(err.message, "refused"));
    fake.cases[0].skip = reason;
    fake.cases[0].skip_status = FM_CASE_PLUGIN_ERROR;
    assert_int_equal(run_in(&result, &fake, 5, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "another plan"));
    assert_non_null(strstr(err.message, "method a is refused now: no hook 'after'"));
    fake_close(&fake);
}

static void run_refuses_results_without_a_journal(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    open_with_worker(&fake, ids, 1);
    run_well(&fake);
    char path[128];
    snprintf(path, sizeof path, "%s/out/journal.jsonl", fake.folder);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(run_in(&result, &fake, 5, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "no journal"));
    fake_close(&fake);
}

static void run_needs_a_floor_and_a_worker(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    fake_open(&fake, ids, 1); /* no worker.sh is written */
    assert_int_equal(run_in(&result, &fake, 5, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "worker.sh"));
    fake.list.count = 1;
    assert_int_equal(run_in(&result, &fake, 5, &err), FM_INVALID);
    fake_close(&fake);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(run_measures_each_case_in_each_round),
        cmocka_unit_test(run_tells_a_mesh_once),
        cmocka_unit_test(run_names_the_mesh_of_a_crash),
        cmocka_unit_test(run_writes_a_command_that_is_not_utf8),
        cmocka_unit_test(run_interleaves_the_cases),
        cmocka_unit_test(run_records_every_way_a_worker_can_fail),
        cmocka_unit_test(run_takes_missing_support_as_a_result),
        cmocka_unit_test(run_takes_no_refusal_without_a_reason),
        cmocka_unit_test(run_goes_on_with_a_journal_without_reasons),
        cmocka_unit_test(run_fails_the_cases_of_a_truth_for_its_reason),
        cmocka_unit_test(run_fails_the_cases_of_a_truth_that_failed),
        cmocka_unit_test(run_finds_an_exact_method_that_draws_differently),
        cmocka_unit_test(run_repeats_nothing_that_is_finished),
        cmocka_unit_test(run_measures_anew_what_is_to_be_retried),
        cmocka_unit_test(run_that_cannot_forget_removes_nothing),
        cmocka_unit_test(run_refuses_a_folder_of_another_plan),
        cmocka_unit_test(run_refuses_results_without_a_journal),
        cmocka_unit_test(run_needs_a_floor_and_a_worker),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
