/* The parent, with a shell script in a worker's place. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "fake_plan.h"
#include "parent/run.h"

/* $2 is the request, $3 the result. Each launch leaves a line in calls; a truth job its file. What
 * a method does is told by its name. */
static const char worker_script[] =
    "#!/bin/sh\n"
    "here=$(dirname \"$0\")\n"
    "good='{\"status\":\"ok\",\"message\":\"\",\"image_hashes\":[\"00000000000000aa\"],'\n"
    "good=$good'\"device_name\":\"fake\",\"metrics\":{\"rmse\":0.0,\"n\":4,\"tied_pixels\":0},"
    "\"samples\":['\n"
    "good=$good'{\"frame\":0,\"metric\":\"frame_ms\",\"value\":2.0,\"unit\":\"ms\"},'\n"
    "good=$good'{\"frame\":1,\"metric\":\"frame_ms\",\"value\":4.0,\"unit\":\"ms\"}]}'\n"
    "method=$(sed -n 's,.*\"plugin\": \"/fake/\\(.*\\).so\".*,\\1,p' \"$2\")\n"
    "launch=$(sed -n 's,.*\"launch\": \\([0-9]*\\).*,\\1,p' \"$2\")\n"
    "mesh=$(sed -n 's,.*\"mesh\": \"\\(.*\\)\".*,\\1,p' \"$2\")\n"
    "[ -z \"$mesh\" ] || good=$(echo \"$good\" |\n"
    "    sed 's|{|{\"mesh\":{\"file\":\"'\"$mesh\"'\",\"told\":\"a cube\"},|')\n"
    "if grep -q '\"job\": \"truth\"' \"$2\"; then\n"
    "    echo truth >>\"$here/calls\"\n"
    "    if [ -e \"$here/no-truth\" ]; then\n"
    "        echo '{\"status\":\"out_of_memory\",\"message\":\"too many fragments\"}' >\"$3\"\n"
    "        exit 0\n"
    "    fi\n"
    "    touch \"$(sed -n 's,.*\"truth\": \"\\(.*\\)\".*,\\1,p' \"$2\")\"\n"
    "    echo \"$good\" >\"$3\"\n"
    "    exit 0\n"
    "fi\n"
    "echo \"$method $launch\" >>\"$here/calls\"\n"
    "case $method in\n"
    "crash) echo 'last words' >&2; kill -SEGV $$ ;;\n"
    "garbage) echo 'not JSON' >\"$3\" ;;\n"
    "full) [ -e \"$here/room\" ] && echo \"$good\" >\"$3\" && exit 0\n"
    "    mkdir -p \"$3.partial\"; exit 74 ;;\n"
    "hang) sleep 60 ;;\n"
    "liar) exit 74 ;;\n"
    "lost) [ -e \"$here/room\" ] && echo \"$good\" >\"$3\" && exit 0\n"
    "    echo '{\"status\":\"skipped\",\"is_runs_fault\":true,\"message\":\"disk full\"}' >\"$3\" "
    ";;\n"
    "silent) exit 3 ;;\n"
    "status) echo '{\"status\":\"splendid\"}' >\"$3\" ;;\n"
    "stops) [ -e \"$here/stopped\" ] || { touch \"$here/stopped\"; kill -TERM $PPID; sleep 60; }\n"
    "    echo \"$good\" >\"$3\" ;;\n"
    "unlike) [ \"$launch\" = 0 ] || good=$(echo \"$good\" | sed s/aa/bb/)\n"
    "    echo \"$good\" >\"$3\" ;;\n"
    "unsupported) echo '{\"status\":\"not_supported\",\"message\":\"no interlock\"}' >\"$3\" ;;\n"
    "*) echo \"$good\" >\"$3\" ;;\n"
    "esac\n";

static void open_with_worker(fake_plan *fake, const char *const *ids, uint32_t launches)
{
    fake_open(fake, ids, launches);
    fake_write(fake, "worker.sh", worker_script, "w");
    assert_int_equal(chmod(fake->worker, 0755), 0);
}

static fm_status run_in(fm_run_result *result, const fake_plan *fake, uint32_t timeout_s,
                        fm_error *err)
{
    char directory[96];
    snprintf(directory, sizeof directory, "%s/out", fake->folder);
    const fm_run_desc desc = { .directory = directory,
                               .command = "fragmark run -o caf\xE9", /* Latin-1 */
                               .timeout_s = timeout_s,
                               .worker = fake->worker };
    return run_cases(result, &fake->plan, &fake->list, &desc, err);
}

static fm_run_result run_well(const fake_plan *fake)
{
    fm_run_result result;
    fm_error err = { 0 };
    if (run_in(&result, fake, 20, &err) != FM_OK)
        fail_msg("%s", err.message);
    return result;
}

static void assert_in_file(const fake_plan *fake, const char *name, const char *words)
{
    char *text = fake_read(fake, name);
    assert_non_null(text);
    if (strstr(text, words) == NULL)
        fail_msg("'%s' is not in %s:\n%s", words, name, text);
    free(text);
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
    assert_int_equal(run_in(&result, &fake, 1, NULL), FM_OK);
    assert_in_file(&fake, "out/summary.csv",
                   "crash,\"killed by SIGSEGV; its scene reads /fake/bad.3ds; its last words: ");
    assert_in_file(&fake, "out/summary.csv",
                   "timeout,no answer within 1 s; its scene reads /fake/bad.3ds,");
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
                   "crash,\"killed by SIGSEGV; its last words: \"\"last words\"\"\",crash");
    assert_in_file(&fake, "out/summary.csv", "crash,the worker's result cannot be used: ");
    assert_in_file(&fake, "out/summary.csv", "timeout,no answer within 2 s,hang");
    assert_in_file(&fake, "out/summary.csv",
                   "crash,exited with status 3 and left no result,silent");
    assert_in_file(&fake, "out/summary.csv", "'status' is none of the known words");
    assert_int_equal(count_in_file(&fake, "calls", "crash"), 1); /* not launched again */
    assert_int_equal(count_in_file(&fake, "calls", "hang"), 1);
    assert_int_equal(count_in_file(&fake, "calls", "good"), 2);
    fake_close(&fake);
}

