#include "result_files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/path.h"
#include "base/text.h"

#define TEXT(name, field)                                                                          \
    {                                                                                              \
        name, offsetof(fm_case_row, field), true                                                   \
    }
#define NUMBER(field)                                                                              \
    {                                                                                              \
#field, offsetof(fm_case_row, field), false                                                \
    }

static const struct {
    const char *name;
    size_t offset;
    bool is_text;
} columns[] = {
    TEXT("case_id", id),
    TEXT("status", status),
    TEXT("message", message),
    TEXT("method", method),
    TEXT("feed", feed),
    TEXT("method_version", method_version),
    TEXT("device", device),
    TEXT("device_name", device_name),
    TEXT("scene", scene),
    TEXT("order", order),
    TEXT("seed", seed),
    TEXT("options", options),
    NUMBER(width_px),
    NUMBER(height_px),
    NUMBER(n),
    NUMBER(k),
    NUMBER(r),
    NUMBER(pixel_density),
    NUMBER(tessellation),
    NUMBER(fragment_probability),
    NUMBER(launches),
    NUMBER(samples),
    NUMBER(frame_ms),
    NUMBER(frame_ms_low),
    NUMBER(clear_ms),
    NUMBER(frame_ms_high),
    NUMBER(count_ms),
    NUMBER(reference_ms),
    NUMBER(store_ms),
    NUMBER(resolve_ms),
    NUMBER(times_floor),
    NUMBER(bytes_allocated),
    NUMBER(bytes_used),
    NUMBER(bytes_predicted),
    NUMBER(fragments_lost),
    NUMBER(fragments_generated),
    NUMBER(fragments_stored),
    NUMBER(missing),
    NUMBER(extra),
    NUMBER(misordered),
    NUMBER(depth_ulp_max),
    NUMBER(rmse),
    NUMBER(psnr_db),
    NUMBER(max_abs),
    NUMBER(ssim),
    NUMBER(flip),
    NUMBER(truncation_rmse),
    NUMBER(distinct_images),
    NUMBER(frame_wall_ms),
    NUMBER(fragments_per_s),
};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };

static fm_status need_column(size_t *column, const fm_table *table, const char *name, fm_error *err)
{
    *column = table_column(table, name);
    if (*column != FM_TABLE_NO_COLUMN)
        return FM_OK;
    const char *nearest = text_nearest(name, table->names, table->column_count);
    return fm_fail(err, FM_INVALID, "%s:1: no column \"%s\"%s%s%s", table->path, name,
                   nearest == NULL ? "" : " (there is \"", nearest == NULL ? "" : nearest,
                   nearest == NULL ? "" : "\")");
}

static fm_status check_case(const fm_result_files *results, size_t row, fm_error *err)
{
    fm_case_row *result = &results->cases[row];
    const char *path = results->summary->path;
    uint32_t line = results->summary->lines[row];
    if (!case_status_parse(&result->outcome, result->status))
        return fm_fail(err, FM_INVALID, "%s:%u: status \"%.40s\" is none of ok, not_supported, ...",
                       path, line, result->status);
    if (result->id[0] == '\0' || strlen(result->id) > 64 || strchr(result->id, '/') != NULL)
        return fm_fail(err, FM_INVALID, "%s:%u: case_id \"%.80s\" is not an id", path, line,
                       result->id);
    if (result->method[0] == '\0')
        return fm_fail(err, FM_INVALID, "%s:%u: no method", path, line);
    return FM_OK;
}

static void add_look(fm_case_row *result, const fm_provenance *manifest)
{
    const fm_method_info *info = provenance_method(manifest, result->method);
    const fm_device_info *device = provenance_device(manifest, result->device, result->device_name);
    if (info != NULL)
        result->look = *info;
    else
        result->look = (fm_method_info){
            .id = result->method, .title = result->method, .citation = "", .version = ""
        };
    result->is_ok = result->outcome == FM_CASE_OK;
    const bool is_timed = isfinite(result->frame_ms) && result->frame_ms > 0.0;
    result->is_simulated = strcmp(result->feed, "frames") == 0;
    result->is_measured = (result->is_ok || result->outcome == FM_CASE_WRONG_IMAGE) &&
                          (is_timed || result->is_simulated);
    /* manifest.json lists devices at the end of a run: until then nothing is claimed of a GPU. */
    result->is_software = device == NULL || device->is_software;
    result->total_rmse = result->rmse;
    if (result->k == 0.0)
        result->k = NAN; /* what methods that keep no k nearest are given */
}

