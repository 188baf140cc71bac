#include "cases.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

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

/* The cells of one row; index: where each of `columns` is in the table. */
static fm_status read_cells(fm_case_row *result, const fm_table *table, size_t row,
                            const size_t index[COLUMN_COUNT], fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < COLUMN_COUNT && status == FM_OK; i++) {
        void *field = (char *)result + columns[i].offset;
        if (columns[i].is_text)
            *(const char **)field = table_cell(table, row, index[i]);
        else
            status = table_number(field, table, row, index[i], err);
    }
    return status;
}

fm_status cases_read(fm_case_row **cases, const fm_table *table, const fm_provenance *manifest,
                     fm_error *err)
{
    size_t index[COLUMN_COUNT];
    fm_status status = FM_OK;
    *cases = NULL;
    for (size_t i = 0; i < COLUMN_COUNT && status == FM_OK; i++)
        status = table_need_column(&index[i], table, columns[i].name, err);
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
            add_look(&made[row], manifest);
    }
    if (status != FM_OK) {
        free(made);
        return status;
    }
    *cases = made;
    return FM_OK;
}

uint32_t cases_find(const fm_case_row *cases, size_t count, const char *id, uint32_t guess)
{
    if (guess < count && strcmp(cases[guess].id, id) == 0)
        return guess;
    for (uint32_t i = 0; i < count; i++)
        if (strcmp(cases[i].id, id) == 0)
            return i;
    return UINT32_MAX;
}

bool case_number(double *value, const fm_case_row *result, const char *name)
{
    for (size_t i = 0; i < COLUMN_COUNT; i++) {
        if (columns[i].is_text || strcmp(columns[i].name, name) != 0)
            continue;
        *value = *(const double *)(const void *)((const char *)result + columns[i].offset);
        return true;
    }
    return false;
}
