#include "case_metrics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "options.h"

/* What papers plot instead of times. */
typedef struct derived {
    fm_metric metric;
    double (*value)(double frame_ms, const fm_case_row *result);
} derived;

static double fps(double frame_ms, const fm_case_row *result)
{
    (void)result;
    return 1e3 / frame_ms;
}

static double mib(double frame_ms, const fm_case_row *result)
{
    (void)frame_ms;
    return result->metric[FM_METRIC_BYTES_ALLOCATED] / 1048576.0;
}

static double fps_per_mib(double frame_ms, const fm_case_row *result)
{
    return fps(frame_ms, result) / mib(frame_ms, result);
}

static const derived *derived_find(const char *name)
{
    static const derived all[] = { { FM_METRIC_FPS, fps },
                                   { FM_METRIC_MIB, mib },
                                   { FM_METRIC_FPS_PER_MIB, fps_per_mib } };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (strcmp(fm_metrics[all[i].metric].name, name) == 0)
            return &all[i];
    return NULL;
}

/* A long frame is few frames a second: the ends of the interval change places. */
static fm_interval derive(const derived *metric, const fm_case_row *result, fm_interval frame_ms)
{
    const double a = metric->value(frame_ms.low, result), b = metric->value(frame_ms.high, result);
    fm_interval value = { metric->value(frame_ms.median, result), NAN, NAN };
    if (interval_is_known(&frame_ms)) {
        value.low = fmin(a, b);
        value.high = fmax(a, b);
    }
    return value;
}

static bool is_metric(const fm_result_files *results, size_t row, const char *name)
{
    return results->samples.case_index[row] != UINT32_MAX &&
           isfinite(results->samples.value[row]) &&
           strcmp(table_cell(results->samples.table, row, results->samples.metric_column), name) ==
               0;
}

/* Median of a case's samples of one metric. */
static double sample_median(const fm_result_files *results, size_t case_index, const char *name)
{
    const size_t first = results->samples.first[case_index];
    const size_t end = results->samples.first[case_index + 1];
    size_t count = 0;
    double *values = calloc(end - first + 1, sizeof *values);
    if (values == NULL)
        return NAN;
    for (size_t i = first; i < end; i++)
        if (is_metric(results, results->samples.rows[i], name))
            values[count++] = results->samples.value[results->samples.rows[i]];
    const double median = stats_median(values, count);
    free(values);
    return median;
}

double case_metric(const fm_result_files *results, const fm_case_row *result, const char *name)
{
    double value;
    const derived *metric = derived_find(name);
    if (metric != NULL)
        return metric->value(result->metric[FM_METRIC_FRAME_MS], result);
    /* Files from before a metric had a column have it in samples.csv. */
    if (case_number(&value, result, name) && !isnan(value))
        return value;
    return sample_median(results, (size_t)(result - results->cases), name);
}

double case_place(const fm_result_files *results, const fm_case_row *result, const char *name)
{
    char option[FM_OPTION_VALUE_BYTES];
    double value = case_metric(results, result, name);
    options_value(option, result->options, name);
    if (isnan(value) && !text_to_double(&value, option))
        return NAN;
    return value;
}

/* One metric of each frame of a case, summed with others. */
typedef struct frame_sums {
    uint64_t *frames;
    double *values;
    uint32_t *launches;
    size_t count;
} frame_sums;

static void add_frame(frame_sums *sums, uint64_t frame, double value)
{
    size_t i = 0;
    while (i < sums->count && sums->frames[i] != frame)
        i++;
    if (i == sums->count) {
        sums->frames[i] = frame;
        sums->values[i] = 0.0;
        sums->launches[i] = (uint32_t)(frame >> 32);
        sums->count++;
    }
    sums->values[i] += value;
}

