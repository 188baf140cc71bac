#include "quantity.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "launches.h"
#include "read/case_metrics.h"
#include "read/interval.h"
#include "read/options.h"
#include "read/workload.h"

static const char *name_of(fm_metric metric)
{
    return fm_metrics[metric].name;
}

/* Times of which less is better, and of which frames or launches have one each. */
static bool is_comparable(const char *name)
{
    const fm_metric_info *info = metric_describe(name);
    return info != NULL && info->is_timed && info->better == FM_BETTER_LESS &&
           (info->of == FM_OF_FRAME || strcmp(name, name_of(FM_METRIC_TIMES_FLOOR)) == 0);
}

static fm_status refuse_metric(const char *name, fm_error *err)
{
    const char *names[FM_METRIC_COUNT];
    size_t count = 0;
    for (int i = 0; i < FM_METRIC_COUNT; i++)
        if (is_comparable(fm_metrics[i].name))
            names[count++] = fm_metrics[i].name;
    const char *nearest = text_nearest(name, names, count);
    return fm_fail(err, FM_INVALID,
                   "--metric %.64s: not a time of frames; the nearest is '%s' (times_floor, and "
                   "pass.NAME_ms of a method's own passes, can be compared, too)",
                   name, nearest != NULL ? nearest : name_of(FM_METRIC_FRAME_MS));
}

/* Whether the run has the method; else it may be the nearest to what was asked for. */
static bool has_method(const fm_result_files *results, const char *method, fm_text_list *names)
{
    bool is_there = false;
    for (size_t i = 0; i < results->count; i++) {
        is_there |= strcmp(results->cases[i].method, method) == 0;
        if (!text_list_has(names, results->cases[i].method))
            text_list_add(names, results->cases[i].method);
    }
    return is_there;
}

static fm_status check_method(const char *method, const fm_result_files *base,
                              const fm_result_files *now, fm_error *err)
{
    fm_text_list names = { 0 };
    fm_status status = FM_OK;
    const bool in_base = has_method(base, method, &names);
    const bool in_now = has_method(now, method, &names);
    if (!in_base || !in_now) {
        const char *nearest = text_nearest(method, text_list_items(&names), names.count);
        status = fm_fail(err, FM_INVALID, "--reference %.64s: %s has no case of that method%s%s%s",
                         method, in_base ? now->directory : base->directory,
                         nearest != NULL ? "; the nearest is '" : "",
                         nearest != NULL ? nearest : "", nearest != NULL ? "'" : "");
    }
    text_list_free(&names);
    return status;
}

static fm_status choose_over(fm_quantity *quantity, const char *reference,
                             const fm_machines *machines, fm_error *err)
{
    const bool is_ratio = strcmp(quantity->metric, name_of(FM_METRIC_TIMES_FLOOR)) == 0;
    if (strcmp(reference, "none") == 0) {
        quantity->over = FM_OVER_NOTHING;
        return machines->is_same_machine || is_ratio
                   ? FM_OK
                   : fm_fail(err, FM_UNSUPPORTED,
                             "%s of two machines, or of machines that are not known, does not "
                             "compare: --reference floor, or a method's name, compares ratios "
                             "within each run",
                             quantity->metric);
    }
    if (is_ratio)
        return fm_fail(err, FM_INVALID, "--metric %s is over the floor already: --reference none",
                       quantity->metric);
    quantity->over = strcmp(reference, "floor") == 0 ? FM_OVER_FLOOR : FM_OVER_METHOD;
    quantity->method = reference;
    return FM_OK;
}

fm_status quantity_choose(fm_quantity *quantity, const fm_quantity_desc *desc,
                          const fm_machines *machines, const fm_result_files *base,
                          const fm_result_files *now, fm_error *err)
{
    const char *reference = desc->reference;
    *quantity = (fm_quantity){ .metric = desc->metric != NULL ? desc->metric
                                                              : name_of(FM_METRIC_FRAME_MS) };
    if (!is_comparable(quantity->metric))
        return refuse_metric(quantity->metric, err);
    if (reference == NULL) {
        quantity->is_chosen =
            desc->metric == NULL && !(machines->is_same_machine && machines->is_same_day);
        reference = quantity->is_chosen ? "floor" : "none";
    }
    const fm_status status = choose_over(quantity, reference, machines, err);
    return status == FM_OK && quantity->over == FM_OVER_METHOD
               ? check_method(quantity->method, base, now, err)
               : status;
}

void quantity_title(char title[128], const fm_quantity *quantity)
{
    snprintf(title, 128, "%.48s%s%.64s", quantity->metric,
             quantity->over == FM_OVER_NOTHING ? "" : " / ",
             quantity->over == FM_OVER_NOTHING ? ""
             : quantity->over == FM_OVER_FLOOR ? "floor"
                                               : quantity->method);
}

/* The metric of the floor that stands beside one of the method's. */
static const char *floor_of(const char *metric)
{
    return strcmp(metric, name_of(FM_METRIC_STORE_MS)) == 0 ? name_of(FM_METRIC_FLOOR_STORE_MS)
                                                            : name_of(FM_METRIC_FLOOR_FRAME_MS);
}

static bool has_defaults(const fm_case_row *row)
{
    char own[FM_OPTIONS_TEXT_BYTES], kept[FM_OPTIONS_TEXT_BYTES];
    options_select(own, row->options, FM_OPTIONS_OWN, NULL);
    options_drop(kept, own, row->look.defaults);
    return kept[0] == '\0';
}

/* NULL: the run has none. */
static const fm_case_row *find_reference(const fm_result_files *results, const fm_case_row *row,
                                         const char *method)
{
    for (size_t i = 0; i < results->count; i++) {
        const fm_case_row *other = &results->cases[i];
        if (strcmp(other->method, method) == 0 && other->is_measured &&
            workload_same(row, other, NULL) && has_defaults(other))
            return other;
    }
    return NULL;
}

fm_interval quantity_of(const fm_quantity *quantity, const fm_result_files *results,
                        const fm_case_row *row)
{
    const fm_interval none = { NAN, NAN, NAN };
    if (!row->is_measured || row->is_simulated)
        return none;
    if (quantity->over == FM_OVER_FLOOR)
        return launches_ratio(results, row, quantity->metric, floor_of(quantity->metric));
    const fm_interval own = case_interval(results, row, &quantity->metric, 1);
    if (quantity->over == FM_OVER_NOTHING)
        return own;
    const fm_case_row *reference = find_reference(results, row, quantity->method);
    if (reference == row)
        return interval_exact(1.0);
    return reference != NULL
               ? interval_ratio(own, case_interval(results, reference, &quantity->metric, 1))
               : none;
}
