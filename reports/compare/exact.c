#include "exact.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "model/outcome.h"
#include "read/case_metrics.h"
#include "tradeoff/error_kind.h"

static fm_change *add(fm_changes *changes, const char *name)
{
    if (changes->count == changes->capacity) {
        const size_t more = changes->capacity == 0 ? 4 : 2 * changes->capacity;
        fm_change *grown = reallocarray(changes->items, more, sizeof *grown);
        if (grown == NULL)
            return NULL;
        changes->items = grown;
        changes->capacity = more;
    }
    fm_change *change = &changes->items[changes->count++];
    *change = (fm_change){ .name = name };
    return change;
}

static fm_status compare_text(fm_changes *changes, const char *name, const char *base,
                              const char *now, fm_error *err)
{
    if (strcmp(base, now) == 0)
        return FM_OK;
    fm_change *change = add(changes, name);
    if (change == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu changes", changes->count);
    snprintf(change->base, sizeof change->base, "%.63s", base);
    snprintf(change->now, sizeof change->now, "%.63s", now);
    return FM_OK;
}

static void write_number(char text[FM_CHANGE_TEXT_BYTES], double value)
{
    if (!isnan(value))
        snprintf(text, FM_CHANGE_TEXT_BYTES, "%.15g", value);
}

static fm_status add_numbers(fm_changes *changes, const char *name, double base, double now,
                             fm_error *err)
{
    fm_change *change = add(changes, name);
    if (change == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu changes", changes->count);
    write_number(change->base, base);
    write_number(change->now, now);
    return FM_OK;
}

/* Numbers that do not hang on how fragments raced. */
static bool is_of_scene_or_memory(fm_metric metric)
{
    return fm_metrics[metric].range == FM_RANGE_BYTES || metric == FM_METRIC_N ||
           metric == FM_METRIC_FRAGMENTS_GENERATED || metric == FM_METRIC_NONEMPTY_PIXELS ||
           metric == FM_METRIC_TRUTH_DIGEST;
}

static bool is_racy(const fm_pair *pair)
{
    return ((pair->base->look.traits | pair->now->look.traits) & FM_TRAIT_RACY) != 0;
}

static bool is_unsteady(const fm_case_row *row)
{
    return row->metric[FM_METRIC_DISTINCT_IMAGES] > 1;
}

/* Whether fragments and errors are to be those of BASE: a method that became unsteady is not
 * excused by that. */
static bool is_to_repeat(const fm_pair *pair)
{
    return !is_racy(pair) && !is_unsteady(pair->base);
}

static bool have_column(const fm_result_files *base, const fm_result_files *now, const char *name)
{
    return table_column(base->summary, name) != FM_TABLE_NO_COLUMN &&
           table_column(now->summary, name) != FM_TABLE_NO_COLUMN;
}

/* A cell that is empty in one file alone differs; what one file has no cell for is not known. */
static bool differ(double base, double now, bool have_cells)
{
    if (isnan(base) || isnan(now))
        return have_cells && isnan(base) != isnan(now);
    return base != now;
}

/* Numbers of an error that is rounded alike are equal. */
static bool is_rounding(const fm_error_kind *kind, const fm_pair *pair)
{
    return fabs(error_kind_of(kind, pair->base) - error_kind_of(kind, pair->now)) <=
           kind->exact_below;
}

static fm_status compare_metric(fm_changes *changes, fm_metric metric, const fm_pair *pair,
                                const fm_result_files *base, const fm_result_files *now,
                                fm_error *err)
{
    const fm_metric_info *info = &fm_metrics[metric];
    const fm_error_kind *kind = error_kind_by_metric(metric);
    const bool is_number = info->range != FM_RANGE_ERROR && info->range != FM_RANGE_LEVEL;
    if (info->of != FM_OF_CASE || info->is_measured || (!is_number && kind == NULL) ||
        (!is_of_scene_or_memory(metric) && !is_to_repeat(pair)) ||
        (kind != NULL && is_rounding(kind, pair)))
        return FM_OK;
    const double one = case_metric(base, pair->base, info->name);
    const double other = case_metric(now, pair->now, info->name);
    return differ(one, other, have_column(base, now, info->name))
               ? add_numbers(changes, info->name, one, other, err)
               : FM_OK;
}

/* All frames drew one image in one run, and not in the other; and what that cost. */
static fm_status compare_steadiness(fm_changes *changes, const fm_pair *pair, fm_error *err)
{
    const double *base = pair->base->metric, *now = pair->now->metric;
    if (is_racy(pair) || is_unsteady(pair->base) == is_unsteady(pair->now) ||
        isnan(base[FM_METRIC_DISTINCT_IMAGES]) || isnan(now[FM_METRIC_DISTINCT_IMAGES]))
        return FM_OK;
    const fm_status status =
        add_numbers(changes, fm_metrics[FM_METRIC_DISTINCT_IMAGES].name,
                    base[FM_METRIC_DISTINCT_IMAGES], now[FM_METRIC_DISTINCT_IMAGES], err);
    const double one = base[FM_METRIC_FRAMES_RMSE_MAX], other = now[FM_METRIC_FRAMES_RMSE_MAX];
    return status == FM_OK && differ(one, other, false)
               ? add_numbers(changes, fm_metrics[FM_METRIC_FRAMES_RMSE_MAX].name, one, other, err)
               : status;
}

fm_status exact_compare(fm_changes *changes, const fm_pair *pair, const fm_result_files *base,
                        const fm_result_files *now, fm_error *err)
{
    *changes = (fm_changes){ 0 };
    fm_status status = compare_text(changes, "status", pair->base->status, pair->now->status, err);
    if (status == FM_OK)
        status = compare_text(changes, "method_version", pair->base->method_version,
                              pair->now->method_version, err);
    if (status == FM_OK)
        status = compare_text(changes, "options", pair->base->options, pair->now->options, err);
    const bool is_measured = pair->base->is_measured && pair->now->is_measured;
    for (int i = 0; i < FM_METRIC_COUNT && status == FM_OK && is_measured; i++)
        status = compare_metric(changes, (fm_metric)i, pair, base, now, err);
    if (status == FM_OK && is_measured)
        status = compare_steadiness(changes, pair, err);
    if (status != FM_OK)
        exact_free(changes);
    return status;
}

fm_status exact_add_image(fm_changes *changes, const fm_pair *pair, const char *base,
                          const char *now, fm_error *err)
{
    const bool is_one_driver = pair->base->code_driver[0] != '\0' &&
                               strcmp(pair->base->code_driver, pair->now->code_driver) == 0;
    return is_one_driver && is_to_repeat(pair) && base[0] != '\0' && now[0] != '\0'
               ? compare_text(changes, "image", base, now, err)
               : FM_OK;
}

int exact_order(const fm_change *change)
{
    fm_case_status before, after;
    fm_metric metric;
    double base, now;
    if (strcmp(change->name, "status") == 0)
        return case_status_parse(&before, change->base) && case_status_parse(&after, change->now)
                   ? (after < before) - (after > before)
                   : 0;
    if (!metric_find(&metric, change->name) || fm_metrics[metric].better == FM_BETTER_NEITHER ||
        !text_to_double(&base, change->base) || !text_to_double(&now, change->now))
        return 0;
    const int less = (now < base) - (now > base);
    return fm_metrics[metric].better == FM_BETTER_LESS ? less : -less;
}

fm_exact_verdict exact_verdict(const fm_changes *changes)
{
    for (size_t i = 0; i < changes->count; i++)
        if (exact_order(&changes->items[i]) < 0)
            return FM_EXACT_WORSE;
    return changes->count > 0 ? FM_EXACT_DIFFERS : FM_EXACT_EQUAL;
}

const char *exact_verdict_name(fm_exact_verdict verdict)
{
    static const char *const names[] = {
        [FM_EXACT_WORSE] = "worse",
        [FM_EXACT_DIFFERS] = "differs",
        [FM_EXACT_EQUAL] = "equal",
    };
    _Static_assert(sizeof names / sizeof names[0] == FM_EXACT_COUNT, "one name a verdict");
    return names[verdict];
}

void exact_free(fm_changes *changes)
{
    free(changes->items);
    *changes = (fm_changes){ 0 };
}

void exact_code(char differing[FM_CODE_TEXT_BYTES], const fm_pair *pair)
{
    const struct {
        const char *word, *base, *now;
    } codes[] = {
        { "program", pair->base->code_program, pair->now->code_program },
        { "driver", pair->base->code_driver, pair->now->code_driver },
        { "plugin", pair->base->code_plugin, pair->now->code_plugin },
        { "shaders", pair->base->code_shaders, pair->now->code_shaders },
    };
    size_t used = 0;
    differing[0] = '\0';
    for (size_t i = 0; i < sizeof codes / sizeof codes[0]; i++)
        if (codes[i].base[0] != '\0' && codes[i].now[0] != '\0' &&
            strcmp(codes[i].base, codes[i].now) != 0)
            used += (size_t)snprintf(differing + used, FM_CODE_TEXT_BYTES - used, "%s%s",
                                     used > 0 ? " " : "", codes[i].word);
}
