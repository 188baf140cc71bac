#include "launches.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One metric's samples of a case, by launch. */
typedef struct launch_values {
    double *values;      /* [count] */
    uint32_t *launch_of; /* [count] */
    size_t count;
} launch_values;

/* Of the frames that count. */
static void fill(launch_values *to, const fm_sample_rows *samples, size_t case_index,
                 const char *metric)
{
    for (size_t i = samples->first[case_index]; i < samples->first[case_index + 1]; i++) {
        const uint32_t row = samples->rows[i];
        if (samples->frame[row] == FM_SAMPLE_OF_CASE || !isfinite(samples->value[row]) ||
            strcmp(table_cell(samples->table, row, samples->metric_column), metric) != 0)
            continue;
        to->values[to->count] = samples->value[row];
        to->launch_of[to->count++] = (uint32_t)(samples->frame[row] >> 32);
    }
}

/* NAN: the launch has none. room: [count] */
static double median_of(const launch_values *from, uint32_t launch, double *room)
{
    size_t count = 0;
    for (size_t i = 0; i < from->count; i++)
        if (from->launch_of[i] == launch)
            room[count++] = from->values[i];
    return stats_median(room, count);
}

static bool open_values(launch_values *values, size_t room)
{
    *values = (launch_values){ calloc(room, sizeof *values->values),
                               calloc(room, sizeof *values->launch_of), 0 };
    return values->values != NULL && values->launch_of != NULL;
}

static void close_values(launch_values *values)
{
    free(values->values);
    free(values->launch_of);
}

static bool is_first_of_launch(const launch_values *values, size_t index)
{
    for (size_t i = 0; i < index; i++)
        if (values->launch_of[i] == values->launch_of[index])
            return false;
    return true;
}

/* At most one a sample, so that ratios fit where samples do. */
static size_t fill_ratios(double *ratios, const launch_values *metric, const launch_values *over,
                          double *room)
{
    size_t count = 0;
    for (size_t i = 0; i < metric->count; i++) {
        const uint32_t launch = metric->launch_of[i];
        if (!is_first_of_launch(metric, i))
            continue;
        const double ratio = median_of(metric, launch, room) / median_of(over, launch, room);
        if (isfinite(ratio))
            ratios[count++] = ratio;
    }
    return count;
}

fm_interval launches_ratio(const fm_result_files *results, const fm_case_row *row,
                           const char *metric, const char *over)
{
    const fm_sample_rows *samples = &results->samples;
    const size_t index = (size_t)(row - results->cases);
    const size_t most = samples->first[index + 1] - samples->first[index] + 1;
    fm_interval interval = { NAN, NAN, NAN };
    launch_values of, floor;
    double *ratios = calloc(2 * most, sizeof *ratios);
    const bool has_of = open_values(&of, most), has_floor = open_values(&floor, most);
    if (ratios != NULL && has_of && has_floor) {
        fill(&of, samples, index, metric);
        fill(&floor, samples, index, over);
        interval = stats_interval(ratios, fill_ratios(ratios, &of, &floor, ratios + most));
    }
    close_values(&floor);
    close_values(&of);
    free(ratios);
    return interval;
}
