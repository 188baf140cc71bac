/* Adaptive numbers of launches: at the looks of decide/precision.h a group goes on, or stops.
 *
 * A group stops together, so that all cases of a chart have as many launches, of the same rounds:
 * when each case that still counts is as precise as the run asks, or at its last look. A case that
 * failed, or has no times, keeps nobody from stopping. A decision is written for each case that it
 * concerns, and the first line of it binds: whoever continues the run follows it for all cases of
 * the group. If all of a group's cases are forgotten, so is what was decided. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "decide/precision.h"
#include "run_internal.h"

void run_looks_free(run_looks *looks)
{
    free(looks->groups);
    free(looks->of_case);
    free(looks->told);
    *looks = (run_looks){ 0 };
}

/* Cases of one truth are of one scene and device. Those of one scene under two names stand in two
 * charts. */
static void group_name(char name[512], const run_state *run, size_t i)
{
    const fm_case *planned = &run->plan->cases[i];
    snprintf(name, 512, "%zu %u %.17g %s %s", run->truths.of_case[i],
             plan_case_launches(run->plan, i), planned->settings.precision_percent, planned->feed,
             planned->scene);
}

/* false: no memory. */
static bool add_case(run_looks *looks, fm_text_index *names, const run_state *run, size_t i)
{
    char name[512];
    const fm_case *planned = &run->plan->cases[i];
    looks->of_case[i] = RUN_NO_GROUP;
    if (planned->skip != NULL || planned->settings.precision_percent <= 0.0)
        return true;
    group_name(name, run, i);
    const size_t group = text_index_add(names, name, looks->count);
    looks->of_case[i] = group;
    if (group == looks->count)
        looks->groups[looks->count++] = (run_look_group){
            .last = plan_case_launches(run->plan, i),
            .precision_percent = planned->settings.precision_percent,
        };
    return group != FM_TEXT_INDEX_NONE;
}

fm_status run_looks_create(run_state *run, fm_error *err)
{
    const size_t room = run->plan->count + 1;
    fm_text_index names = { 0 };
    run_looks_free(&run->looks);
    run->looks = (run_looks){
        .groups = calloc(room, sizeof *run->looks.groups),
        .of_case = calloc(room, sizeof *run->looks.of_case),
        .told = calloc(room, sizeof *run->looks.told),
    };
    bool is_done =
        run->looks.groups != NULL && run->looks.of_case != NULL && run->looks.told != NULL;
    for (size_t i = 0; i < run->plan->count && is_done; i++)
        is_done = add_case(&run->looks, &names, run, i);
    text_index_free(&names);
    return is_done ? FM_OK
                   : fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", run->plan->count);
}

static run_look_group *group_of(const run_state *run, size_t case_index)
{
    const size_t group = run->looks.of_case[case_index];
    return group != RUN_NO_GROUP ? &run->looks.groups[group] : NULL;
}

static bool has_look(const run_look_group *group, uint32_t launch)
{
    return launch < group->last && precision_has_look(group->last, launch);
}

fm_status run_look_replay(run_state *run, size_t case_index, uint32_t launch, bool is_enough,
                          fm_error *err)
{
    run_look_group *group = group_of(run, case_index);
    if (group == NULL || !has_look(group, launch))
        return fm_fail(err, FM_INVALID, "launch %u: no look of this plan", launch);
    const bool is_new = launch > group->decided;
    const bool fits = is_new                     ? !group->has_enough
                      : launch == group->decided ? is_enough == group->has_enough
                                                 : !is_enough;
    if (!fits)
        return fm_fail(err, FM_INVALID, "launch %u: other cases of its scene decided otherwise",
                       launch);
    run->looks.told[case_index] = launch;
    if (is_new) {
        group->decided = launch;
        group->has_enough = is_enough;
    }
    return FM_OK;
}

