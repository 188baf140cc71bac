/* Columns that hold a case's times against what is below them: the floor, and what the device's
 * limits allow. Launch by launch: numbers of one process, moments apart, are divided. */
#include <math.h>
#include <stdio.h>

#include "bound/bound.h"
#include "summary_internal.h"

static fm_interval interval_of(const row_state *row, size_t count)
{
    const double coverage = summary_coverage(row);
    return coverage > 0.0 ? stats_interval_at(row->by_launch, count, coverage)
                          : stats_interval(row->by_launch, count);
}

/* Store time, or the frame's where that is all that is timed, over the floor's. */
fm_interval summary_times_floor(const row_state *row)
{
    const bool is_span = row->measured->settings.timers == FM_TIMERS_FRAME;
    size_t count = 0;
    for (uint32_t i = 0; i < row->results->plan->launches; i++) {
        const double ms = summary_median(row, is_span ? FM_METRIC_FRAME_MS : FM_METRIC_STORE_MS, i);
        const double floor_ms =
            summary_median(row, is_span ? FM_METRIC_FLOOR_FRAME_MS : FM_METRIC_FLOOR_STORE_MS, i);
        if (!isnan(ms) && floor_ms > 0.0)
            row->by_launch[count++] = ms / floor_ms;
    }
    return interval_of(row, count);
}

static double number_of(const row_state *row, fm_metric metric)
{
    const json_t *value = summary_metric(row, metric);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

const fm_device_limits *summary_limits(const fm_results *results, const fm_case_result *result)
{
    fm_limits_key key = results->host;
    snprintf(key.device_name, sizeof key.device_name, "%s", result->device_name);
    snprintf(key.driver, sizeof key.driver, "%s", result->device_driver);
    return results->limits != NULL ? limits_find(results->limits, &key) : NULL;
}

bool summary_lacks_limits(const fm_results *results, size_t case_index)
{
    const fm_case_result *result = &results->cases[case_index];
    bool has_times = false;
    for (size_t i = 0; i < result->sample_count && !has_times; i++)
        has_times = result->samples[i].metric == FM_METRIC_FLOOR_FRAME_MS;
    return has_times && summary_limits(results, result) == NULL;
}

static const fm_device_limits *limits_of(const row_state *row)
{
    return summary_limits(row->results, row->result);
}

static double bound_of_launch(const row_state *row, uint32_t launch)
{
    const fm_settings *settings = &row->measured->settings;
    const fm_device_limits *limits = limits_of(row);
    const fm_bound_work work = {
        .fragments = number_of(row, FM_METRIC_FRAGMENTS_GENERATED),
        .kept = number_of(row, FM_METRIC_FRAGMENTS_WANTED),
        .pixels = (double)settings->width_px * settings->height_px,
        .floor_ms = summary_median(row, FM_METRIC_FLOOR_FRAME_MS, launch),
    };
    return limits != NULL ? bound_ms(&work, limits) : NAN;
}

fm_interval summary_bound_ms(const row_state *row)
{
    size_t count = 0;
    for (uint32_t i = 0; i < row->results->plan->launches; i++) {
        const double ms = bound_of_launch(row, i);
        if (!isnan(ms))
            row->by_launch[count++] = ms;
    }
    return interval_of(row, count);
}

fm_interval summary_times_bound(const row_state *row)
{
    size_t count = 0;
    for (uint32_t i = 0; i < row->results->plan->launches; i++) {
        const double ms = bound_of_launch(row, i);
        const double frame_ms = summary_median(row, FM_METRIC_FRAME_MS, i);
        if (!isnan(frame_ms) && ms > 0.0)
            row->by_launch[count++] = frame_ms / ms;
    }
    return interval_of(row, count);
}

fm_interval summary_limit(const row_state *row, fm_limit limit)
{
    const fm_device_limits *limits = limits_of(row);
    return limits != NULL ? limits->values[limit] : (fm_interval){ NAN, NAN, NAN };
}

const char *summary_limited_by(const row_state *row)
{
    const fm_device_limits *limits = limits_of(row);
    if (limits == NULL)
        return bound_limit_name(FM_BOUND_UNKNOWN);
    return bound_limit_name(bound_limited_by(
        summary_median(row, FM_METRIC_FLOOR_FRAME_MS, UINT32_MAX),
        number_of(row, FM_METRIC_BYTES_MOVED), number_of(row, FM_METRIC_ATOMICS), limits));
}
