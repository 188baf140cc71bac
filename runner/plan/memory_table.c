#include "memory_table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/csv.h"
#include "base/yaml_fields.h"
#include "model/descriptor.h"
#include "model/figure_file.h"
#include "model/formula.h"

static const double mib = 1048576.0;

/* What the functions below share. */
typedef struct table_job {
    fm_yaml_place at; /* the figure's file */
    const char *figure;
    const fm_yaml *columns, *rows;
    double added_per_pixel;
    fm_text *csv;
    fm_memory_verdicts *verdicts;
} table_job;

static const char *default_option(const fm_workload *workload, const char *name)
{
    const fm_method_desc *method = workload->runner;
    for (int i = 0; i < FM_MAX_OPTIONS && method->options[i].name != NULL; i++)
        if (strcmp(method->options[i].name, name) == 0)
            return method->options[i].values[0];
    return NULL;
}

/* The workload of a column, but for its totals. */
static fm_status read_workload(fm_workload *workload, const fm_yaml *column, const table_job *job)
{
    uint64_t width = 0, height = 0, k = 0, n = 0;
    fm_status status = field_whole(&width, column, "width_px", 65536, &job->at);
    if (status == FM_OK)
        status = field_whole(&height, column, "height_px", 65536, &job->at);
    if (status == FM_OK)
        status = field_whole(&k, column, "k", 4096, &job->at);
    if (status == FM_OK)
        status = field_whole(&n, column, "n", 65536, &job->at);
    if (status == FM_OK)
        status = field_whole(&workload->fragments, column, "fragments", UINT64_MAX / 2, &job->at);
    workload->width_px = (uint32_t)width;
    workload->height_px = (uint32_t)height;
    workload->k = (uint32_t)k;
    workload->n = (uint32_t)n;
    return status;
}

/* Totals that size a buffer are all fragments, unless the column has them by name. */
static fm_status read_totals(uint64_t totals[FM_MAX_TOTALS], const fm_yaml *column,
                             const fm_workload *workload, const table_job *job)
{
    fm_status status = FM_OK;
    const fm_method_desc *method = workload->runner;
    const fm_yaml *named = yaml_tree_find(column, "totals");
    for (size_t i = 0; i < FM_MAX_TOTALS && status == FM_OK; i++) {
        const char *name = method->totals[i].name;
        totals[i] = workload->fragments;
        if (name != NULL && named != NULL && yaml_tree_find(named, name) != NULL)
            status = field_whole(&totals[i], named, name, UINT64_MAX / 2, &job->at);
    }
    return status;
}

static bool list_has(const fm_yaml *list, const char *text)
{
    for (size_t i = 0; list != NULL && i < list->count; i++)
        if (list->items[i].text != NULL && strcmp(list->items[i].text, text) == 0)
            return true;
    return false;
}

/* Ours with as many decimals as the printed value has. */
static void print_alike(char text[32], double value, const char *printed)
{
    const char *point = strchr(printed, '.');
    const size_t decimals = point != NULL ? strlen(point + 1) : 0;
    snprintf(text, 32, "%.*f", decimals < 9 ? (int)decimals : 9, value);
}

static const char *judge(fm_memory_verdicts *verdicts, double value, const char *printed,
                         bool is_known_error)
{
    char alike[32];
    print_alike(alike, value, printed);
    if (printed[0] == '\0')
        return "not printed";
    if (strcmp(alike, printed) == 0) {
        verdicts->exact++;
        return "exact";
    }
    if (is_known_error) {
        verdicts->errata++;
        return "erratum of the paper";
    }
    verdicts->differs++;
    return "differs";
}

/* A row of the paper's table, and the method that it is about. */
typedef struct table_row {
    const fm_method_desc *method;
    const char *title, *why;
    const fm_yaml *printed, *errata;
    double added_per_pixel, added_per_pixel_k;
} table_row;

