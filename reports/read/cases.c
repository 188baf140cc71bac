#include "cases.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "cell_range.h"
#include "options.h"

/* Where the texts and keys of a row are kept; its metrics are an array. */
static const size_t fact_at[FM_FACT_COUNT] = {
    [FM_FACT_SCHEMA] = SIZE_MAX, /* not kept */
    [FM_FACT_CASE_ID] = offsetof(fm_case_row, id),
    [FM_FACT_STATUS] = offsetof(fm_case_row, status),
    [FM_FACT_MESSAGE] = offsetof(fm_case_row, message),
    [FM_FACT_METHOD] = offsetof(fm_case_row, method),
    [FM_FACT_METHOD_VERSION] = offsetof(fm_case_row, method_version),
    [FM_FACT_DEVICE] = offsetof(fm_case_row, device),
    [FM_FACT_DEVICE_NAME] = offsetof(fm_case_row, device_name),
    [FM_FACT_FEED] = offsetof(fm_case_row, feed),
    [FM_FACT_SCENE] = offsetof(fm_case_row, scene),
    [FM_FACT_OPTIONS] = offsetof(fm_case_row, options),
    [FM_FACT_NOISY] = offsetof(fm_case_row, noisy),
    [FM_FACT_CODE_PROGRAM] = offsetof(fm_case_row, code_program),
    [FM_FACT_CODE_DRIVER] = offsetof(fm_case_row, code_driver),
    [FM_FACT_CODE_PLUGIN] = offsetof(fm_case_row, code_plugin),
    [FM_FACT_CODE_SHADERS] = offsetof(fm_case_row, code_shaders),
    [FM_FACT_REASON] = offsetof(fm_case_row, reason),
    [FM_FACT_LIMITED_BY] = offsetof(fm_case_row, limited_by),
};

#define KEY(field, text)                                                                           \
    {                                                                                              \
#field, offsetof(fm_case_row, field), text                                                 \
    }

static const struct {
    const char *name;
    size_t at;
    bool is_text;
} keys[] = {
    KEY(width_px, false),
    KEY(height_px, false),
    KEY(k, false),
    KEY(r, false),
    KEY(pixel_density, false),
    KEY(fragment_probability, false),
    KEY(tessellation, false),
    KEY(order, true),
    KEY(seed, true),
};
enum { KEY_COUNT = sizeof keys / sizeof keys[0] };

/* A fact that has no row would lie on the id. */
static bool fact_is_kept(fm_fact fact)
{
    return fact_at[fact] != SIZE_MAX && (fact_at[fact] != 0 || fact == FM_FACT_CASE_ID);
}

static size_t key_index(const char *name)
{
    size_t i = 0;
    while (i < KEY_COUNT && strcmp(keys[i].name, name) != 0)
        i++;
    return i;
}

/* Rows of older runs have none. */
static fm_status check_reason(const fm_case_row *result, const fm_table *table, size_t row,
                              fm_error *err)
{
    const char *path = table->path, *nearest;
    const uint32_t line = table->lines[row];
    fm_reason reason;
    if (!case_reason_parse(&reason, result->reason, &nearest))
        return fm_fail(err, FM_INVALID, "%s:%u: reason \"%.40s\" is unknown; the nearest is \"%s\"",
                       path, line, result->reason,
                       nearest != NULL ? nearest : case_reason_name(FM_REASON_FEED));
    if (reason != FM_REASON_NONE && result->outcome != FM_CASE_NOT_SUPPORTED)
        return fm_fail(err, FM_INVALID, "%s:%u: reason \"%s\" of a case that is %s", path, line,
                       result->reason, result->status);
    return FM_OK;
}

static fm_status check(fm_case_row *result, const fm_table *table, size_t row, fm_error *err)
{
    const char *path = table->path;
    const uint32_t line = table->lines[row];
    if (!case_status_parse(&result->outcome, result->status))
        return fm_fail(err, FM_INVALID, "%s:%u: status \"%.40s\" is none of ok, not_supported, ...",
                       path, line, result->status);
    if (result->id[0] == '\0' || strlen(result->id) > 64 || strchr(result->id, '/') != NULL)
        return fm_fail(err, FM_INVALID, "%s:%u: case_id \"%.80s\" is not an id", path, line,
                       result->id);
    if (result->method[0] == '\0')
        return fm_fail(err, FM_INVALID, "%s:%u: no method", path, line);
    return check_reason(result, table, row, err);
}

