#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/clock.h"
#include "run_internal.h"
#include "worker/protocol.h"

bool run_is_pending(const run_state *run, size_t case_index)
{
    return run->plan->cases[case_index].skip == NULL &&
           !results_is_finished(run->results, case_index);
}

/* Writes the end of a launch, whose code fits, into journal, tables and, if it was the case's last,
 * the summary. */
static fm_status end_launch(run_state *run, size_t case_index, uint32_t launch, json_t *result,
                            fm_error *err)
{
    const char *id = run->plan->cases[case_index].id;
    fm_status status = journal_write(run->journal, FM_JOURNAL_END, id, launch, result, err);
    if (status == FM_OK)
        status = results_add(run->results, case_index, launch, result, err);
    if (status == FM_OK && results_is_finished(run->results, case_index))
        status = results_write_summary_if_due(run->results, clock_s(), err);
    return status;
}

/* All cases of a truth that cannot be had end as it did. */
static fm_status fail_truth(run_state *run, size_t job, const json_t *result, fm_error *err)
{
    fm_status status = FM_OK;
    char message[2048];
    snprintf(message, sizeof message, "no truth: %.2000s", answer_message(result));
    for (size_t i = run->truths.jobs[job].of; i != FM_NO_CASE && status == FM_OK;
         i = run->truths.next_of_same[i]) {
        if (!run_is_pending(run, i))
            continue;
        uint32_t launch = 0;
        while (run->results->cases[i].launches[launch].is_done)
            launch++;
        json_t *verdict = answer_make(answer_status(result), answer_reason(result), message);
        status = run_fit_code(run, i, verdict, err);
        if (status == FM_OK)
            status = end_launch(run, i, launch, verdict, err);
        json_decref(verdict);
    }
    return status;
}

/* The run's own files failed: the launch stays unfinished, nobody gets a verdict, and the run
 * stops, to be continued when the fault is gone. */
static fm_status fail_run(const json_t *answer, const char *current, fm_error *err)
{
    return fm_fail(err, FM_IO, "%s: %s; the launch is not finished, and the same command continues",
                   current, answer_message(answer));
}

/* A launch that dies, or has no memory, under a limit on memory that the run was given (not by
 * --memory-limit, which asks for such rows): nobody can tell that the limit is not to blame. */
static bool is_of_given_limit(const run_state *run, json_t *answer)
{
    struct rlimit limit;
    const fm_case_status status = answer_status(answer);
    if ((status != FM_CASE_CRASH && status != FM_CASE_OUT_OF_MEMORY) ||
        run->desc->memory_bytes != 0 || getrlimit(RLIMIT_AS, &limit) != 0 ||
        limit.rlim_cur == RLIM_INFINITY)
        return false;
    answer_add_note(answer, "the run was given a limit on memory (ulimit -v)");
    return true;
}

fm_status run_capture_truth(run_state *run, size_t job, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], name[sizeof run->truths.jobs[job].name + 8], current[160];
    const fm_case *planned = &run->plan->cases[run->truths.jobs[job].of];
    bool is_there = false;
    fm_launch_outcome outcome;
    fm_status status = run_path(path, run, "truth", run->truths.jobs[job].name, ".truth", err);
    if (status == FM_OK)
        status = run_find_truth(&is_there, run, job, path, err);
    if (status != FM_OK || run->stop_signal != 0)
        return status;
    snprintf(name, sizeof name, "truth-%s", run->truths.jobs[job].name);
    snprintf(current, sizeof current, "truth of %.60s on %.60s", planned->scene, planned->device);
    progress_begin(&run->progress, current);
    if (is_there) { /* an interrupted run's: written whole or not at all */
        progress_skip(&run->progress);
        return FM_OK;
    }
    fm_request request = run_request_for(run, planned, job, path);
    request.is_truth_job = true;
    const run_attempt attempt = {
        .name = name, .current = current, .request = &request, .case_index = RUN_NO_CASE
    };
    char *death = NULL;
    status = run_attempt_launch(&outcome, run, &attempt, &death, err);
    free(death);
    if (status != FM_OK || outcome.kind == FM_LAUNCH_INTERRUPTED)
        return status;
    if (answer_is_runs_fault(outcome.result) || is_of_given_limit(run, outcome.result))
        status = fail_run(outcome.result, current, err);
    else if (answer_status(outcome.result) != FM_CASE_OK)
        status = fail_truth(run, job, outcome.result, err);
    else
        status = run_keep_truth_code(run, path, outcome.result, err);
    progress_end(&run->progress, outcome.seconds);
    json_decref(outcome.result);
    return status;
}

