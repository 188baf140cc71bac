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

fm_status launches_numbers(fm_launch_list *list, const fm_result_files *results,
                           const fm_case_row *row, const char *metric, const char *over,
                           fm_error *err)
{
    const fm_sample_rows *samples = &results->samples;
    const size_t index = (size_t)(row - results->cases);
    const size_t most = samples->first[index + 1] - samples->first[index] + 1;
    launch_values of, floor;
    double *room = calloc(most, sizeof *room);
    const bool has_of = open_values(&of, most), has_floor = open_values(&floor, most);
    *list = (fm_launch_list){ calloc(most, sizeof *list->items), 0 };
    const bool has_memory = list->items != NULL && room != NULL && has_of && has_floor;
    if (has_memory) {
        fill(&of, samples, index, metric);
        fill(&floor, samples, index, over);
    }
    for (size_t i = 0; has_memory && i < of.count; i++)
        if (is_first_of_launch(&of, i))
            list->items[list->count++] =
                (fm_launch_numbers){ of.launch_of[i], median_of(&of, of.launch_of[i], room),
                                     median_of(&floor, of.launch_of[i], room) };
    close_values(&floor);
    close_values(&of);
    free(room);
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
