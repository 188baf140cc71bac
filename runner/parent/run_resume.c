/* What an earlier run in the same directory left, from its journal. */
#include <stdlib.h>
#include <string.h>

#include "run_internal.h"

static fm_status replay_event(run_state *run, fm_journal_event event, size_t i, uint32_t launch,
                              const json_t *result, fm_error *err)
{
    fm_launch_state *state = &run->results->cases[i].launches[launch];
    switch (event) {
    case FM_JOURNAL_BEGIN: /* what began and has no end is measured again: nobody is to blame */
    case FM_JOURNAL_STOP:
        return run_look_allows(run, i, launch, err);
    case FM_JOURNAL_MORE:
    case FM_JOURNAL_ENOUGH:
        return run_look_replay(run, i, launch, event == FM_JOURNAL_ENOUGH, err);
    case FM_JOURNAL_DIED:
        free(state->death);
        state->death = strdup(answer_message(result));
        return state->death != NULL ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for a death");
    case FM_JOURNAL_END:
        if (run_look_allows(run, i, launch, err) != FM_OK)
            return FM_INVALID;
        results_take_mesh(run->results, result);
        return results_add(run->results, i, launch, result, err);
    case FM_JOURNAL_FORGET:
    case FM_JOURNAL_EVENT_COUNT:
        break;
    }
    return fm_fail(err, FM_INVALID, "unknown event");
}

/* What a case has above its last FORGET is as if it had never been. */
static fm_status replay(void *context, fm_journal_event event, const char *case_id, uint32_t launch,
                        const json_t *result, fm_error *err)
{
    run_state *run = context;
    size_t i;
    const fm_status status = run_find_case(&i, run, case_id, launch, err);
    if (status != FM_OK || run->codes.rows[i].forgets == 0)
        return status == FM_OK ? replay_event(run, event, i, launch, result, err) : status;
    run->codes.rows[i].forgets -= event == FM_JOURNAL_FORGET;
    return FM_OK;
}

/* After run_read_codes, which counts what is forgotten. */
static fm_status read_results(run_state *run, fm_error *err)
{
    const fm_journal_reader reader = { .line = replay, .context = run };
    results_destroy(run->results);
    fm_status status = results_create(&run->results, run->plan, run->plugins, run->desc->directory,
                                      journal_run_id(run->journal), err);
    if (status == FM_OK)
        status = run_looks_create(run, err);
    if (status == FM_OK)
        status = journal_replay(run->journal, &reader, &run->is_damaged, err);
    if (status == FM_OK)
        run_looks_apply(run);
    return status;
}

/* Rows of statuses that are to be measured anew. A case that is not to be launched has nothing to
 * forget. */
static fm_status forget_retried(run_state *run, fm_error *err)
{
    const uint32_t before = run->forgotten;
    fm_status status = FM_OK;
    for (size_t i = 0; i < run->plan->count && status == FM_OK; i++) {
        const fm_case_result *kept = &run->results->cases[i];
        if (kept->done > 0 && (run->desc->retried & 1u << kept->status) != 0)
            status = run_forget(run, i, err);
    }
    if (status != FM_OK || run->forgotten == before)
        return status;
    status = run_read_codes(run, err);
    return status == FM_OK ? read_results(run, err) : status;
}

/* Ids hold what a plugin says of itself: of one that is refused now they are others, and its plan
 * is another. */
static void tell_refused(const fm_plan *plan, fm_error *err)
{
    size_t i = 0;
    while (i < plan->count && plan->cases[i].skip_status != FM_CASE_PLUGIN_ERROR)
        i++;
    if (err == NULL || i == plan->count)
        return;
    const fm_error told = *err;
    fm_fail(err, told.status, "%.1200s; method %s is refused now: %.600s", told.message,
            plan->cases[i].method, plan->cases[i].skip);
}

fm_status run_resume(run_state *run, fm_error *err)
{
    char hash[17], shard[24];
    const fm_shard *part = &run->plan->shard;
    plan_hash(hash, run->plan, run->desc->validation, run->desc->no_timers);
    snprintf(shard, sizeof shard, "%u/%u", part->index, part->count);
    const fm_journal_plan plan = { .hash = hash,
                                   .shard = part->count > 0 ? shard : NULL,
                                   .whole = part->count > 0 ? part->plan : NULL };
    fm_status status =
        journal_open(&run->journal, run->desc->directory, &plan, &run->is_damaged, err);
    if (status == FM_INVALID)
        tell_refused(run->plan, err);
    if (status == FM_OK)
        status = run_read_codes(run, err);
    if (status == FM_OK)
        status = run_check_codes(run, err);
    if (status == FM_OK)
        status = read_results(run, err);
    if (status == FM_OK)
        status = forget_retried(run, err);
    if (status == FM_OK)
        status = results_keep_replayed(run->results, err);
    return status;
}