/* What a launch left goes into images/ before it is told that it ended: a run that is killed
 * between the two measures it again. Of other code it is not the row's, and is to be done again. */
static fm_status end_measure(run_state *run, size_t case_index, uint32_t launch, json_t *answer,
                             bool is_unfinished, fm_error *err)
{
    const char *id = run->plan->cases[case_index].id;
    fm_status status = is_unfinished ? FM_OK : run_fit_code(run, case_index, answer, err);
    const bool is_kept = status == FM_OK && !is_unfinished;
    const bool is_counted = is_kept && case_status_continues(answer_status(answer));
    const fm_status taken =
        run_take_range(run, case_index, launch, is_counted, status == FM_OK ? err : NULL);
    if (status == FM_OK)
        status = taken;
    if (status == FM_OK && is_kept)
        return end_launch(run, case_index, launch, answer, err);
    const fm_status stopped = journal_write(run->journal, FM_JOURNAL_STOP, id, launch, NULL,
                                            status == FM_OK ? err : NULL);
    return status == FM_OK ? stopped : status;
}

fm_status run_measure(run_state *run, size_t case_index, uint32_t launch, fm_error *err)
{
    const fm_case *planned = &run->plan->cases[case_index];
    char truth[FM_PATH_MAX_BYTES], image[FM_PATH_MAX_BYTES] = "", range[FM_PATH_MAX_BYTES] = "",
                                   k[FM_PATH_MAX_BYTES], current[160],
                                   kept[KEPT_KIND_COUNT][FM_PATH_MAX_BYTES];
    const size_t job = run->truths.of_case[case_index];
    fm_launch_outcome outcome;
    fm_status status = run_path(truth, run, "truth", run->truths.jobs[job].name, ".truth", err);
    if (status == FM_OK && launch == 0 && !run->desc->no_images && !planned->no_image)
        status = run_path(image, run, "images", planned->id, ".rgba32f", err);
    if (status == FM_OK)
        status = run_range_path(range, run, case_index, err);
    for (int kind = 0; kind < KEPT_KIND_COUNT && status == FM_OK; kind++)
        status = run_kept_path(kept[kind], run, case_index, (kept_kind)kind, err);
    if (status == FM_OK)
        status = journal_write(run->journal, FM_JOURNAL_BEGIN, planned->id, launch, NULL, err);
    if (status != FM_OK)
        return status;
    settings_text(k, &planned->settings, key_find("k"));
    const bool has_k = planned->settings.k != 0;
    snprintf(current, sizeof current, "%.32s%s%.8s %.30s %.30s %.20s, launch %u", planned->method,
             has_k ? " k=" : "", has_k ? k : "", planned->scene, planned->device, planned->feed,
             launch);
    progress_begin(&run->progress, current);
    fm_request request = run_request_for(run, planned, job, truth);
    request.image = image;
    request.range = range;
    request.known_images = run->results->cases[case_index].images;
    request.known_count = run->results->cases[case_index].image_count;
    request.check = launch == 0;
    request.launch = launch;
    for (int kind = 0; kind < KEPT_KIND_COUNT; kind++)
        request.keep[kind] = launch == 0 ? kept[kind] : "";
    const run_attempt attempt = { .name = planned->id,
                                  .current = current,
                                  .request = &request,
                                  .case_index = case_index,
                                  .launch = launch };
    char **death = &run->results->cases[case_index].launches[launch].death;
    status = run_attempt_launch(&outcome, run, &attempt, death, err);
    if (status != FM_OK) { /* whoever reads the journal is told that it did not finish */
        run_take_range(run, case_index, launch, false, NULL);
        journal_write(run->journal, FM_JOURNAL_STOP, planned->id, launch, NULL, NULL);
        return status;
    }
    const bool is_interrupted = outcome.kind == FM_LAUNCH_INTERRUPTED;
    const bool is_unfinished = is_interrupted || answer_is_runs_fault(outcome.result) ||
                               is_of_given_limit(run, outcome.result);
    status = end_measure(run, case_index, launch, outcome.result, is_unfinished, err);
    if (is_interrupted)
        return status;
    if (status == FM_OK && is_unfinished) {
        status = fail_run(outcome.result, current, err);
        if (answer_is_truth_unusable(outcome.result))
            unlink(truth); /* whoever continues the run captures it anew */
    }
    progress_end(&run->progress, outcome.seconds);
    json_decref(outcome.result);
    return status;
}
