#include "run.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/random.h"
#include "machine.h"
#include "manifest.h"
#include "results/noise.h"
#include "run_internal.h"
#include "run_open.h"

static bool should_stop(run_state *run)
{
    if (run->stop_signal == 0)
        run->stop_signal = stop_signals_next(&run->signals, 0.0);
    return run->stop_signal != 0;
}

/* The same order for a round whatever was already done: it depends on the seed alone. */
static void shuffle(run_state *run, uint32_t round)
{
    uint64_t seed = run->plan->seed, state;
    for (uint32_t i = 0; i <= round; i++)
        state = random_next(&seed);
    for (uint32_t i = 0; i < run->plan->count; i++)
        run->order[i] = i;
    for (uint32_t i = (uint32_t)run->plan->count; i > 1; i--) {
        const uint32_t j = random_below(&state, i), kept = run->order[i - 1];
        run->order[i - 1] = run->order[j];
        run->order[j] = kept;
    }
}

static fm_status run_round(run_state *run, uint32_t launch, fm_error *err)
{
    fm_status status = FM_OK;
    shuffle(run, launch);
    status = run_look(run, launch, err);
    for (size_t i = 0; i < run->plan->count && status == FM_OK && !should_stop(run); i++) {
        const size_t index = run->order[i];
        if (launch >= run->results->cases[index].wanted)
            continue;
        if (run_is_pending(run, index) && !run->results->cases[index].launches[launch].is_done)
            status = run_measure(run, index, launch, err);
        else if (run->plan->cases[index].skip == NULL &&
                 !run->results->cases[index].launches[launch].is_done)
            run->progress.done++; /* its case failed before */
    }
    return status;
}

static bool truth_is_wanted(const run_state *run, size_t job)
{
    size_t i = run->truths.jobs[job].of;
    while (i != FM_NO_CASE && !run_is_pending(run, i))
        i = run->truths.next_of_same[i];
    return i != FM_NO_CASE;
}

static void count_launches(run_state *run)
{
    for (size_t i = 0; i < run->truths.count; i++)
        run->progress.total += truth_is_wanted(run, i);
    for (size_t i = 0; i < run->plan->count; i++) {
        if (run->plan->cases[i].skip != NULL)
            continue;
        run->progress.total += run->results->cases[i].wanted;
        run->progress.done += run->results->cases[i].done;
    }
}

static fm_status run_launches(run_state *run, fm_error *err)
{
    fm_status status = FM_OK;
    count_launches(run);
    for (size_t i = 0; i < run->truths.count && status == FM_OK && !should_stop(run); i++)
        if (truth_is_wanted(run, i))
            status = run_capture_truth(run, i, err);
    for (uint32_t i = 0; i < run->plan->launches && status == FM_OK && !should_stop(run); i++)
        status = run_round(run, i, err);
    progress_close(&run->progress);
    return status;
}

static void count_outcomes(fm_run_result *result, const run_state *run)
{
    for (size_t i = 0; i < run->plan->count; i++) {
        if (run_is_pending(run, i))
            result->skipped++;
        else if (run->results->cases[i].status == FM_CASE_OK)
            result->ok++;
        else if (run->results->cases[i].status == FM_CASE_NOT_SUPPORTED)
            result->not_supported++;
        else
            result->failed++;
    }
    result->stop_signal = run->stop_signal;
    result->is_counted = true;
}

/* How far the machine let the run measure in peace. */
static fm_status sum_noise(fm_run_result *result, const run_state *run, fm_error *err)
{
    fm_noise_host host;
    fm_status status = noise_of_host(&host, run->results, err);
    for (size_t i = 0; i < run->plan->count && status == FM_OK; i++) {
        fm_text reasons = { 0 };
        summary_noise(&reasons, run->results, i);
        if (reasons.failed)
            status = fm_fail(err, FM_NO_MEMORY, "no memory for what is noisy");
        result->noisy += reasons.length > 0;
        text_free(&reasons);
    }
    result->waited_share = host.waited_share;
    result->load = host.load;
    return status;
}

