#include "overlap.h"

#include <stdlib.h>
#include <string.h>

#include "model/columns.h"
#include "model/family.h"

/* What the same code says of a case on each machine. */
static bool fact_repeats(fm_fact fact)
{
    switch (fact) {
    case FM_FACT_SCHEMA:
    case FM_FACT_CASE_ID:
    case FM_FACT_STATUS:
    case FM_FACT_METHOD:
    case FM_FACT_METHOD_VERSION:
    case FM_FACT_DEVICE:
    case FM_FACT_FEED:
    case FM_FACT_SCENE:
    case FM_FACT_OPTIONS:
    case FM_FACT_CODE_PROGRAM:
    case FM_FACT_CODE_PLUGIN:
    case FM_FACT_CODE_SHADERS:
    case FM_FACT_REASON:
        return true;
    case FM_FACT_MESSAGE: /* names machines and launches */
    case FM_FACT_DEVICE_NAME:
    case FM_FACT_CODE_DRIVER:
    case FM_FACT_NOISY:
    case FM_FACT_LIMITED_BY: /* hangs on times */
    case FM_FACT_COUNT:
        break;
    }
    return false;
}

/* What two rows of a case need not have alike. */
typedef struct leeway {
    bool is_racy;         /* fragments and errors hang on how fragments raced */
    bool is_other_driver; /* errors are rounded otherwise */
} leeway;

static bool metric_repeats(fm_metric metric, leeway may)
{
    const fm_metric_info *info = &fm_metrics[metric];
    const bool is_error = info->range == FM_RANGE_ERROR || info->range == FM_RANGE_LEVEL;
    if (info->is_measured || info->of != FM_OF_CASE || (is_error && may.is_other_driver))
        return false;
    return !may.is_racy || info->range == FM_RANGE_BYTES || metric == FM_METRIC_N ||
           metric == FM_METRIC_FRAGMENTS_GENERATED;
}

static bool column_repeats(const fm_column *column, leeway may)
{
    switch (column->kind) {
    case FM_COLUMN_FACT:
        return fact_repeats(column->fact);
    case FM_COLUMN_KEY:
        return true;
    case FM_COLUMN_METRIC:
        return metric_repeats(column->metric, may);
    case FM_COLUMN_LOW:
    case FM_COLUMN_HIGH:
        break;
    }
    return false;
}

static bool has_racy_trait(const json_t *manifest, const char *method)
{
    const json_t *methods = json_object_get(manifest, "methods");
    const json_t *traits = json_object_get(json_object_get(methods, method), "traits"), *trait;
    size_t i;
    json_array_foreach(traits, i, trait)
    {
        const char *name = json_string_value(trait);
        for (unsigned bit = 0; name != NULL && trait_name(bit) != NULL; bit++)
            if ((1u << bit & FM_TRAIT_RACY) != 0 && strcmp(trait_name(bit), name) == 0)
                return true;
    }
    return false;
}

static bool row_is_racy(const shard_folder *folder, size_t row)
{
    const fm_table *summary = folder->summary;
    const size_t images = table_column(summary, fm_metrics[FM_METRIC_DISTINCT_IMAGES].name);
    return strtoul(table_cell(summary, row, images), NULL, 10) > 1 ||
           has_racy_trait(folder->manifest,
                          table_cell(summary, row, table_column(summary, "method")));
}

static fm_status compare_rows(const shard_folder *a, size_t row_a, const shard_folder *b,
                              size_t row_b, fm_error *err)
{
    const size_t driver = table_column(a->summary, "code_driver");
    const leeway may = { .is_racy = row_is_racy(a, row_a) || row_is_racy(b, row_b),
                         .is_other_driver = strcmp(table_cell(a->summary, row_a, driver),
                                                   table_cell(b->summary, row_b, driver)) != 0 };
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++) {
        const size_t column = table_column(a->summary, column_name(&fm_columns[i]));
        const char *of_a = table_cell(a->summary, row_a, column);
        const char *of_b = table_cell(b->summary, row_b, column);
        if (!column_repeats(&fm_columns[i], may) || strcmp(of_a, of_b) == 0)
            continue;
        return fm_fail(err, FM_UNSUPPORTED,
                       "case %s: %s is '%.80s' in %s (%u/%u) and '%.80s' in %s (%u/%u), where the "
                       "same code gives the same; nothing was merged",
                       table_cell(a->summary, row_a, a->case_id), column_name(&fm_columns[i]), of_a,
                       a->path, a->index, a->count, of_b, b->path, b->index, b->count);
    }
    return FM_OK;
}

fm_status overlap_check(const shard_set *set, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < set->count; i++) {
        const shard_folder *folder = &set->folders[i];
        for (size_t row = 0; row < folder->summary->row_count && status == FM_OK; row++) {
            const size_t index = folder->case_of[row];
            if (index == SHARD_NONE || set->taken[index].folder == i)
                continue;
            const shard_row *taken = &set->taken[index];
            status = compare_rows(&set->folders[taken->folder], taken->row, folder, row, err);
        }
    }
    return status;
}
