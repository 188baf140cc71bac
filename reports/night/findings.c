#include "findings.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/comparison.h"
#include "tradeoff/error_kind.h"

fm_finding *findings_add(fm_night_result *night, fm_finding_kind kind, size_t case_index,
                         const char *text)
{
    if (night->count == night->capacity) {
        const size_t more = 2 * night->capacity + 16;
        fm_finding *grown = reallocarray(night->findings, more, sizeof *grown);
        if (grown == NULL)
            return NULL;
        night->findings = grown;
        night->capacity = more;
    }
    fm_finding *added = &night->findings[night->count++];
    *added = (fm_finding){ .kind = kind, .case_index = case_index };
    snprintf(added->text, sizeof added->text, "%s", text);
    return added;
}

/* What grew, or got worse. */
typedef struct worsening {
    fm_finding_kind kind;
    size_t case_index;
    const char *what, *base, *now, *since;
} worsening;

static fm_status add(fm_night_result *night, const worsening *found, fm_error *err)
{
    char text[320];
    snprintf(text, sizeof text, "%.40s %.63s -> %.63s since %.100s", found->what, found->base,
             found->now, found->since);
    return findings_add(night, found->kind, found->case_index, text) != NULL
               ? FM_OK
               : fm_fail(err, FM_NO_MEMORY, "no memory for %zu findings", night->count);
}

/* Which kind of finding a metric is that grew; FM_FINDING_COUNT: none. */
static fm_finding_kind kind_of(const char *name)
{
    const fm_metric_info *info = metric_describe(name);
    if (info == NULL || info->better != FM_BETTER_LESS)
        return FM_FINDING_COUNT;
    return info->range == FM_RANGE_BYTES ? FM_FINDING_MEMORY : FM_FINDING_ERROR;
}

static bool is_worse_status(const char *base, const char *now)
{
    fm_case_status before, after;
    return case_status_parse(&before, base) && case_status_parse(&after, now) &&
           after > FM_CASE_NOT_SUPPORTED && after > before && before != FM_CASE_SKIPPED;
}

/* Of methods that race, or drew several images, errors need not repeat. */
static bool repeats(const fm_case_row *row)
{
    return (row->look.traits & FM_TRAIT_RACY) == 0 && !(row->metric[FM_METRIC_DISTINCT_IMAGES] > 1);
}

/* What is compared of a night. */
static const struct {
    fm_metric metric;
    size_t at;
} numbers[] = {
    { FM_METRIC_BYTES_ALLOCATED, offsetof(fm_series_night, bytes_allocated) },
    { FM_METRIC_MISSING, offsetof(fm_series_night, missing) },
    { FM_METRIC_EXTRA, offsetof(fm_series_night, extra) },
    { FM_METRIC_MISORDERED, offsetof(fm_series_night, misordered) },
    { FM_METRIC_MAX_ABS, offsetof(fm_series_night, max_abs) },
    { FM_METRIC_TOTAL_RMSE, offsetof(fm_series_night, total_rmse) },
};
enum { NUMBER_COUNT = sizeof numbers / sizeof numbers[0] };

static double number_of(const fm_series_night *night, size_t number)
{
    return *(const double *)(const void *)((const char *)night + numbers[number].at);
}

/* The newest night before the last that has the number: nights that were cut off, or failed, have
 * not, and what is worse after them is worse than before. NULL: none has. */
static const fm_series_night *newest_with(const fm_series *series, size_t number)
{
    for (size_t i = series->count - 1; i-- > 0;)
        if (!isnan(number_of(&series->nights[i], number)))
            return &series->nights[i];
    return NULL;
}

/* The same of a status: of a case that had its turn. */
static const fm_series_night *newest_with_status(const fm_series *series)
{
    fm_case_status status;
    for (size_t i = series->count - 1; i-- > 0;)
        if (case_status_parse(&status, series->nights[i].status) && status != FM_CASE_SKIPPED)
            return &series->nights[i];
    return NULL;
}

static fm_status compare_number(fm_night_result *night, size_t index, size_t number, fm_error *err)
{
    char base[32], now[32];
    const fm_metric metric = numbers[number].metric;
    const fm_case_row *row = &night->desc->now->cases[index];
    const fm_error_kind *kind = error_kind_by_metric(metric);
    const fm_finding_kind found = kind_of(fm_metrics[metric].name);
    const fm_series_night *before = newest_with(night->cases[index].series, number);
    if (before == NULL)
        return FM_OK;
    const double grown = row->metric[metric] - number_of(before, number);
    if (!(grown > (kind != NULL ? kind->exact_below : 0.0)) ||
        (found == FM_FINDING_ERROR && !repeats(row)))
        return FM_OK;
    text_from_double(base, number_of(before, number));
    text_from_double(now, row->metric[metric]);
    return add(night,
               &(worsening){ found, index, fm_metrics[metric].name, base, now, before->started },
               err);
}

static fm_status compare_case(fm_night_result *night, size_t index, fm_error *err)
{
    const fm_case_row *row = &night->desc->now->cases[index];
    const fm_series_night *before = newest_with_status(night->cases[index].series);
    fm_status status = FM_OK;
    if (before != NULL && is_worse_status(before->status, row->status))
        status = add(night,
                     &(worsening){ FM_FINDING_STATUS, index, "status", before->status, row->status,
                                   before->started },
                     err);
    for (size_t i = 0; i < NUMBER_COUNT && status == FM_OK; i++)
        if (row->is_measured)
            status = compare_number(night, index, i, err);
    return status;
}

fm_status findings_since_last_night(fm_night_result *night, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < night->desc->now->count && status == FM_OK; i++)
        if (night->cases[i].previous != NULL)
            status = compare_case(night, i, err);
    return status;
}

static fm_status take_change(fm_night_result *night, size_t index, const fm_change *change,
                             const char *since, fm_error *err)
{
    double base, now;
    worsening found = {
        kind_of(change->name), index, change->name, change->base, change->now, since
    };
    bool is_worse = found.kind != FM_FINDING_COUNT && text_to_double(&base, change->base) &&
                    text_to_double(&now, change->now) && now > base;
    if (strcmp(change->name, "status") == 0) {
        found.kind = FM_FINDING_STATUS;
        is_worse = is_worse_status(change->base, change->now);
    }
    return is_worse ? add(night, &found, err) : FM_OK;
}

fm_status findings_since_baseline(fm_night_result *night, fm_error *err)
{
    char since[128];
    fm_comparison comparison = { 0 };
    const fm_comparison_desc desc = { .base = night->desc->baseline,
                                      .now = night->desc->now,
                                      .quantity = { .reference = "floor" } };
    fm_status status = comparison_make(&comparison, &desc, err);
    if (status == FM_UNSUPPORTED) /* no case in common */
        status = FM_OK;
    snprintf(since, sizeof since, "baseline %.80s",
             night->desc->baseline_name != NULL ? night->desc->baseline_name : "");
    for (size_t i = 0; i < comparison.count && status == FM_OK; i++) {
        const fm_compared *compared = &comparison.cases[i];
        const size_t index = (size_t)(compared->pair.now - night->desc->now->cases);
        for (size_t j = 0; j < compared->changes.count && status == FM_OK; j++)
            status = take_change(night, index, &compared->changes.items[j], since, err);
    }
    comparison_free(&comparison);
    return status;
}
