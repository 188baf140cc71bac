#include "shard_folder.h"

#include <stdlib.h>
#include <string.h>

#include "bundle/items_json.h"
#include "model/columns.h"
#include "model/outcome.h"

/* Columns of shard.csv, as plan/shard.c writes them. */
enum { CASE_ID, CASE_SHARD, CASE_REFERENCE, CASE_COLUMNS };
static const char *const case_columns[CASE_COLUMNS] = { "case_id", "shard", "is_reference" };

static bool is_hash(const char *text)
{
    return strlen(text) == 16 && strspn(text, "0123456789abcdef") == 16;
}

static fm_status read_shard(shard_folder *folder, bool *is_damaged, fm_error *err)
{
    json_int_t index = 0, count = 0;
    const json_t *shard = json_object_get(folder->manifest, "shard");
    if (json_object_get(folder->manifest, "merged") != NULL)
        return fm_fail(err, FM_INVALID, "%s: is merged already; name the folders of the shards",
                       folder->path);
    if (shard == NULL)
        return fm_fail(err, FM_INVALID, "%s: is a whole run, and no shard of one (`run --shard`)",
                       folder->path);
    *is_damaged = true;
    folder->run_id = json_string_value(json_object_get(folder->manifest, "run_id"));
    if (json_unpack((json_t *)(uintptr_t)shard, "{s:I, s:I, s:s}", "index", &index, "count", &count,
                    "plan", &folder->plan) != 0 ||
        count < 1 || count > FM_SHARDS_MAX || index < 1 || index > count ||
        !is_hash(folder->plan) || folder->run_id == NULL || !is_hash(folder->run_id))
        return fm_fail(err, FM_INVALID,
                       "%s/manifest.json: damaged: index, count and plan of its shard, and run_id, "
                       "cannot be",
                       folder->path);
    folder->index = (uint32_t)index;
    folder->count = (uint32_t)count;
    *is_damaged = false;
    return FM_OK;
}

static fm_status read_table(fm_table **table, const char *directory, const char *name,
                            fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    const fm_status status = path_join(path, directory, name, err);
    return status == FM_OK ? table_read(table, path, err) : status;
}

static fm_status read_case(shard_folder *folder, size_t row, fm_error *err)
{
    uint64_t shard = 0;
    const fm_table *cases = folder->cases;
    const char *reference = table_cell(cases, row, CASE_REFERENCE);
    if (is_hash(table_cell(cases, row, CASE_ID)) &&
        text_to_u64(&shard, table_cell(cases, row, CASE_SHARD)) && shard >= 1 &&
        shard <= folder->count && (strcmp(reference, "0") == 0 || strcmp(reference, "1") == 0)) {
        folder->shard_of[row] = (uint32_t)shard;
        return FM_OK;
    }
    return fm_fail(err, FM_INVALID, "%s:%u: a case's id, its shard of %u, and 0 or 1 are expected",
                   cases->path, cases->lines[row], folder->count);
}

static fm_status read_cases(shard_folder *folder, fm_error *err)
{
    fm_status status = read_table(&folder->cases, folder->path, FM_SHARD_TABLE, err);
    if (status != FM_OK)
        return status;
    if (folder->cases->column_count != CASE_COLUMNS)
        return fm_fail(err, FM_INVALID, "%s:1: %d columns are expected", folder->cases->path,
                       CASE_COLUMNS);
    for (size_t i = 0; i < CASE_COLUMNS; i++)
        if (strcmp(folder->cases->names[i], case_columns[i]) != 0)
            return fm_fail(err, FM_INVALID, "%s:1: column \"%s\" is expected", folder->cases->path,
                           case_columns[i]);
    folder->shard_of = calloc(folder->cases->row_count + 1, sizeof *folder->shard_of);
    if (folder->shard_of == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory", folder->cases->path);
    for (size_t row = 0; row < folder->cases->row_count && status == FM_OK; row++)
        status = read_case(folder, row, err);
    return status;
}

static fm_status read_summary(shard_folder *folder, fm_error *err)
{
    fm_case_status known;
    fm_status status = read_table(&folder->summary, folder->path, "summary.csv", err);
    if (status == FM_OK)
        status = table_check_schema(folder->summary, FM_SUMMARY_SCHEMA, err);
    if (status == FM_OK)
        status = table_need_column(&folder->case_id, folder->summary, "case_id", err);
    if (status == FM_OK)
        status = table_need_column(&folder->status, folder->summary, "status", err);
    for (size_t row = 0; status == FM_OK && row < folder->summary->row_count; row++)
        if (!case_status_parse(&known, table_cell(folder->summary, row, folder->status)))
            status = fm_fail(err, FM_INVALID, "%s:%u: status: \"%.40s\" is none",
                             folder->summary->path, folder->summary->lines[row],
                             table_cell(folder->summary, row, folder->status));
    return status;
}

fm_status shard_folder_open(shard_folder *folder, const char *path, bool *is_damaged, fm_error *err)
{
    *folder = (shard_folder){ .path = path };
    *is_damaged = false;
    fm_status status = path_is_folder(path, err);
    if (status != FM_OK) {
        if (err != NULL)
            err->status = FM_INVALID;
        return FM_INVALID;
    }
    status = json_read_object(&folder->manifest, path, "manifest.json", err);
    *is_damaged = status != FM_OK && status != FM_NO_MEMORY;
    if (*is_damaged)
        fm_error_prefix(err, "no folder of a shard's results");
    if (status == FM_OK)
        status = read_shard(folder, is_damaged, err);
    if (status != FM_OK)
        return status;
    status = read_cases(folder, err);
    if (status == FM_OK)
        status = read_summary(folder, err);
    *is_damaged = status != FM_OK && status != FM_NO_MEMORY;
    return status;
}

void shard_folder_close(shard_folder *folder)
{
    table_close(folder->cases);
    table_close(folder->summary);
    json_decref(folder->manifest);
    free(folder->case_of);
    free(folder->shard_of);
    *folder = (shard_folder){ 0 };
}

bool shard_case_is_reference(const shard_folder *folder, size_t index)
{
    return table_cell(folder->cases, index, CASE_REFERENCE)[0] == '1';
}

bool shard_row_is_finished(const shard_folder *folder, size_t row)
{
    const char *status = table_cell(folder->summary, row, folder->status);
    return strcmp(status, case_status_name(FM_CASE_SKIPPED)) != 0;
}
