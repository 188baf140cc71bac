#include "shard_set.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static fm_status no_memory(fm_error *err)
{
    return fm_fail(err, FM_NO_MEMORY, "no memory for the shards' cases");
}

static int compare_folders(const void *left, const void *right)
{
    const shard_folder *a = left, *b = right;
    return (a->index > b->index) - (a->index < b->index);
}

static fm_status open_folders(shard_set *set, const char *const *paths, bool *is_damaged,
                              fm_error *err)
{
    size_t count = 0;
    fm_status status = FM_OK;
    while (paths[count] != NULL)
        count++;
    set->folders = calloc(count + 1, sizeof *set->folders);
    if (set->folders == NULL)
        return no_memory(err);
    while (set->count < count && status == FM_OK) {
        status = shard_folder_open(&set->folders[set->count], paths[set->count], is_damaged, err);
        set->count++;
    }
    if (status == FM_OK)
        qsort(set->folders, set->count, sizeof *set->folders, compare_folders);
    return status;
}

static bool is_same_table(const fm_table *a, const fm_table *b)
{
    bool is_same = a->row_count == b->row_count;
    for (size_t i = 0; i < a->row_count * a->column_count && is_same; i++)
        is_same = strcmp(a->cells[i], b->cells[i]) == 0;
    return is_same;
}

static fm_status check_plans(const shard_set *set, fm_error *err)
{
    const shard_folder *first = &set->folders[0];
    for (size_t i = 1; i < set->count; i++) {
        const shard_folder *other = &set->folders[i];
        if (strcmp(other->plan, first->plan) != 0 || other->count != first->count ||
            !is_same_table(other->cases, first->cases))
            return fm_fail(err, FM_INVALID,
                           "%s and %s are no shards of one plan: the first is %u/%u of plan %s, "
                           "the second %u/%u of plan %s%s",
                           first->path, other->path, first->index, first->count, first->plan,
                           other->index, other->count, other->plan,
                           strcmp(other->plan, first->plan) == 0 && other->count == first->count
                               ? ", parted otherwise (--shard-reference)"
                               : "");
        if (other->index == set->folders[i - 1].index)
            return fm_fail(err, FM_INVALID, "%s and %s are both shard %u/%u: name one of them",
                           set->folders[i - 1].path, other->path, other->index, other->count);
    }
    return FM_OK;
}

static fm_status index_cases(shard_set *set, bool *is_damaged, fm_error *err)
{
    set->cases = set->folders[0].cases;
    for (size_t i = 0; i < set->cases->row_count; i++) {
        const size_t index = text_index_add(&set->ids, shard_set_id(set, i), i);
        if (index == FM_TEXT_INDEX_NONE)
            return no_memory(err);
        *is_damaged = index != i;
        if (*is_damaged)
            return fm_fail(err, FM_INVALID, "%s:%u: case %s stands there twice", set->cases->path,
                           set->cases->lines[i], shard_set_id(set, i));
    }
    return FM_OK;
}

bool shard_set_is_due(const shard_set *set, size_t folder, size_t case_index)
{
    const shard_folder *of = &set->folders[folder];
    return shard_case_is_reference(of, case_index) || of->shard_of[case_index] == of->index;
}

/* Of a case the row of the shard that it belongs to or, where that lacks, of a reference the first.
 */
static void take_row(shard_set *set, size_t folder, size_t row, size_t case_index)
{
    const shard_folder *of = &set->folders[folder];
    assert(set->taken != NULL);
    if (set->taken[case_index].folder == SHARD_NONE || of->shard_of[case_index] == of->index)
        set->taken[case_index] = (shard_row){ folder, row };
}

/* seen: [cases], how many folders were read when the case was met last. */
static fm_status index_rows_of(shard_set *set, size_t folder, uint32_t *seen, fm_error *err)
{
    shard_folder *of = &set->folders[folder];
    const fm_table *summary = of->summary;
    assert(seen != NULL);
    of->case_of = calloc(summary->row_count + 1, sizeof *of->case_of);
    if (of->case_of == NULL)
        return no_memory(err);
    for (size_t row = 0; row < summary->row_count; row++) {
        const char *id = table_cell(summary, row, of->case_id);
        const size_t index = text_index_find(&set->ids, id);
        if (index == FM_TEXT_INDEX_NONE || !shard_set_is_due(set, folder, index))
            return fm_fail(err, FM_INVALID, "%s:%u: case %.64s is none of shard %u/%u",
                           summary->path, summary->lines[row], id, of->index, of->count);
        if (seen[index] == folder + 1)
            return fm_fail(err, FM_INVALID, "%s:%u: case %s has two rows", summary->path,
                           summary->lines[row], id);
        seen[index] = (uint32_t)folder + 1;
        const bool is_finished = shard_row_is_finished(of, row);
        of->case_of[row] = is_finished ? index : SHARD_NONE;
        of->finished += is_finished;
        if (is_finished)
            take_row(set, folder, row, index);
    }
    return FM_OK;
}

static fm_status index_rows(shard_set *set, bool *is_damaged, fm_error *err)
{
    const size_t case_count = set->cases->row_count;
    fm_status status = FM_OK;
    uint32_t *seen = calloc(case_count + 1, sizeof *seen);
    set->taken = calloc(case_count + 1, sizeof *set->taken);
    for (size_t i = 0; set->taken != NULL && i < case_count; i++)
        set->taken[i].folder = SHARD_NONE;
    if (seen == NULL || set->taken == NULL)
        status = no_memory(err);
    for (size_t i = 0; i < set->count && status == FM_OK; i++)
        status = index_rows_of(set, i, seen, err);
    free(seen);
    *is_damaged = status == FM_INVALID;
    return status;
}

fm_status shard_set_open(shard_set *set, const char *const *paths, bool *is_damaged, fm_error *err)
{
    *is_damaged = false;
    fm_status status = open_folders(set, paths, is_damaged, err);
    if (status == FM_OK)
        status = check_plans(set, err);
    if (status == FM_OK)
        status = index_cases(set, is_damaged, err);
    if (status == FM_OK)
        status = index_rows(set, is_damaged, err);
    return status;
}

void shard_set_close(shard_set *set)
{
    for (size_t i = 0; i < set->count; i++)
        shard_folder_close(&set->folders[i]);
    text_index_free(&set->ids);
    free(set->folders);
    free(set->taken);
    *set = (shard_set){ 0 };
}

const char *shard_set_id(const shard_set *set, size_t case_index)
{
    return table_cell(set->cases, case_index, 0);
}
