#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/clock.h"
#include "run_internal.h"
#include "worker/protocol.h"

enum { TIMEOUT_DEFAULT_S = 600 };

bool run_is_pending(const run_state *run, size_t case_index)
{
    return run->plan->cases[case_index].skip == NULL &&
           !results_is_finished(run->results, case_index);
}

fm_status run_end_launch(run_state *run, size_t case_index, uint32_t launch, json_t *result,
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

static void tick(void *context)
{
    progress_tick(context);
}

/* Once a file, whichever worker is the first to read it. */
static void tell_mesh(run_state *run, const json_t *answer)
{
    const json_t *mesh = answer_mesh(answer);
    if (results_take_mesh(run->results, answer))
        progress_tell(&run->progress, answer_mesh_file(mesh), answer_mesh_told(mesh));
}

/* Writes the request, launches, and cleans up after what went well. */
static fm_status ask(fm_launch_outcome *outcome, run_state *run, const char *name,
                     const fm_request *request, fm_error *err)
{
    char request_path[FM_PATH_MAX_BYTES], result_path[FM_PATH_MAX_BYTES],
        log_path[FM_PATH_MAX_BYTES];
    struct stat log;
    *outcome = (fm_launch_outcome){ 0 };
    fm_status status = run_path(request_path, run, "work", name, ".request.json", err);
    if (status == FM_OK)
        status = run_path(result_path, run, "work", name, ".result.json", err);
    if (status == FM_OK)
        status = run_path(log_path, run, "work", name, ".log", err);
    if (status == FM_OK)
        status = request_write(request_path, request, err);
    if (status != FM_OK)
        return status;
    const fm_launch_desc desc = {
        .worker = run->desc->worker,
        .request = request_path,
        .result = result_path,
        .log = log_path,
        .timeout_s = run->desc->timeout_s != 0 ? run->desc->timeout_s : TIMEOUT_DEFAULT_S,
        .memory_bytes = run->desc->memory_bytes,
        .input = settings_file(request->settings),
        .tick = tick,
        .context = &run->progress,
    };
    status = launch_worker(outcome, &run->launcher, &desc, err);
    if (status != FM_OK)
        return status;
    run->stop_signal = outcome->stop_signal;
    if (!outcome->is_interrupted)
        tell_mesh(run, outcome->result);
    if (outcome->is_interrupted || answer_status(outcome->result) <= FM_CASE_WRONG_IMAGE) {
        unlink(request_path);
        unlink(result_path);
    }
    if (stat(log_path, &log) == 0 && log.st_size == 0)
        unlink(log_path);
    return FM_OK;
}

/* All cases of a truth that cannot be had end as it did. */
static fm_status fail_truth(run_state *run, size_t job, const json_t *result, fm_error *err)
{
    fm_status status = FM_OK;
    char message[2048];
    snprintf(message, sizeof message, "no truth: %.2000s", answer_message(result));
    json_t *verdict = answer_make(answer_status(result), message);
    for (size_t i = run->truths.jobs[job].of; i != FM_NO_CASE && status == FM_OK;
         i = run->truths.next_of_same[i]) {
        if (!run_is_pending(run, i))
            continue;
        uint32_t launch = 0;
        while (run->results->cases[i].launches[launch].is_done)
            launch++;
        status = run_end_launch(run, i, launch, verdict, err);
    }
    json_decref(verdict);
    return status;
}

/* The run's own files failed: the launch stays unfinished, nobody gets a verdict, and the run
 * stops, to be continued when the fault is gone. */
static fm_status fail_run(const json_t *answer, const char *current, fm_error *err)
{
    return fm_fail(err, FM_IO, "%s: %s; the launch is not finished, and the same command continues",
                   current, answer_message(answer));
}

static const char *plugin_path(const run_state *run, const fm_case *planned)
{
    const fm_plugin_entry *entry = plugin_list_find(run->plugins, planned->method);
    return entry != NULL && entry->plugin != NULL ? entry->plugin->path : "";
}

/* What a truth job and the launches that are compared with it are asked alike. */
static fm_request request_for(const run_state *run, const fm_case *planned, size_t job,
                              const char *truth)
{
    return (fm_request){ .device = planned->device,
                         .feed = planned->feed,
                         .settings = &planned->settings,
                         .choices = planned->choices,
                         .choice_count = planned->choice_count,
                         .plugin = plugin_path(run, planned),
                         .floor = run->truths.jobs[job].floor,
                         .common = run->plugins->common_folder,
                         .truth = truth,
                         .image = "",
                         .validation = run->desc->validation,
                         .no_timers = run->desc->no_timers };
}

fm_status run_capture_truth(run_state *run, size_t job, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], name[sizeof run->truths.jobs[job].name + 8], current[160];
    const fm_case *planned = &run->plan->cases[run->truths.jobs[job].of];
    fm_launch_outcome outcome;
    fm_status status = run_path(path, run, "truth", run->truths.jobs[job].name, ".truth", err);
    if (status != FM_OK)
        return status;
    snprintf(name, sizeof name, "truth-%s", run->truths.jobs[job].name);
    snprintf(current, sizeof current, "truth of %.60s on %.60s", planned->scene, planned->device);
    progress_begin(&run->progress, current);
    if (access(path, R_OK) == 0) { /* an interrupted run's: written whole or not at all */
        progress_skip(&run->progress);
        return FM_OK;
    }
    fm_request request = request_for(run, planned, job, path);
    request.is_truth_job = true;
    status = ask(&outcome, run, name, &request, err);
    if (status != FM_OK || outcome.is_interrupted)
        return status;
    if (answer_is_runs_fault(outcome.result))
        status = fail_run(outcome.result, current, err);
    else if (answer_status(outcome.result) != FM_CASE_OK)
        status = fail_truth(run, job, outcome.result, err);
    progress_end(&run->progress, outcome.seconds);
    json_decref(outcome.result);
    return status;
}

fm_status run_measure(run_state *run, size_t case_index, uint32_t launch, fm_error *err)
{
    const fm_case *planned = &run->plan->cases[case_index];
    char truth[FM_PATH_MAX_BYTES], image[FM_PATH_MAX_BYTES] = "", k[FM_PATH_MAX_BYTES],
                                   current[160];
    const size_t job = run->truths.of_case[case_index];
    fm_launch_outcome outcome;
    fm_status status = run_path(truth, run, "truth", run->truths.jobs[job].name, ".truth", err);
    if (status == FM_OK && launch == 0 && !run->desc->no_images && !planned->no_image)
        status = run_path(image, run, "images", planned->id, ".rgba32f", err);
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
    fm_request request = request_for(run, planned, job, truth);
    request.image = image;
    request.check = launch == 0;
    request.launch = launch;
    status = ask(&outcome, run, planned->id, &request, err);
    if (status != FM_OK) { /* it did not begin, and is not to be counted as if it had */
        journal_write(run->journal, FM_JOURNAL_STOP, planned->id, launch, NULL, NULL);
        return status;
    }
    const bool is_unfinished = outcome.is_interrupted || answer_is_runs_fault(outcome.result);
    if (is_unfinished)
        status = journal_write(run->journal, FM_JOURNAL_STOP, planned->id, launch, NULL, err);
    else
        status = run_end_launch(run, case_index, launch, outcome.result, err);
    if (outcome.is_interrupted)
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
