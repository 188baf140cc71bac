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

static fm_status find_launch(size_t *index, const run_state *run, const char *case_id,
                             uint32_t launch, fm_error *err)
{
    size_t i = 0;
    while (i < run->plan->count && strcmp(run->plan->cases[i].id, case_id) != 0)
        i++;
    *index = i;
    return i == run->plan->count || launch >= plan_case_launches(run->plan, i)
               ? fm_fail(err, FM_INVALID, "case %.32s, launch %u is not of this plan", case_id,
                         launch)
               : FM_OK;
}

static fm_status replay_event(run_state *run, fm_journal_event event, size_t i, uint32_t launch,
                              const json_t *result, fm_error *err)
{
    fm_launch_state *state = &run->results->cases[i].launches[launch];
    switch (event) {
    case FM_JOURNAL_BEGIN: /* what began and has no end is measured again: nobody is to blame */
    case FM_JOURNAL_STOP:
        return FM_OK;
    case FM_JOURNAL_DIED:
        free(state->death);
        state->death = strdup(answer_message(result));
        return state->death != NULL ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for a death");
    case FM_JOURNAL_END:
        results_take_mesh(run->results, result);
        return state->is_done ? fm_fail(err, FM_INVALID, "launch %u ended twice", launch)
                              : results_add(run->results, i, launch, result, err);
    case FM_JOURNAL_FORGET:
    case FM_JOURNAL_EVENT_COUNT:
        break;
    }
    return fm_fail(err, FM_INVALID, "unknown event");
}

static fm_status count_forget(void *context, fm_journal_event event, const char *case_id,
                              uint32_t launch, const json_t *result, fm_error *err)
{
    run_state *run = context;
    size_t i;
    (void)event, (void)result;
    const fm_status status = find_launch(&i, run, case_id, launch, err);
    if (status == FM_OK)
        run->forgets[i]++;
    return status;
}

/* What a case has above its last FORGET is as if it had never been. */
static fm_status replay(void *context, fm_journal_event event, const char *case_id, uint32_t launch,
                        const json_t *result, fm_error *err)
{
    run_state *run = context;
    size_t i;
    const fm_status status = find_launch(&i, run, case_id, launch, err);
    if (status != FM_OK || run->forgets[i] == 0)
        return status == FM_OK ? replay_event(run, event, i, launch, result, err) : status;
    run->forgets[i] -= event == FM_JOURNAL_FORGET;
    return FM_OK;
}

/* All that is known of the run so far, from its journal. */
static fm_status read_journal(run_state *run, fm_error *err)
{
    const fm_journal_reader forgets = { .line = count_forget,
                                        .only_forgets = true,
                                        .context = run };
    const fm_journal_reader all = { .line = replay, .context = run };
    results_destroy(run->results);
    fm_status status = results_create(&run->results, run->plan, run->plugins, run->desc->directory,
                                      journal_run_id(run->journal), err);
    if (status == FM_OK)
        status = journal_replay(run->journal, &forgets, &run->is_damaged, err);
    if (status == FM_OK)
        status = journal_replay(run->journal, &all, &run->is_damaged, err);
    return status;
}

/* Rows that are to be measured anew. A case that is not to be launched has nothing to forget. */
static fm_status forget_rows(run_state *run, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < run->plan->count && status == FM_OK; i++) {
        const fm_case_result *kept = &run->results->cases[i];
        if (kept->done == 0 || (run->desc->retried & 1u << kept->status) == 0)
            continue;
        run_remove_images(run, i);
        run->forgotten++;
        status =
            journal_write(run->journal, FM_JOURNAL_FORGET, run->plan->cases[i].id, 0, NULL, err);
    }
    return status;
}

static fm_status resume(run_state *run, fm_error *err)
{
    char hash[17];
    plan_hash(hash, run->plan, run->desc);
    fm_status status =
        journal_open(&run->journal, run->desc->directory, hash, &run->is_damaged, err);
    if (status == FM_OK)
        status = read_journal(run, err);
    if (status == FM_OK)
        status = forget_rows(run, err);
    if (status == FM_OK && run->forgotten > 0)
        status = read_journal(run, err);
    return status;
}

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
    for (size_t i = 0; i < run->plan->count; i++)
        if (run->truths.of_case[i] == job && run_is_pending(run, i))
            return true;
    return false;
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
        progress_tell(&run->progress, "--retry", anew);
}

static fm_status prepare(run_state *run, fm_error *err)
{
    fm_status status = truth_jobs_create(&run->truths, run->plan, run->plugins, err);
    if (status == FM_OK)
        status = run_make_folders(run, err);
    if (status == FM_OK)
        status = resume(run, err);
    if (status == FM_OK)
        status = write_manifest(run, false, err);
    if (status == FM_OK)
        status = results_write_summary(run->results, err);
    if (status == FM_OK)
        tell_continued(run);
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
    run.forgets = calloc(plan->count > 0 ? plan->count : 1, sizeof *run.forgets);
    status = run.order != NULL && run.forgets != NULL
                 ? prepare(&run, err)
                 : fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", plan->count);
    if (status == FM_OK)
        status = stop_signals_open(&run.signals, err);
    if (status == FM_OK) {
        status = run_launches(&run, err);
        stop_signals_close(&run.signals);
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
    result->forgotten = run.forgotten;
    journal_close(run.journal);
    results_destroy(run.results);
    truth_jobs_free(&run.truths);
    free(run.order);
    free(run.forgets);
    return status;
}