static fm_status write_manifest(const run_state *run, bool is_ended, fm_error *err)
{
    const fm_manifest_desc desc = {
        .run = run->desc,
        .results = run->results,
        .started = journal_started(run->journal),
        .is_ended = is_ended,
    };
    return manifest_write(&desc, err);
}

/* Who edits a method and repeats a command would take old results for new ones. */
static void tell_continued(run_state *run)
{
    char anew[64];
    if (journal_is_continued(run->journal))
        progress_tell(
            &run->progress, run->desc->directory,
            "goes on with what an earlier run left; what it finished is not measured again "
            "(remove the folder, or name another, to measure anew)");
    snprintf(anew, sizeof anew, "rows that are measured anew: %u", run->forgotten);
    if (run->forgotten > 0)
        progress_tell_always(&run->progress, run->desc->directory, anew);
}

/* Anew each time: the same plan may be for other figures now. */
static fm_status write_figure_cases(const run_state *run, fm_error *err)
{
    const fm_text *csv = run->desc->figure_cases;
    char path[FM_PATH_MAX_BYTES];
    if (csv == NULL)
        return FM_OK;
    const fm_status status = run_path(path, run, "figures.csv", "", "", err);
    return status == FM_OK ? text_write_file(path, csv->bytes, csv->length, err) : status;
}

/* Which shard each case of the whole plan is in, for whoever merges them. */
static fm_status write_shard(const run_state *run, fm_error *err)
{
    const fm_text *csv = &run->plan->shard.table;
    char path[FM_PATH_MAX_BYTES];
    if (run->plan->shard.count == 0)
        return FM_OK;
    const fm_status status = run_path(path, run, FM_SHARD_TABLE, "", "", err);
    return status == FM_OK ? text_write_file(path, csv->bytes, csv->length, err) : status;
}

/* Limits that cannot be read are told, and cost columns that follow from them, but no run. */
static void take_limits(run_state *run)
{
    char path[FM_PATH_MAX_BYTES];
    fm_error fault = { 0 };
    fm_machine machine;
    machine_describe(&machine);
    if (limits_path(path, &fault) != FM_OK)
        return; /* nowhere to remember */
    if (limits_read(&run->limits, path, &fault) != FM_OK)
        progress_tell_always(&run->progress, run->desc->directory, fault.message);
    run->results->limits = &run->limits;
    run->results->host.cores = machine.cores;
    snprintf(run->results->host.cpu, sizeof run->results->host.cpu, "%s", machine.cpu);
}

static fm_status prepare(run_state *run, fm_error *err)
{
    fm_status status = truth_jobs_create(&run->truths, run->plan, run->plugins, err);
    if (status == FM_OK && !plan_index_ids(&run->ids, run->plan))
        status = fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", run->plan->count);
    if (status == FM_OK)
        status = run_make_folders(run, err);
    if (status == FM_OK)
        status = run_resume(run, err);
    run->is_resumed = status == FM_OK;
    if (status == FM_OK)
        take_limits(run);
    if (status == FM_OK)
        status = write_figure_cases(run, err);
    if (status == FM_OK)
        status = write_shard(run, err);
    if (status == FM_OK)
        status = write_manifest(run, false, err);
    if (status == FM_OK)
        status = results_write_summary(run->results, err);
    if (status == FM_OK)
        tell_continued(run);
    if (status == FM_OK)
        run_tell_unkept(run);
    return status;
}

