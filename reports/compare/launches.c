#include "launches.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct launch_value {
    uint32_t launch;
    double value;
} launch_value;

/* One metric's samples of a case. */
typedef struct launch_values {
    launch_value *items; /* [count]; owned */
    size_t count;
} launch_values;

static int compare_launches(const void *left, const void *right)
{
    const launch_value *a = left, *b = right;
    return (a->launch > b->launch) - (a->launch < b->launch);
}

/* Of the frames that count, launch by launch. false: no memory. */
static bool open_values(launch_values *values, const fm_sample_rows *samples, size_t case_index,
                        const char *metric)
{
    const size_t first = samples->first[case_index], end = samples->first[case_index + 1];
    *values = (launch_values){ calloc(end - first + 1, sizeof *values->items), 0 };
    if (values->items == NULL)
        return false;
    for (size_t i = first; i < end; i++) {
        const uint32_t row = samples->rows[i];
        if (samples->frame[row] == FM_SAMPLE_OF_CASE || !isfinite(samples->value[row]) ||
            strcmp(table_cell(samples->table, row, samples->metric_column), metric) != 0)
            continue;
        values->items[values->count++] =
            (launch_value){ (uint32_t)(samples->frame[row] >> 32), samples->value[row] };
    }
    qsort(values->items, values->count, sizeof *values->items, compare_launches);
    return true;
}

/* The median of a launch, NAN if it has none; *at goes on to the launches behind it. */
static double take_median(size_t *at, const launch_values *from, uint32_t launch, double *room)
{
    size_t count = 0;
    while (*at < from->count && from->items[*at].launch < launch)
        (*at)++;
    for (; *at < from->count && from->items[*at].launch == launch; (*at)++)
        room[count++] = from->items[*at].value;
    return stats_median(room, count);
}

fm_status launches_numbers(fm_launch_list *list, const fm_result_files *results,
                           const fm_case_row *row, const char *metric, const char *over,
                           fm_error *err)
{
    const fm_sample_rows *samples = &results->samples;
    const size_t index = (size_t)(row - results->cases);
    launch_values of, floor;
    const bool has_of = open_values(&of, samples, index, metric);
    const bool has_floor = open_values(&floor, samples, index, over);
    const size_t most = of.count + floor.count + 1;
    double *room = calloc(most, sizeof *room);
    *list = (fm_launch_list){ calloc(of.count + 1, sizeof *list->items), 0 };
    const bool has_memory = has_of && has_floor && room != NULL && list->items != NULL;
    size_t at = 0, over_at = 0;
    while (has_memory && at < of.count) {
        const uint32_t launch = of.items[at].launch;
        fm_launch_numbers *one = &list->items[list->count++];
        one->launch = launch;
        one->value = take_median(&at, &of, launch, room);
        one->over = take_median(&over_at, &floor, launch, room);
    }
    free(room);
    free(floor.items);
    free(of.items);
    if (has_memory)
        return FM_OK;
    free(list->items);
    *list = (fm_launch_list){ 0 };
    return fm_fail(err, FM_NO_MEMORY, "no memory for %zu samples", most);
}

fm_interval launches_ratio(const fm_result_files *results, const fm_case_row *row,
                           const char *metric, const char *over)
{
    fm_interval interval = { NAN, NAN, NAN };
    fm_launch_list list;
    size_t kept = 0;
    if (launches_numbers(&list, results, row, metric, over, NULL) != FM_OK)
        return interval;
    double *ratios = calloc(list.count + 1, sizeof *ratios);
    for (size_t i = 0; i < list.count && ratios != NULL; i++) {
        const double ratio = list.items[i].value / list.items[i].over;
        if (isfinite(ratio))
            ratios[kept++] = ratio;
    }
    if (ratios != NULL)
        interval = stats_interval(ratios, kept);
    free(ratios);
    free(list.items);
    return interval;
}