static fm_status add_cell(const table_job *job, const table_row *row, size_t index)
{
    uint64_t totals[FM_MAX_TOTALS];
    fm_method_desc chosen;
    fm_workload workload = { .totals = totals, .option = default_option, .runner = row->method };
    const char *title;
    double value = NAN;
    const fm_yaml *column = &job->columns->items[index];
    const fm_yaml *printed = &row->printed->items[index];
    fm_status status = field_text(&title, column, "title", true, &job->at);
    if (status == FM_OK)
        status = read_workload(&workload, column, job);
    if (status == FM_OK)
        status = read_totals(totals, column, &workload, job);
    if (status != FM_OK)
        return status;
    if (printed->kind != FM_YAML_SCALAR ||
        (printed->text[0] != '\0' && !text_to_double(&value, printed->text)))
        return fm_fail(job->at.err, FM_INVALID, "%s:%u: 'printed': numbers are expected",
                       job->at.path, printed->line);
    const double pixels = (double)workload.width_px * workload.height_px;
    const double added =
        job->added_per_pixel + row->added_per_pixel + row->added_per_pixel_k * (double)workload.k;
    method_choose(&chosen, row->method, NULL, 0); /* as its options are by default */
    const double ours = (double)formula_bytes(&chosen, &workload) + added * pixels;
    const char *verdict =
        judge(job->verdicts, ours / mib, printed->text, list_has(row->errata, printed->text));
    csv_add(job->csv, job->figure);
    text_add(job->csv, ",");
    csv_add(job->csv, title);
    text_add(job->csv, ",%s,", row->method->id);
    csv_add(job->csv, row->title);
    text_add(job->csv, ",%.0f,%.4f,%s,", ours, ours / mib, printed->text);
    if (printed->text[0] != '\0')
        text_add(job->csv, "%.4f", ours / mib - value);
    text_add(job->csv, ",%s,", verdict);
    csv_add(job->csv, row->why);
    text_add(job->csv, "\n");
    return FM_OK;
}

static fm_status add_row(const table_job *job, const fm_yaml *from, const fm_plugin_list *plugins)
{
    const char *id;
    fm_plugin_entry *entry = NULL;
    table_row row = { .errata = yaml_tree_find(from, "errata") };
    fm_status status = field_text(&id, from, "method", true, &job->at);
    if (status == FM_OK)
        status = plugin_list_get(&entry, plugins, id, job->at.err);
    if (status == FM_OK)
        status = plugin_list_read(plugins, &entry, 1, job->at.err);
    if (status == FM_OK && entry->plugin == NULL)
        status = fm_fail(job->at.err, entry->error.status, "%s", entry->error.message);
    if (status == FM_OK)
        status = field_text(&row.title, from, "title", true, &job->at);
    if (status == FM_OK)
        status = field_text(&row.why, from, "why", false, &job->at);
    if (status == FM_OK)
        status = field_number(&row.added_per_pixel, from, "added_per_pixel", &job->at);
    if (status == FM_OK)
        status = field_number(&row.added_per_pixel_k, from, "added_per_pixel_k", &job->at);
    if (status == FM_OK)
        status = field_items(&row.printed, from, "printed", &job->at);
    if (status == FM_OK && row.printed->count != job->columns->count)
        status = fm_fail(job->at.err, FM_INVALID, "%s:%u: 'printed': one value for each column",
                         job->at.path, row.printed->line);
    if (status != FM_OK)
        return status;
    row.method = entry->plugin->method;
    for (size_t i = 0; i < job->columns->count && status == FM_OK; i++)
        status = add_cell(job, &row, i);
    return status;
}

fm_status memory_table_is_in(bool *has, const char *path, fm_error *err)
{
    fm_figure_file file;
    const fm_status status = figure_file_read(&file, path, err);
    *has = status == FM_OK && file.table != NULL;
    figure_file_close(&file);
    return status;
}

fm_status memory_table_make(fm_text *csv, fm_memory_verdicts *verdicts, const char *path,
                            const char *figure, const fm_plugin_list *plugins, fm_error *err)
{
    fm_figure_file file;
    table_job job = {
        .at = { .path = path, .err = err }, .figure = figure, .csv = csv, .verdicts = verdicts
    };
    fm_status status = figure_file_read(&file, path, err);
    const fm_yaml *table = file.table;
    if (status == FM_OK && (table == NULL || table->kind != FM_YAML_MAP))
        status = fm_fail(err, FM_INVALID, "%s: 'table': a mapping is expected", path);
    if (status == FM_OK)
        status = field_number(&job.added_per_pixel, table, "added_per_pixel", &job.at);
    if (status == FM_OK)
        status = field_items(&job.columns, table, "columns", &job.at);
    if (status == FM_OK)
        status = field_items(&job.rows, table, "rows", &job.at);
    if (status == FM_OK && csv->length == 0)
        text_add(csv,
                 "figure,workload,method,title,bytes,mib,printed,difference_mib,verdict,why\n");
    for (size_t i = 0; status == FM_OK && i < job.rows->count; i++)
        status = add_row(&job, &job.rows->items[i], plugins);
    if (status == FM_OK && csv->failed)
        status = fm_fail(err, FM_NO_MEMORY, "%s: no memory", path);
    figure_file_close(&file);
    return status;
}
