#include "night.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "findings.h"

/* So many nights of each case are looked at: steps of 200 take a third of a second a case. */
enum { NIGHTS = 90 };
static const double usual_effect = 1.06;
/* A step is found in three nights, in nine of ten months, if it is so many standard errors of a
 * night (tests/reports/alarm_test.c). */
static const double errors_in_a_step = 3.6;

static const char *const kind_names[] = {
    [FM_FINDING_SLOWER] = "slower",
    [FM_FINDING_STATUS] = "status",
    [FM_FINDING_MEMORY] = "memory",
    [FM_FINDING_ERROR] = "error",
};

const char *finding_kind_name(fm_finding_kind kind)
{
    return kind_names[kind];
}

const char *finding_standing(const fm_finding *finding)
{
    if (finding->is_dismissed)
        return ", not confirmed";
    return finding->is_confirmed ? ", confirmed" : "";
}

/* The series whose last night is this case of this run: series end with it, by `until`. */
static void find_series(fm_night_case *found, const fm_series_list *list, const char *run_id,
                        const fm_case_row *row)
{
    for (size_t i = 0; i < list->count && found->series == NULL; i++) {
        const fm_series *series = &list->items[i];
        const fm_series_night *last = &series->nights[series->count - 1];
        if (strcmp(last->run_id, run_id) != 0 || strcmp(last->case_id, row->id) != 0)
            continue;
        found->series = series;
        found->previous = series->count > 1 ? &series->nights[series->count - 2] : NULL;
    }
}

static void add_alarms(fm_night_result *night, fm_text *problems)
{
    for (size_t i = 0; i < night->desc->now->count; i++) {
        const fm_series *series = night->cases[i].series;
        if (series == NULL)
            continue;
        night->early += series->alarm.verdict == FM_ALARM_EARLY;
        if (series->alarm.verdict != FM_ALARM_STEP)
            continue;
        fm_text words = { 0 };
        alarm_add_words(&words, &series->alarm);
        fm_finding *finding =
            findings_add(night, FM_FINDING_SLOWER, i, words.bytes != NULL ? words.bytes : "");
        problems->failed |= finding == NULL || words.failed;
        text_free(&words);
        if (finding != NULL && night->desc->confirm != NULL)
            finding->is_dismissed =
                !night->desc->confirm(finding, night->desc->now, night->desc->context);
    }
}

/* By the noisiest case that has a standard error. */
static void plan_launches(fm_night_result *night)
{
    const double effect = night->desc->effect > 0 ? night->desc->effect : usual_effect;
    const double wanted = log(effect) / errors_in_a_step;
    night->noisiest = NAN;
    for (size_t i = 0; i < night->desc->now->count; i++) {
        const fm_series *series = night->cases[i].series;
        if (series == NULL)
            continue;
        const fm_centre *centre = &series->nights[series->count - 1].centre;
        if (isnan(centre->standard_error))
            continue;
        night->noisiest = fmax(night->noisiest, centre->standard_error);
        const double share = centre->standard_error / wanted;
        const double needed = ceil((double)centre->launches * share * share);
        if (needed > (double)night->launches_needed)
            night->launches_needed = needed < 1e6 ? (size_t)needed : (size_t)1e6;
    }
}

static int compare_findings(const void *left, const void *right)
{
    const fm_finding *a = left, *b = right;
    if (a->kind != b->kind)
        return a->kind < b->kind ? -1 : 1;
    return a->case_index < b->case_index ? -1 : a->case_index > b->case_index;
}

static void count_failures(fm_night_result *night)
{
    for (size_t i = 0; i < night->desc->now->count; i++)
        night->new_failures += night->desc->now->cases[i].outcome > FM_CASE_NOT_SUPPORTED &&
                               night->cases[i].previous == NULL && night->desc->baseline == NULL;
    for (size_t i = 0; i < night->count; i++)
        night->alarms += !night->findings[i].is_dismissed;
}

fm_status night_judge(fm_night_result *night, const fm_night_desc *desc, fm_error *err)
{
    const char *run_id = provenance_fact(desc->now->manifest, "run_id");
    fm_text problems = { 0 };
    *night = (fm_night_result){ .desc = desc };
    night->cases = calloc(desc->now->count + 1, sizeof *night->cases);
    if (night->cases == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", desc->now->count);
    const fm_series_desc series = { .reference = desc->reference, .until = run_id, .most = NIGHTS };
    fm_status status = history_newer_runs(&night->newer, desc->history, run_id, err);
    if (status == FM_OK)
        status = history_series(&night->series, desc->history, &series, err);
    if (status != FM_OK)
        return status;
    for (size_t i = 0; i < desc->now->count; i++)
        find_series(&night->cases[i], &night->series, run_id, &desc->now->cases[i]);
    add_alarms(night, &problems);
    if (problems.failed)
        status = fm_fail(err, FM_NO_MEMORY, "no memory for findings");
    if (status == FM_OK)
        status = findings_since_last_night(night, err);
    if (status == FM_OK && desc->baseline != NULL)
        status = findings_since_baseline(night, err);
    if (status != FM_OK)
        return status;
    if (night->count > 0)
        qsort(night->findings, night->count, sizeof *night->findings, compare_findings);
    plan_launches(night);
    count_failures(night);
    return FM_OK;
}

void night_free(fm_night_result *night)
{
    history_series_free(&night->series);
    free(night->findings);
    free(night->cases);
    *night = (fm_night_result){ 0 };
}
