#include "merge.h"

#include <stdio.h>

#include "agree.h"
#include "merged_files.h"
#include "merged_manifest.h"
#include "merged_tables.h"
#include "model/outcome.h"
#include "overlap.h"
#include "shard_set.h"

static bool add_sentence(fm_text_list *missing, const shard_set *set, uint32_t index,
                         const shard_folder *folder, size_t lacks)
{
    char sentence[FM_PATH_MAX_BYTES + 128];
    if (folder == NULL)
        snprintf(sentence, sizeof sentence, "shard %u/%u is missing, with %zu cases", index,
                 set->folders[0].count, lacks);
    else
        snprintf(sentence, sizeof sentence,
                 "shard %u/%u in %s is not finished: %zu cases lack; its command continues it",
                 index, folder->count, folder->path, lacks);
    return text_list_add(missing, sentence);
}

/* How many cases a shard is to have: all, or but for the references. */
static size_t count_due(const shard_set *set, uint32_t index, bool has_references)
{
    size_t count = 0;
    for (size_t i = 0; i < set->cases->row_count; i++)
        count += set->folders[0].shard_of[i] == index ||
                 (has_references && shard_case_is_reference(&set->folders[0], i));
    return count;
}

static fm_status find_missing(fm_merge_result *result, const shard_set *set, fm_error *err)
{
    size_t next = 0;
    bool is_done = true;
    for (uint32_t index = 1; index <= set->folders[0].count && is_done; index++) {
        const shard_folder *folder =
            next < set->count && set->folders[next].index == index ? &set->folders[next++] : NULL;
        const size_t due = count_due(set, index, folder != NULL);
        if (folder == NULL)
            is_done = add_sentence(&result->missing, set, index, NULL, due);
        else if (folder->finished < due ||
                 !json_is_string(json_object_get(folder->manifest, "ended")))
            is_done = add_sentence(&result->missing, set, index, folder, due - folder->finished);
    }
    return is_done ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for what is missing");
}

static void count_rows(fm_merge_result *result, const shard_set *set)
{
    for (size_t i = 0; i < set->cases->row_count; i++) {
        const shard_row *taken = &set->taken[i];
        if (taken->folder == SHARD_NONE)
            continue;
        const shard_folder *folder = &set->folders[taken->folder];
        fm_case_status status = FM_CASE_OK;
        case_status_parse(&status, table_cell(folder->summary, taken->row, folder->status));
        result->ok += status == FM_CASE_OK;
        result->not_supported += status == FM_CASE_NOT_SUPPORTED;
        result->failed += status != FM_CASE_OK && status != FM_CASE_NOT_SUPPORTED;
    }
}

/* The manifest comes first, so that a merge that was ended can be repeated, and last. */
static fm_status write_all(fm_merge_result *result, const shard_set *set, const fm_merge_desc *desc,
                           fm_error *err)
{
    fm_status status = path_make_folders(desc->directory, err);
    if (status == FM_OK)
        status = merged_manifest_write(set, desc, &result->missing, false, err);
    if (status == FM_OK)
        status = merged_files_copy(set, desc->directory, err);
    if (status == FM_OK)
        status = merged_tables_write(set, desc->directory, &result->is_damaged, err);
    return status == FM_OK ? merged_manifest_write(set, desc, &result->missing, true, err) : status;
}

fm_status merge_shards(fm_merge_result *result, const fm_merge_desc *desc, fm_error *err)
{
    shard_set set = { 0 };
    fm_status status = shard_set_open(&set, desc->folders, &result->is_damaged, err);
    if (status == FM_OK)
        status = merged_manifest_expect(desc->directory, set.folders[0].plan, err);
    if (status == FM_OK)
        status = agree_check(&set, &result->is_damaged, err);
    if (status == FM_OK)
        status = overlap_check(&set, err);
    if (status == FM_OK)
        status = find_missing(result, &set, err);
    if (status == FM_OK) {
        result->shard_count = set.folders[0].count;
        result->given = (uint32_t)set.count;
        result->case_count = set.cases->row_count;
        count_rows(result, &set);
        status = write_all(result, &set, desc, err);
    }
    shard_set_close(&set);
    return status;
}