/* Stops with FM_IO and no verdict on the case; the same run finishes once there is room. */
static void assert_runs_fault(const char *id, const char *words)
{
    const char *const ids[] = { id, NULL };
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    char path[160], row[32];
    snprintf(row, sizeof row, ",%s,7,", id); /* method and version */
    open_with_worker(&fake, ids, 1);
    for (int times = 0; times < 3; times++) { /* never taken for a launch that kills its run */
        assert_int_equal(run_in(&result, &fake, 5, &err), FM_IO);
        assert_false(result.is_damaged);
        assert_non_null(strstr(err.message, words));
        assert_int_equal(count_in_file(&fake, "out/summary.csv", row), 0);
    }
    snprintf(path, sizeof path, "%s/out/work/%s.result.json.partial", fake.folder,
             fake.plan.cases[0].id);
    rmdir(path);
    fake_write(&fake, "room", "", "w");
    assert_int_equal(run_well(&fake).ok, 1);
    assert_int_equal(count_in_file(&fake, "out/summary.csv", row), 1);
    fake_close(&fake);
}

static void run_blames_nobody_for_what_the_run_cannot_write(void **state)
{
    (void)state;
    assert_runs_fault("lost", "disk full");
    assert_runs_fault("full", "partial");
}

static void run_does_not_believe_a_worker_that_could_have_answered(void **state)
{
    (void)state;
    static const char *const ids[] = { "liar", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 1);
    assert_int_equal(run_well(&fake).failed, 1);
    assert_in_file(&fake, "out/summary.csv", "crash,exited with status 74");
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

static void run_stops_on_sigterm_and_continues(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "stops", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 2);
    fm_run_result result = run_well(&fake);
    assert_int_equal(result.stop_signal, SIGTERM);
    assert_true(result.skipped > 0);
    assert_int_equal(count_in_file(&fake, "out/summary.csv", "\n1,"), 2);
    assert_int_equal(count_in_file(&fake, "out/summary.csv", ",skipped,the run was stopped"), 2);
    assert_in_file(&fake, "out/manifest.json", "\"ended\": null");
    assert_int_equal(count_in_file(&fake, "out/journal.jsonl", "\"stop\""), 1);
    result = run_well(&fake);
    assert_int_equal(result.stop_signal, 0);
    assert_int_equal(result.ok, 2);
    assert_int_equal(count_in_file(&fake, "out/summary.csv", "skipped"), 0);
    assert_int_equal(count_in_file(&fake, "out/samples.csv", "frame_ms"), 8);
    assert_int_equal(count_in_file(&fake, "calls", "a 0"), 1);
    fake_close(&fake);
}

/* A run that was killed leaves a begin without an end. */
static void run_tries_a_launch_twice_and_no_more(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    static const char begin[] =
        "{\"event\":\"begin\",\"case\":\"0000000000000001\",\"launch\":1}\n";
    fake_plan fake;
    open_with_worker(&fake, ids, 2);
    run_well(&fake);
    char *journal = fake_read(&fake, "out/journal.jsonl");
    *strstr(journal, begin) = '\0';
    fake_write(&fake, "out/journal.jsonl", journal, "w");
    fake_write(&fake, "out/journal.jsonl", begin, "a");
    assert_int_equal(run_well(&fake).ok, 1);
    fake_write(&fake, "out/journal.jsonl", journal, "w");
    fake_write(&fake, "out/journal.jsonl", begin, "a");
    fake_write(&fake, "out/journal.jsonl", begin, "a");
    assert_int_equal(run_well(&fake).failed, 1);
    assert_in_file(&fake, "out/summary.csv", "crash,launch 1: began twice and never ended");
    free(journal);
    fake_close(&fake);
}

static void run_refuses_a_folder_of_another_plan(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    open_with_worker(&fake, ids, 1);
    run_well(&fake);
    fake.plan.seed = 2;
    assert_int_equal(run_in(&result, &fake, 5, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "another plan"));
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
        cmocka_unit_test(run_blames_nobody_for_what_the_run_cannot_write),
        cmocka_unit_test(run_does_not_believe_a_worker_that_could_have_answered),
        cmocka_unit_test(run_takes_missing_support_as_a_result),
        cmocka_unit_test(run_fails_the_cases_of_a_truth_that_failed),
        cmocka_unit_test(run_finds_an_exact_method_that_draws_differently),
        cmocka_unit_test(run_repeats_nothing_that_is_finished),
        cmocka_unit_test(run_stops_on_sigterm_and_continues),
        cmocka_unit_test(run_tries_a_launch_twice_and_no_more),
        cmocka_unit_test(run_refuses_a_folder_of_another_plan),
        cmocka_unit_test(run_refuses_results_without_a_journal),
        cmocka_unit_test(run_needs_a_floor_and_a_worker),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