fm_status run_open(fm_open_run **opened, const fm_plan *plan, const fm_plugin_list *plugins,
                   const fm_run_desc *desc, fm_error *err)
{
    assert(plan->launches > 0 && plan->count < UINT32_MAX);
    run_state *run = calloc(1, sizeof *run);
    *opened = run;
    if (run == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for a run");
    *run = (run_state){ .plan = plan, .plugins = plugins, .desc = desc };
    run->progress.out = desc->progress;
    run->progress.always = desc->talk;
    run->progress.is_terminal = desc->progress != NULL && isatty(fileno(desc->progress));
    run->order = calloc(plan->count > 0 ? plan->count : 1, sizeof *run->order);
    if (run->order == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", plan->count);
    fm_status status = stop_signals_open(&run->signals, err);
    run->hears_signals = status == FM_OK;
    if (status == FM_OK)
        status = prepare(run, err);
    return status;
}

fm_status run_launch(fm_open_run *run, size_t case_index, uint32_t launch, fm_error *err)
{
    const size_t job = run->truths.of_case[case_index];
    if (should_stop(run) || !run_is_pending(run, case_index) ||
        run->results->cases[case_index].launches[launch].is_done)
        return FM_OK;
    if (run->truths.jobs[job].is_captured)
        return run_measure(run, case_index, launch, err);
    const fm_status status = run_capture_truth(run, job, err);
    run->truths.jobs[job].is_captured = status == FM_OK && run->stop_signal == 0;
    return status == FM_OK && run->stop_signal == 0 && run_is_pending(run, case_index)
               ? run_measure(run, case_index, launch, err)
               : status;
}

const fm_results *run_results(const fm_open_run *run)
{
    return run->results;
}

int run_stop_signal(fm_open_run *run)
{
    return should_stop(run) ? run->stop_signal : 0;
}

void run_stop(fm_open_run *run, int signal)
{
    if (run->stop_signal == 0)
        run->stop_signal = signal;
}

void run_settle(fm_open_run *run)
{
    for (size_t i = 0; i < run->plan->count; i++)
        run->results->cases[i].is_enough = run->results->cases[i].done > 0;
}

/* Once for each run: a device whose rows have a time, and no bound. */
static void tell_unbound(run_state *run)
{
    char sentence[512];
    for (size_t i = 0; i < run->plan->count; i++) {
        if (!summary_lacks_limits(run->results, i))
            continue;
        snprintf(sentence, sizeof sentence,
                 "times_bound is empty: %s was not calibrated here (`fragmark calibrate device "
                 "--device %s`)",
                 run->results->cases[i].device_name, run->plan->cases[i].device);
        progress_tell(&run->progress, run->desc->directory, sentence);
        return;
    }
}

/* What a run that went well writes at its end. */
static fm_status write_end(fm_run_result *result, run_state *run, fm_error *err)
{
    tell_unbound(run);
    fm_status status = results_end(run->results, err);
    if (status == FM_OK)
        status = sum_noise(result, run, err);
    if (status == FM_OK)
        status = write_manifest(run, run->stop_signal == 0, err);
    if (status == FM_OK && run->stop_signal == 0)
        run_remove_truths(run);
    return status;
}

static void free_run(run_state *run)
{
    journal_close(run->journal);
    results_destroy(run->results);
    limits_free(&run->limits);
    codes_free(&run->codes);
    json_decref(run->drivers);
    truth_jobs_free(&run->truths);
    run_looks_free(&run->looks);
    text_index_free(&run->ids);
    free(run->order);
    free(run);
}

fm_status run_close(fm_run_result *result, fm_open_run *run, fm_status status, fm_error *err)
{
    *result = (fm_run_result){ 0 };
    if (run == NULL)
        return status;
    if (status != FM_OK && run->is_resumed)
        results_end(run->results, NULL); /* what had no turn has its row; nobody asks how it went */
    else if (status != FM_OK)
        run_remove_folders(run);
    if (run->hears_signals)
        stop_signals_close(&run->signals);
    if (status == FM_OK)
        status = write_end(result, run, err);
    if (run->is_resumed)
        count_outcomes(result, run);
    result->is_damaged = run->is_damaged;
    result->forgotten = run->forgotten;
    result->is_other_code = run->is_other_code;
    free_run(run);
    return status;
}

fm_status run_cases(fm_run_result *result, const fm_plan *plan, const fm_plugin_list *plugins,
                    const fm_run_desc *desc, fm_error *err)
{
    fm_open_run *run;
    fm_status status = run_open(&run, plan, plugins, desc, err);
    if (status == FM_OK)
        status = run_launches(run, err);
    return run_close(result, run, status, err);
}
