#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "run_internal.h"
#include "worker/protocol.h"

enum { TIMEOUT_DEFAULT_S = 600 };

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
static fm_status ask(fm_launch_outcome *outcome, run_state *run, const run_attempt *attempt,
                     fm_error *err)
{
    char request_path[FM_PATH_MAX_BYTES], result_path[FM_PATH_MAX_BYTES],
        log_path[FM_PATH_MAX_BYTES];
    const char *const name = attempt->name;
    const fm_request *const request = attempt->request;
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
        .frames = run_frames(run, request->settings),
        .timeout_s = run->desc->timeout_s != 0 ? run->desc->timeout_s : TIMEOUT_DEFAULT_S,
        .memory_bytes = run->desc->memory_bytes,
        .input = settings_file(request->settings),
        .tick = tick,
        .context = &run->progress,
    };
    status = launch_worker(outcome, &run->signals, &desc, err);
    if (status != FM_OK)
        return status;
    run->stop_signal = outcome->stop_signal;
    if (outcome->result != NULL)
        tell_mesh(run, outcome->result);
    if (outcome->result == NULL || answer_status(outcome->result) <= FM_CASE_WRONG_IMAGE) {
        unlink(request_path);
        unlink(result_path);
    }
    return FM_OK;
}

/* The first death: kept, and written down for whoever continues the run. */
static fm_status note_death(run_state *run, const run_attempt *attempt, char **death,
                            json_t *result, fm_error *err)
{
    *death = strdup(answer_message(result));
    if (*death == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for how a worker died");
    char why[512];
    snprintf(why, sizeof why, "is tried again: %.480s", *death);
    progress_tell(&run->progress, attempt->current, why);
    if (attempt->case_index == RUN_NO_CASE)
        return FM_OK;
    json_t *told = answer_make(answer_status(result), answer_reason(result), *death);
    if (told != NULL) /* other code is not to answer for it */
        run_guess_code(run, attempt->case_index, told);
    const fm_status status =
        journal_write(run->journal, FM_JOURNAL_DIED, run->plan->cases[attempt->case_index].id,
                      attempt->launch, told, err);
    json_decref(told);
    return status;
}

/* A verdict on a second death, or whatever else comes of a second try, tells of the first. */
static void tell_of_both(json_t *result, const char *death, bool has_died)
{
    char note[1024];
    if (death == NULL)
        return;
    if (has_died && strcmp(death, answer_message(result)) == 0)
        snprintf(note, sizeof note, "and so the first time");
    else
        snprintf(note, sizeof note, "the first time: %.900s", death);
    answer_add_note(result, note);
}

static fm_status fail_killed(const run_attempt *attempt, const json_t *result, fm_error *err)
{
    return fm_fail(err, FM_IO,
                   "%s: %.300s, twice, and not by this run; the launch is not finished, and the "
                   "same command continues",
                   attempt->current, answer_message(result));
}

/* One try. *is_last: nothing else is to be tried, whatever it returns. */
static fm_status try_once(bool *is_last, fm_launch_outcome *outcome, run_state *run,
                          const run_attempt *attempt, char **death, fm_error *err)
{
    fm_status status = ask(outcome, run, attempt, err);
    *is_last = true;
    if (status != FM_OK || outcome->kind == FM_LAUNCH_INTERRUPTED ||
        outcome->kind == FM_LAUNCH_KILLED || answer_is_runs_fault(outcome->result))
        return status;
    const bool has_died = outcome->kind == FM_LAUNCH_DIED || answer_is_starved(outcome->result);
    *is_last = !has_died || *death != NULL;
    if (*is_last)
        tell_of_both(outcome->result, *death, has_died);
    else
        status = note_death(run, attempt, death, outcome->result, err);
    return status;
}

fm_status run_attempt_launch(fm_launch_outcome *outcome, run_state *run, const run_attempt *attempt,
                             char **death, fm_error *err)
{
    bool is_last = false, was_killed = false;
    double seconds = 0.0;
    fm_status status = FM_OK;
    while (status == FM_OK && !is_last) {
        status = try_once(&is_last, outcome, run, attempt, death, err);
        seconds += outcome->seconds;
        if (status == FM_OK && outcome->kind == FM_LAUNCH_KILLED) {
            if (was_killed)
                status = fail_killed(attempt, outcome->result, err);
            was_killed = true;
            is_last = false;
        }
        if (status != FM_OK || !is_last) {
            json_decref(outcome->result);
            outcome->result = NULL;
        }
    }
    outcome->seconds = seconds;
    return status;
}