fm_status run_look_allows(const run_state *run, size_t case_index, uint32_t launch, fm_error *err)
{
    const run_look_group *group = group_of(run, case_index);
    if (group == NULL || !group->has_enough || launch < group->decided)
        return FM_OK;
    return fm_fail(err, FM_INVALID, "launch %u: %u were enough", launch, group->decided);
}

static void stop_group(run_state *run, size_t group)
{
    for (size_t i = 0; i < run->plan->count; i++)
        if (run->looks.of_case[i] == group)
            results_want(run->results, i, run->looks.groups[group].decided);
}

void run_looks_apply(run_state *run)
{
    for (size_t i = 0; i < run->looks.count; i++)
        if (run->looks.groups[i].has_enough)
            stop_group(run, i);
}

/* Whether all cases that still count are precise. *is_pending: there is one. */
static fm_status judge(bool *is_enough, bool *is_pending, const run_state *run, size_t group,
                       fm_error *err)
{
    const double wanted = run->looks.groups[group].precision_percent / 100.0;
    fm_status status = FM_OK;
    *is_enough = true;
    *is_pending = false;
    for (size_t i = 0; i < run->plan->count && status == FM_OK; i++) {
        double half_width;
        bool has_times;
        if (run->looks.of_case[i] != group || !run_is_pending(run, i))
            continue;
        *is_pending = true;
        status = summary_half_width(&half_width, &has_times, run->results, i, err);
        *is_enough = *is_enough && (!has_times || half_width <= wanted);
    }
    return status;
}

/* A line for each case that has none of this look; they are compared equally often. */
static fm_status write_decision(run_state *run, size_t group, uint32_t launch, bool is_enough,
                                fm_error *err)
{
    const fm_journal_event event = is_enough ? FM_JOURNAL_ENOUGH : FM_JOURNAL_MORE;
    fm_status status = FM_OK;
    for (size_t i = 0; i < run->plan->count && status == FM_OK; i++) {
        if (run->looks.of_case[i] != group || run->looks.told[i] >= launch ||
            !run_is_pending(run, i))
            continue;
        status = journal_write(run->journal, event, run->plan->cases[i].id, launch, NULL, err);
        run->looks.told[i] = launch;
    }
    return status;
}

static void tell_stop(run_state *run, size_t group)
{
    char subject[200], sentence[64];
    const run_look_group *of = &run->looks.groups[group];
    size_t first = 0;
    while (run->looks.of_case[first] != group)
        first++;
    const fm_case *planned = &run->plan->cases[first];
    snprintf(subject, sizeof subject, "%.80s %.60s %.30s", planned->scene, planned->device,
             planned->feed);
    snprintf(sentence, sizeof sentence, "precise enough after %u of at most %u launches",
             of->decided, of->last);
    progress_tell(&run->progress, subject, sentence);
}

static fm_status look_at(run_state *run, size_t group, uint32_t launch, fm_error *err)
{
    run_look_group *of = &run->looks.groups[group];
    bool is_enough, is_pending;
    fm_status status = judge(&is_enough, &is_pending, run, group, err);
    if (status != FM_OK || !is_pending)
        return status;
    if (launch <= of->decided) /* by an earlier process; it had not enough, or none was pending */
        is_enough = false;
    status = write_decision(run, group, launch, is_enough, err);
    if (status != FM_OK || launch <= of->decided)
        return status;
    of->decided = launch;
    of->has_enough = is_enough;
    if (!is_enough)
        return FM_OK;
    for (size_t i = 0; i < run->plan->count; i++)
        if (run->looks.of_case[i] == group)
            run->progress.total -= of->last - launch;
    stop_group(run, group);
    tell_stop(run, group);
    return FM_OK;
}

fm_status run_look(run_state *run, uint32_t launch, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < run->looks.count && status == FM_OK; i++)
        if (has_look(&run->looks.groups[i], launch))
            status = look_at(run, i, launch, err);
    return status;
}
