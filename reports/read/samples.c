#include "samples.h"

#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "cell_range.h"

/* Which column is what; the metric's is kept. */
typedef struct sample_columns {
    size_t id, launch, frame, value;
} sample_columns;

/* The rows of each case, in the file's order: a counting sort. */
static fm_status index_by_case(fm_sample_rows *samples, size_t case_count, fm_error *err)
{
    const size_t row_count = samples->table->row_count;
    samples->first = calloc(case_count + 2, sizeof *samples->first);
    samples->rows = calloc(row_count + 1, sizeof *samples->rows);
    if (samples->first == NULL || samples->rows == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu rows", samples->table->path, row_count);
    size_t *first = samples->first;
    for (size_t row = 0; row < row_count; row++)
        if (samples->case_index[row] != UINT32_MAX)
            first[samples->case_index[row] + 2]++;
    for (size_t i = 1; i < case_count + 2; i++)
        first[i] += first[i - 1];
    for (size_t row = 0; row < row_count; row++)
        if (samples->case_index[row] != UINT32_MAX)
            samples->rows[first[samples->case_index[row] + 1]++] = (uint32_t)row;
    return FM_OK;
}

/* A frame of a launch of a case. */
typedef struct frame_name {
    uint64_t frame;
    uint32_t case_index;
} frame_name;

static int compare_frames(const void *left, const void *right)
{
    const frame_name *a = left, *b = right;
    if (a->case_index != b->case_index)
        return a->case_index < b->case_index ? -1 : 1;
    return (a->frame > b->frame) - (a->frame < b->frame);
}

static bool is_named(const fm_sample_rows *samples, size_t row, fm_metric metric)
{
    const char *name = table_cell(samples->table, row, samples->metric_column);
    return strcmp(name, fm_metrics[metric].name) == 0;
}

/* Samples of frames that are marked off_clock count for nothing, as in summary.csv. */
static fm_status leave_out_off_clock(fm_sample_rows *samples, fm_error *err)
{
    const fm_table *table = samples->table;
    size_t count = 0;
    frame_name *slow = calloc(table->row_count + 1, sizeof *slow);
    if (slow == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu rows", table->path, table->row_count);
    for (size_t row = 0; row < table->row_count; row++)
        if (is_named(samples, row, FM_METRIC_OFF_CLOCK))
            slow[count++] = (frame_name){ samples->frame[row], samples->case_index[row] };
    qsort(slow, count, sizeof *slow, compare_frames);
    for (size_t row = 0; row < table->row_count && count > 0; row++) {
        const frame_name own = { samples->frame[row], samples->case_index[row] };
        if (bsearch(&own, slow, count, sizeof *slow, compare_frames) != NULL)
            samples->case_index[row] = UINT32_MAX;
    }
    free(slow);
    return FM_OK;
}

/* A launch or a frame; *number is UINT64_MAX where the cell is empty. */
static fm_status read_whole(uint64_t *number, const fm_table *table, size_t row, size_t column,
                            fm_error *err)
{
    const char *text = table_cell(table, row, column);
    *number = UINT64_MAX;
    if (text[0] == '\0' || (text_to_u64(number, text) && *number < UINT32_MAX))
        return FM_OK;
    return fm_fail(err, FM_INVALID, "%s:%u: %s: \"%.80s\" is not a whole number", table->path,
                   table->lines[row], table->names[column], text);
}

/* Launch and frame as one number; empty cells: the case, or the launch, as a whole. */
static fm_status read_frame(uint64_t *frame, const fm_table *table, size_t row,
                            const sample_columns *columns, fm_error *err)
{
    uint64_t of_launch, of_frame;
    fm_status status = read_whole(&of_launch, table, row, columns->launch, err);
    if (status == FM_OK)
        status = read_whole(&of_frame, table, row, columns->frame, err);
    if (status == FM_OK && of_launch == UINT64_MAX && of_frame != UINT64_MAX)
        status = fm_fail(err, FM_INVALID, "%s:%u: launch: frame %llu is of none", table->path,
                         table->lines[row], (unsigned long long)of_frame);
    *frame = of_frame != UINT64_MAX ? of_launch << 32 | of_frame : FM_SAMPLE_OF_CASE;
    return status;
}

/* Metrics of a newer program, and counters of the simulated GPU, may be any number. */
static fm_status read_value(double *value, const fm_sample_rows *samples, size_t row, size_t column,
                            fm_error *err)
{
    const fm_table *table = samples->table;
    const char *metric = table_cell(table, row, samples->metric_column);
    const fm_metric_info *info = metric_describe(metric);
    if (metric[0] == '\0')
        return fm_fail(err, FM_INVALID, "%s:%u: metric: the row has none", table->path,
                       table->lines[row]);
    return info != NULL ? table_in_range(value, info->range, table, row, column, err)
                        : table_number(value, table, row, column, err);
}

static fm_status find_columns(sample_columns *columns, fm_sample_rows *samples, fm_error *err)
{
    const fm_table *table = samples->table;
    fm_status status = table_check_schema(table, FM_SUMMARY_SCHEMA, err);
    if (status == FM_OK)
        status = table_need_column(&columns->id, table, "case_id", err);
    if (status == FM_OK)
        status = table_need_column(&columns->launch, table, "launch", err);
    if (status == FM_OK)
        status = table_need_column(&columns->frame, table, "frame", err);
    if (status == FM_OK)
        status = table_need_column(&samples->metric_column, table, "metric", err);
    if (status == FM_OK)
        status = table_need_column(&columns->value, table, "value", err);
    return status;
}

static fm_status reserve(fm_sample_rows *samples, fm_error *err)
{
    const fm_table *table = samples->table;
    samples->case_index = calloc(table->row_count + 1, sizeof *samples->case_index);
    samples->value = calloc(table->row_count + 1, sizeof *samples->value);
    samples->frame = calloc(table->row_count + 1, sizeof *samples->frame);
    if (samples->case_index == NULL || samples->value == NULL || samples->frame == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu rows", table->path, table->row_count);
    return FM_OK;
}

/* The index of the case of that id. guess: where to look first, for rows of a case follow one
 * another. UINT32_MAX: none, such as a case of a stopped run that has no row yet. */
static uint32_t find_case(const fm_case_list *of, const char *id, uint32_t guess)
{
    if (guess < of->count && strcmp(of->cases[guess].id, id) == 0)
        return guess;
    const size_t found = text_index_find(of->ids, id);
    return found != FM_TEXT_INDEX_NONE ? (uint32_t)found : UINT32_MAX;
}

static fm_status read_rows(fm_sample_rows *samples, const fm_case_list *of,
                           const sample_columns *columns, fm_error *err)
{
    const fm_table *table = samples->table;
    uint32_t last = 0;
    for (size_t row = 0; row < table->row_count; row++) {
        fm_status status = read_value(&samples->value[row], samples, row, columns->value, err);
        if (status == FM_OK)
            status = read_frame(&samples->frame[row], table, row, columns, err);
        if (status != FM_OK)
            return status;
        const uint32_t found = find_case(of, table_cell(table, row, columns->id), last);
        samples->case_index[row] = found;
        if (found == UINT32_MAX)
            continue;
        last = found;
        if (table_cell(table, row, columns->launch)[0] == '\0' &&
            is_named(samples, row, FM_METRIC_TOTAL_RMSE))
            of->cases[found].metric[FM_METRIC_TOTAL_RMSE] = samples->value[row];
    }
    return FM_OK;
}

fm_status sample_rows_read(fm_sample_rows *samples, const fm_table *table, const fm_case_list *of,
                           fm_error *err)
{
    sample_columns columns;
    *samples = (fm_sample_rows){ .table = table };
    if (table == NULL) {
        samples->first = calloc(of->count + 2, sizeof *samples->first);
        return samples->first != NULL ? FM_OK : fm_fail(err, FM_NO_MEMORY, "%zu cases", of->count);
    }
    fm_status status = find_columns(&columns, samples, err);
    if (status == FM_OK)
        status = reserve(samples, err);
    if (status == FM_OK)
        status = read_rows(samples, of, &columns, err);
    if (status == FM_OK)
        status = leave_out_off_clock(samples, err);
    if (status == FM_OK)
        status = index_by_case(samples, of->count, err);
    return status;
}

void sample_rows_free(fm_sample_rows *samples)
{
    free(samples->case_index);
    free(samples->value);
    free(samples->frame);
    free(samples->rows);
    free(samples->first);
    *samples = (fm_sample_rows){ 0 };
}