static fm_status read_cases(fm_result_files *results, fm_error *err)
{
    const fm_table *table = results->summary;
    size_t index[COLUMN_COUNT];
    for (size_t i = 0; i < COLUMN_COUNT; i++) {
        fm_status status = need_column(&index[i], table, columns[i].name, err);
        if (status != FM_OK)
            return status;
    }
    results->cases = calloc(table->row_count + 1, sizeof *results->cases);
    if (results->cases == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu cases", table->path, table->row_count);
    for (size_t row = 0; row < table->row_count; row++) {
        char *result = (char *)&results->cases[row];
        for (size_t i = 0; i < COLUMN_COUNT; i++) {
            void *field = result + columns[i].offset;
            fm_status status = FM_OK;
            if (columns[i].is_text)
                *(const char **)field = table_cell(table, row, index[i]);
            else
                status = table_number(field, table, row, index[i], err);
            if (status != FM_OK)
                return status;
        }
        const fm_status status = check_case(results, row, err);
        if (status != FM_OK)
            return status;
        add_look(&results->cases[row], results->manifest);
    }
    results->count = table->row_count;
    return FM_OK;
}

static uint32_t find_case(const fm_result_files *results, const char *id, uint32_t guess)
{
    if (guess < results->count && strcmp(results->cases[guess].id, id) == 0)
        return guess; /* rows of a case follow one another */
    for (uint32_t i = 0; i < results->count; i++)
        if (strcmp(results->cases[i].id, id) == 0)
            return i;
    return UINT32_MAX; /* a case that has no row yet, of a run that was stopped */
}

/* Rows of samples.csv by case, in the file's order: a counting sort. */
static fm_status index_samples(fm_result_files *results, fm_error *err)
{
    const size_t row_count = results->samples->row_count;
    results->sample_first = calloc(results->count + 2, sizeof *results->sample_first);
    results->sample_rows = calloc(row_count + 1, sizeof *results->sample_rows);
    if (results->sample_first == NULL || results->sample_rows == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu rows", results->samples->path, row_count);
    size_t *first = results->sample_first;
    for (size_t row = 0; row < row_count; row++)
        if (results->sample_case[row] != UINT32_MAX)
            first[results->sample_case[row] + 2]++;
    for (size_t i = 1; i < results->count + 2; i++)
        first[i] += first[i - 1];
    for (size_t row = 0; row < row_count; row++)
        if (results->sample_case[row] != UINT32_MAX)
            results->sample_rows[first[results->sample_case[row] + 1]++] = (uint32_t)row;
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

/* Samples of frames that are marked off_clock count for nothing, as in summary.csv. */
static fm_status leave_out_off_clock(fm_result_files *results, fm_error *err)
{
    const fm_table *table = results->samples;
    size_t count = 0;
    frame_name *slow = calloc(table->row_count + 1, sizeof *slow);
    if (slow == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu rows", table->path, table->row_count);
    for (size_t row = 0; row < table->row_count; row++)
        if (strcmp(table_cell(table, row, results->sample_metric), "off_clock") == 0)
            slow[count++] = (frame_name){ results->sample_frame[row], results->sample_case[row] };
    qsort(slow, count, sizeof *slow, compare_frames);
    for (size_t row = 0; row < table->row_count && count > 0; row++) {
        const frame_name own = { results->sample_frame[row], results->sample_case[row] };
        if (bsearch(&own, slow, count, sizeof *slow, compare_frames) != NULL)
            results->sample_case[row] = UINT32_MAX;
    }
    free(slow);
    return FM_OK;
}

/* Launch and frame as one number; empty cells: the case as a whole. */
static fm_status read_frame(uint64_t *frame, const fm_table *table, size_t row, size_t launch,
                            size_t frame_column, fm_error *err)
{
    double of_launch, of_frame;
    fm_status status = table_number(&of_launch, table, row, launch, err);
    if (status == FM_OK)
        status = table_number(&of_frame, table, row, frame_column, err);
    if (status != FM_OK)
        return status;
    const bool is_frame = of_launch >= 0.0 && of_launch < 1e6 && of_frame >= 0.0 && of_frame < 1e9;
    *frame = is_frame ? (uint64_t)of_launch << 32 | (uint64_t)of_frame : FM_SAMPLE_OF_CASE;
    return FM_OK;
}

static fm_status read_samples(fm_result_files *results, fm_error *err)
{
    const fm_table *table = results->samples;
    size_t id = 0, launch = 0, frame = 0, value = 0;
    fm_status status = need_column(&id, table, "case_id", err);
    if (status == FM_OK)
        status = need_column(&launch, table, "launch", err);
    if (status == FM_OK)
        status = need_column(&frame, table, "frame", err);
    if (status == FM_OK)
        status = need_column(&results->sample_metric, table, "metric", err);
    if (status == FM_OK)
        status = need_column(&value, table, "value", err);
    if (status != FM_OK)
        return status;
    results->sample_case = calloc(table->row_count + 1, sizeof *results->sample_case);
    results->sample_value = calloc(table->row_count + 1, sizeof *results->sample_value);
    results->sample_frame = calloc(table->row_count + 1, sizeof *results->sample_frame);
    if (results->sample_case == NULL || results->sample_value == NULL ||
        results->sample_frame == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu rows", table->path, table->row_count);
    uint32_t at = 0;
    for (size_t row = 0; row < table->row_count; row++) {
        status = table_number(&results->sample_value[row], table, row, value, err);
        if (status == FM_OK)
            status = read_frame(&results->sample_frame[row], table, row, launch, frame, err);
        if (status != FM_OK)
            return status;
        uint32_t found = find_case(results, table_cell(table, row, id), at);
        results->sample_case[row] = found;
        if (found == UINT32_MAX)
            continue;
        at = found;
        if (table_cell(table, row, launch)[0] == '\0' &&
            strcmp(table_cell(table, row, results->sample_metric), "total_rmse") == 0)
            results->cases[found].total_rmse = results->sample_value[row];
    }
    status = leave_out_off_clock(results, err);
    return status == FM_OK ? index_samples(results, err) : status;
}

static fm_status read_table(fm_table **table, const char *directory, const char *name,
                            fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    const fm_status status = path_join(path, directory, name, err);
    return status != FM_OK ? status : table_read(table, path, err);
}

/* *table is NULL where the run has no such file. */
static fm_status read_optional(fm_table **table, const char *directory, const char *name,
                               fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    const fm_status status = path_join(path, directory, name, err);
    *table = NULL;
    return status != FM_OK || access(path, F_OK) != 0 ? status : table_read(table, path, err);
}

uint64_t result_files_figure(const fm_result_files *results, const char *id)
{
    for (size_t i = 0; i < results->figure_count; i++)
        if (strcmp(results->figure_names[i], id) == 0)
            return (uint64_t)1 << i;
    return 0;
}

static fm_status read_figures(fm_result_files *results, fm_error *err)
{
    size_t figure = 0, id = 0;
    fm_status status = read_optional(&results->figures, results->directory, "figures.csv", err);
    if (status != FM_OK || results->figures == NULL)
        return status;
    status = need_column(&figure, results->figures, "figure", err);
    if (status == FM_OK)
        status = need_column(&id, results->figures, "case_id", err);
    for (size_t row = 0; status == FM_OK && row < results->figures->row_count; row++) {
        const char *name = table_cell(results->figures, row, figure);
        if (result_files_figure(results, name) == 0 && results->figure_count < FM_RESULT_FIGURES)
            results->figure_names[results->figure_count++] = name;
        const uint32_t found =
            find_case(results, table_cell(results->figures, row, id), (uint32_t)row);
        if (found != UINT32_MAX)
            results->cases[found].figures |= result_files_figure(results, name);
    }
    return status;
}

static fm_status read_memory(fm_result_files *results, fm_error *err)
{
    size_t column;
    fm_status status = read_optional(&results->memory, results->directory, "memory.csv", err);
    if (status != FM_OK || results->memory == NULL)
        return status;
    status = need_column(&column, results->memory, "figure", err);
    if (status == FM_OK)
        status = need_column(&column, results->memory, "workload", err);
    return status;
}

fm_status result_files_read(fm_result_files **results, const char *directory, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    *results = NULL;
    fm_result_files *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s", directory);
    made->directory = directory;
    fm_status status = path_join(path, directory, "manifest.json", err);
    if (status == FM_OK)
        status = provenance_read(&made->manifest, path, err);
    if (status == FM_OK)
        status = read_table(&made->summary, directory, "summary.csv", err);
    if (status == FM_OK)
        status = read_table(&made->samples, directory, "samples.csv", err);
    if (status == FM_OK)
        status = read_cases(made, err);
    if (status == FM_OK)
        status = read_samples(made, err);
    if (status == FM_OK)
        status = read_figures(made, err);
    if (status == FM_OK)
        status = read_memory(made, err);
    if (status != FM_OK) {
        result_files_close(made);
        return status;
    }
    *results = made;
    return FM_OK;
}

void result_files_close(fm_result_files *results)
{
    if (results == NULL)
        return;
    free(results->sample_case);
    free(results->sample_value);
    free(results->sample_frame);
    free(results->sample_rows);
    free(results->sample_first);
    free(results->cases);
    table_close(results->memory);
    table_close(results->figures);
    table_close(results->samples);
    table_close(results->summary);
    provenance_close(results->manifest);
    free(results);
}

bool result_files_number(double *value, const fm_case_row *result, const char *name)
{
    for (size_t i = 0; i < COLUMN_COUNT; i++) {
        if (columns[i].is_text || strcmp(columns[i].name, name) != 0)
            continue;
        *value = *(const double *)(const void *)((const char *)result + columns[i].offset);
        return true;
    }
    return false;
}