static fm_status check_share(double share, const char *name, const fm_table *table, size_t row,
                             fm_error *err)
{
    return isnan(share) || share <= 1.0
               ? FM_OK
               : fm_fail(err, FM_INVALID, "%s:%u: %s: %g: a share is at most 1", table->path,
                         table->lines[row], name, share);
}

/* What the cells say together. */
static fm_status check_numbers(const fm_case_row *result, const fm_table *table, size_t row,
                               fm_error *err)
{
    fm_status status = check_share(result->pixel_density, "pixel_density", table, row, err);
    if (status == FM_OK)
        status = check_share(result->fragment_probability, "fragment_probability", table, row, err);
    for (size_t i = 0; i < FM_METRIC_COUNT && status == FM_OK; i++)
        if (result->low[i] > result->high[i])
            status = fm_fail(err, FM_INVALID, "%s:%u: %s_low: %g is above %s_high, %g", table->path,
                             table->lines[row], fm_metrics[i].name, result->low[i],
                             fm_metrics[i].name, result->high[i]);
    return status;
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
    const bool is_timed =
        isfinite(result->metric[FM_METRIC_FRAME_MS]) && result->metric[FM_METRIC_FRAME_MS] > 0.0;
    result->is_simulated = strcmp(result->feed, "frames") == 0;
    result->is_measured = (result->is_ok || result->outcome == FM_CASE_WRONG_IMAGE) &&
                          (is_timed || result->is_simulated);
    /* manifest.json lists devices at the end of a run: until then nothing is claimed of a GPU. */
    result->is_software = device == NULL || device->is_software;
    result->is_device_known = device != NULL;
    if (isnan(result->metric[FM_METRIC_TOTAL_RMSE]) &&
        !(result->metric[FM_METRIC_TRUNCATION_RMSE] > 0.0))
        result->metric[FM_METRIC_TOTAL_RMSE] = result->metric[FM_METRIC_RMSE];
    if (result->k == 0.0)
        result->k = NAN; /* what methods that keep no k nearest are given */
}

static fm_status read_text(fm_case_row *result, size_t at, const char *text)
{
    *(const char **)(void *)((char *)result + at) = text;
    return FM_OK;
}

/* One cell, by what its column is. */
static fm_status read_cell(fm_case_row *result, const fm_column *column, const fm_table *table,
                           size_t row, size_t index, fm_error *err)
{
    const char *text = table_cell(table, row, index);
    size_t key;
    switch (column->kind) {
    case FM_COLUMN_FACT:
        return fact_is_kept(column->fact) ? read_text(result, fact_at[column->fact], text) : FM_OK;
    case FM_COLUMN_METRIC:
        return table_in_range(&result->metric[column->metric], fm_metrics[column->metric].range,
                              table, row, index, err);
    case FM_COLUMN_LOW:
        return table_number(&result->low[column->metric], table, row, index, err);
    case FM_COLUMN_HIGH:
        return table_number(&result->high[column->metric], table, row, index, err);
    case FM_COLUMN_KEY:
        break;
    }
    key = key_index(column->name);
    if (key == KEY_COUNT)
        return FM_OK;
    return keys[key].is_text ? read_text(result, keys[key].at, text)
                             : table_in_range((double *)(void *)((char *)result + keys[key].at),
                                              FM_RANGE_AMOUNT, table, row, index, err);
}

/* index: where each of fm_columns is in the table. */
static fm_status read_cells(fm_case_row *result, const fm_table *table, size_t row,
                            const size_t index[FM_COLUMN_COUNT], fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < FM_METRIC_COUNT; i++)
        result->metric[i] = result->low[i] = result->high[i] = NAN;
    for (size_t i = 0; i < FM_COLUMN_COUNT && status == FM_OK; i++)
        status = read_cell(result, &fm_columns[i], table, row, index[i], err);
    /* Ends of one launch are of its frames: files of before have such. */
    for (size_t i = 0; i < FM_METRIC_COUNT && !(result->metric[FM_METRIC_LAUNCHES] > 1); i++)
        result->low[i] = result->high[i] = NAN;
    return status;
}

