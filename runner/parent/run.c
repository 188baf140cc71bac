#include "run.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

#include "base/random.h"
#include "manifest.h"
#include "noise.h"
#include "run_internal.h"
#include "worker/protocol.h"

/* What makes two runs the same run: what they measure, how often, and in which order. */
static void plan_hash(char hash[17], const fm_plan *plan, const fm_run_desc *desc)
{
    XXH3_state_t *state = XXH3_createState();
    const uint64_t numbers[] = { plan->seed,   plan->launches,   plan->frames,
                                 plan->warmup, desc->validation, desc->no_timers };
    hash[0] = '\0';
    if (state == NULL)
        return;
    XXH3_64bits_reset(state);
    XXH3_64bits_update(state, numbers, sizeof numbers);
    for (size_t i = 0; i < plan->count; i++)
        XXH3_64bits_update(state, plan->cases[i].id, strlen(plan->cases[i].id) + 1);
    snprintf(hash, 17, "%016llx", (unsigned long long)XXH3_64bits_digest(state));
    XXH3_freeState(state);
}

static fm_status replay(void *context, fm_journal_event event, const char *case_id, uint32_t launch,
                        const json_t *result, fm_error *err)
{
    run_state *run = context;
    const size_t i = text_index_find(&run->ids, case_id);
    if (i == FM_TEXT_INDEX_NONE || launch >= plan_case_launches(run->plan, i))
        return fm_fail(err, FM_INVALID, "case %.32s, launch %u is not of this plan", case_id,
                       launch);
    fm_launch_state *state = &run->results->cases[i].launches[launch];
    switch (event) {
    case FM_JOURNAL_BEGIN:
        state->begins++;
        return FM_OK;
    case FM_JOURNAL_STOP:
        state->begins = 0;
        return FM_OK;
    case FM_JOURNAL_END:
        results_take_mesh(run->results, result);
        return state->is_done ? fm_fail(err, FM_INVALID, "launch %u ended twice", launch)
                              : results_add(run->results, i, launch, result, err);
    case FM_JOURNAL_EVENT_COUNT:
        break;
    }
    return fm_fail(err, FM_INVALID, "unknown event");
}

/* A launch that took the whole run down twice is not tried a third time. */
static fm_status bury_killers(run_state *run, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < run->plan->count && status == FM_OK; i++) {
        for (uint32_t launch = 0; launch < plan_case_launches(run->plan, i) && status == FM_OK;
             launch++) {
            const fm_launch_state *state = &run->results->cases[i].launches[launch];
            if (state->is_done || state->begins < 2)
                continue;
            json_t *result = answer_make(FM_CASE_CRASH,
                                         "began twice and never ended: the whole run died with it");
            status = run_end_launch(run, i, launch, result, err);
            json_decref(result);
        }
    }
    return status;
}

static fm_status resume(run_state *run, fm_error *err)
{
    char hash[17];
    const fm_journal_reader reader = { .line = replay, .context = run };
    plan_hash(hash, run->plan, run->desc);
    fm_status status =
        journal_open(&run->journal, run->desc->directory, hash, &run->is_damaged, err);
    if (status == FM_OK)
        status = results_create(&run->results, run->plan, run->plugins, run->desc->directory,
                                journal_run_id(run->journal), err);
    if (status == FM_OK)
        status = journal_replay(run->journal, &reader, &run->is_damaged, err);
    if (status == FM_OK)
        status = bury_killers(run, err);
    return status;
}

static bool should_stop(run_state *run)
{
    if (run->stop_signal == 0)
        run->stop_signal = launcher_stop_signal(&run->launcher);
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
    for (size_t i = 0; i < run->plan->count && status == FM_OK && !should_stop(run); i++) {
        const size_t index = run->order[i];
        if (launch >= plan_case_launches(run->plan, index))
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
        run->progress.total += plan_case_launches(run->plan, i);
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

static fm_status prepare(run_state *run, fm_error *err)
{
    fm_status status = truth_jobs_create(&run->truths, run->plan, run->plugins, err);
    if (status == FM_OK && !plan_index_ids(&run->ids, run->plan))
        status = fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", run->plan->count);
    if (status == FM_OK)
        status = run_make_folders(run, err);
    if (status == FM_OK)
        status = resume(run, err);
    if (status == FM_OK)
        status = write_manifest(run, false, err);
    if (status == FM_OK)
        status = results_write_summary(run->results, err);
    return status;
}

fm_status run_cases(fm_run_result *result, const fm_plan *plan, const fm_plugin_list *plugins,
                    const fm_run_desc *desc, fm_error *err)
{
    fm_status status;
    run_state run = { .plan = plan, .plugins = plugins, .desc = desc };
    assert(plan->launches > 0 && plan->count < UINT32_MAX);
    *result = (fm_run_result){ 0 };
    run.progress.out = desc->progress;
    run.progress.is_terminal = desc->progress != NULL && isatty(fileno(desc->progress));
    run.order = calloc(plan->count > 0 ? plan->count : 1, sizeof *run.order);
    if (run.order == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", plan->count);
    status = prepare(&run, err);
    if (status == FM_OK) {
        launcher_open(&run.launcher);
        status = run_launches(&run, err);
        launcher_close(&run.launcher);
        if (status != FM_OK) /* what the last summary lacks; nobody asks how that ended */
            results_write_summary(run.results, NULL);
    }
    if (status == FM_OK)
        status = results_end(run.results, err);
    if (status == FM_OK)
        status = sum_noise(result, &run, err);
    if (status == FM_OK)
        status = write_manifest(&run, run.stop_signal == 0, err);
    if (status == FM_OK && run.stop_signal == 0)
        run_remove_truths(&run);
    if (run.results != NULL && !run.is_damaged)
        count_outcomes(result, &run);
    result->is_damaged = run.is_damaged;
    journal_close(run.journal);
    results_destroy(run.results);
    truth_jobs_free(&run.truths);
    text_index_free(&run.ids);
    free(run.order);
    return status;
}