/* Adds the frames' values of one metric; false: it has none by frame. */
static bool add_metric(frame_sums *sums, const fm_result_files *results, size_t case_index,
                       const char *name)
{
    bool has_any = false;
    for (size_t i = results->samples.first[case_index]; i < results->samples.first[case_index + 1];
         i++) {
        const uint32_t row = results->samples.rows[i];
        if (results->samples.frame[row] == FM_SAMPLE_OF_CASE || !is_metric(results, row, name))
            continue;
        add_frame(sums, results->samples.frame[row], results->samples.value[row]);
        has_any = true;
    }
    return has_any;
}

static bool open_sums(frame_sums *sums, size_t room)
{
    *sums = (frame_sums){ .frames = calloc(room, sizeof *sums->frames),
                          .values = calloc(room, sizeof *sums->values),
                          .launches = calloc(room, sizeof *sums->launches) };
    return sums->frames != NULL && sums->values != NULL && sums->launches != NULL;
}

static void close_sums(frame_sums *sums)
{
    free(sums->frames);
    free(sums->values);
    free(sums->launches);
}

/* The parts of a sum of metrics. */
typedef struct metric_sum {
    frame_sums frames;
    double constant;    /* what is the same for all frames */
    size_t found;       /* how many of the metrics the case has */
    bool is_timed;      /* one of them */
    bool is_timed_once; /* a time that stands for the case as a whole: it was taken once */
} metric_sum;

static void add_metrics(metric_sum *sum, const fm_result_files *results, const fm_case_row *result,
                        const char *const *names, size_t name_count)
{
    for (size_t i = 0; i < name_count; i++) {
        const bool is_timed = metric_is_time(names[i]);
        double value = 0.0;
        const bool has_frames =
            add_metric(&sum->frames, results, (size_t)(result - results->cases), names[i]);
        if (!has_frames)
            value = case_metric(results, result, names[i]);
        if (isnan(value))
            continue;
        sum->constant += value;
        sum->found++;
        sum->is_timed |= is_timed;
        sum->is_timed_once |= is_timed && !has_frames;
    }
}

static fm_interval interval_of(const metric_sum *sum)
{
    const frame_sums *frames = &sum->frames;
    uint32_t group_count = 1;
    if (sum->found == 0)
        return interval_exact(NAN);
    for (size_t i = 0; i < frames->count; i++)
        if (frames->launches[i] >= group_count)
            group_count = frames->launches[i] + 1;
    fm_interval interval = interval_exact(0.0);
    if (frames->count > 0)
        interval = stats_by_launch(&(fm_samples){ .values = frames->values,
                                                  .group_of = frames->launches,
                                                  .count = frames->count,
                                                  .group_count = group_count });
    if (!sum->is_timed)
        interval = interval_exact(interval.median);
    if (sum->is_timed_once)
        interval.low = interval.high = NAN;
    interval.median += sum->constant;
    interval.low += sum->constant;
    interval.high += sum->constant;
    return interval;
}

/* As summary.csv has it; false: it has no interval of this metric. */
static bool read_interval(fm_interval *interval, const fm_case_row *result, const char *name)
{
    fm_metric metric;
    if (!metric_find(&metric, name))
        return false;
    *interval = (fm_interval){ result->metric[metric], result->low[metric], result->high[metric] };
    return interval_is_known(interval);
}

fm_interval case_interval(const fm_result_files *results, const fm_case_row *result,
                          const char *const *names, size_t name_count)
{
    const char *const frame[] = { fm_metrics[FM_METRIC_FRAME_MS].name };
    const derived *metric = name_count == 1 ? derived_find(names[0]) : NULL;
    fm_interval interval = { NAN, NAN, NAN };
    if (metric != NULL && metric_is_time(names[0]))
        return derive(metric, result, case_interval(results, result, frame, 1));
    if (name_count == 1 && read_interval(&interval, result, names[0]))
        return interval;
    const size_t *first = results->samples.first + (result - results->cases);
    metric_sum sum = { 0 };
    if (open_sums(&sum.frames, first[1] - first[0] + 1)) {
        add_metrics(&sum, results, result, names, name_count);
        interval = interval_of(&sum);
    }
    close_sums(&sum.frames);
    return interval;
}