/* Columns of newer programs stand behind all that are known; others are no part of the file. */
static fm_status check_columns(const fm_table *table, fm_error *err)
{
    size_t known = table->column_count;
    while (known > 0 && !summary_has_column(table->names[known - 1]))
        known--;
    for (size_t i = 0; i < known; i++) {
        if (summary_has_column(table->names[i]))
            continue;
        const char *names[FM_COLUMN_COUNT];
        for (size_t j = 0; j < FM_COLUMN_COUNT; j++)
            names[j] = column_name(&fm_columns[j]);
        const char *nearest = text_nearest(table->names[i], names, FM_COLUMN_COUNT);
        return fm_fail(err, FM_INVALID, "%s:1: column \"%.80s\" is unknown%s%s%s", table->path,
                       table->names[i], nearest == NULL ? "" : "; the nearest is \"",
                       nearest == NULL ? "" : nearest, nearest == NULL ? "" : "\"");
    }
    return FM_OK;
}

static fm_status index_id(fm_text_index *ids, const char *id, const fm_table *table, size_t row,
                          fm_error *err)
{
    const size_t first = text_index_add(ids, id, row);
    if (first == FM_TEXT_INDEX_NONE)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu cases", table->path, table->row_count);
    if (first != row)
        return fm_fail(err, FM_INVALID, "%s:%u: case_id: \"%.64s\" has a row already, in line %u",
                       table->path, table->lines[row], id, table->lines[first]);
    return FM_OK;
}

fm_status cases_read(fm_case_row **cases, fm_text_index *ids, const fm_table *table,
                     const fm_provenance *manifest, fm_error *err)
{
    size_t index[FM_COLUMN_COUNT];
    *cases = NULL;
    fm_status status = table_check_schema(table, FM_SUMMARY_SCHEMA, err);
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++)
        index[i] =
            table_column(table, column_name(&fm_columns[i])); /* a later one may be missing */
    for (size_t i = 0; i < FM_COLUMN_REQUIRED && status == FM_OK; i++)
        status = table_need_column(&index[i], table, column_name(&fm_columns[i]), err);
    if (status == FM_OK)
        status = check_columns(table, err);
    if (status != FM_OK)
        return status;
    fm_case_row *made = calloc(table->row_count + 1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu cases", table->path, table->row_count);
    for (size_t row = 0; row < table->row_count && status == FM_OK; row++) {
        status = read_cells(&made[row], table, row, index, err);
        if (status == FM_OK)
            status = check(&made[row], table, row, err);
        if (status == FM_OK)
            status = check_numbers(&made[row], table, row, err);
        if (status == FM_OK)
            status = index_id(ids, made[row].id, table, row, err);
        if (status == FM_OK)
            add_look(&made[row], manifest);
    }
    if (status != FM_OK) {
        free(made);
        return status;
    }
    *cases = made;
    return FM_OK;
}

double case_brightness(const fm_case_row *result)
{
    char text[FM_OPTION_VALUE_BYTES];
    double exposure = 0;
    options_value(text, result->options, "exposure");
    return text_to_double(&exposure, text) ? fmax(1, exp2(exposure)) : 1;
}

/* The number in a column that is not a key's; NULL: there is no such column. */
static const double *number_of(const fm_case_row *result, const char *name)
{
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++) {
        const fm_column *column = &fm_columns[i];
        if (strcmp(column_name(column), name) != 0)
            continue;
        switch (column->kind) {
        case FM_COLUMN_METRIC:
            return &result->metric[column->metric];
        case FM_COLUMN_LOW:
            return &result->low[column->metric];
        case FM_COLUMN_HIGH:
            return &result->high[column->metric];
        case FM_COLUMN_FACT:
        case FM_COLUMN_KEY:
            break;
        }
    }
    return NULL;
}

bool case_number(double *value, const fm_case_row *result, const char *name)
{
    const size_t key = key_index(name);
    const double *number = number_of(result, name);
    if (key < KEY_COUNT && !keys[key].is_text)
        memcpy(value, (const char *)result + keys[key].at, sizeof *value);
    else if (number != NULL)
        *value = *number;
    return number != NULL || (key < KEY_COUNT && !keys[key].is_text);
}
