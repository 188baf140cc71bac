#include "result_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/path.h"
#include "missing.h"

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

static fm_status know_figure(fm_result_files *results, const char *name, size_t row, fm_error *err)
{
    if (result_files_figure(results, name) != 0)
        return FM_OK;
    if (results->figure_count == FM_RESULT_FIGURES)
        return fm_fail(err, FM_INVALID, "%s:%u: more than %d figures", results->figures->path,
                       results->figures->lines[row], FM_RESULT_FIGURES);
    results->figure_names[results->figure_count++] = name;
    return FM_OK;
}

static fm_status read_figures(fm_result_files *results, fm_error *err)
{
    size_t figure = 0, id = 0;
    fm_status status = read_optional(&results->figures, results->directory, "figures.csv", err);
    if (status != FM_OK || results->figures == NULL)
        return status;
    status = table_need_column(&figure, results->figures, "figure", err);
    if (status == FM_OK)
        status = table_need_column(&id, results->figures, "case_id", err);
    for (size_t row = 0; status == FM_OK && row < results->figures->row_count; row++) {
        const char *name = table_cell(results->figures, row, figure);
        status = know_figure(results, name, row, err);
        const size_t found = text_index_find(&results->ids, table_cell(results->figures, row, id));
        if (found != FM_TEXT_INDEX_NONE)
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
    status = table_need_column(&column, results->memory, "figure", err);
    if (status == FM_OK)
        status = table_need_column(&column, results->memory, "workload", err);
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
        status = read_optional(&made->sample_table, directory, "samples.csv", err);
    if (status == FM_OK)
        status = cases_read(&made->cases, &made->ids, made->summary, made->manifest, err);
    if (status == FM_OK) {
        made->count = made->summary->row_count;
        const fm_case_list list = { made->cases, made->count, &made->ids };
        status = sample_rows_read(&made->samples, made->sample_table, &list, err);
    }
    if (status == FM_OK)
        status = missing_find(&made->missing, made, err);
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
    sample_rows_free(&results->samples);
    text_list_free(&results->missing);
    text_index_free(&results->ids);
    free(results->cases);
    table_close(results->memory);
    table_close(results->figures);
    table_close(results->sample_table);
    table_close(results->summary);
    provenance_close(results->manifest);
    free(results);
}
