#include "quantity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
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

bool quantity_is_reference(const fm_case_row *row)
{
    char own[FM_OPTIONS_TEXT_BYTES], kept[FM_OPTIONS_TEXT_BYTES];
    options_select(own, row->options, FM_OPTIONS_OWN, NULL);
    options_drop(kept, own, row->look.defaults);
    return row->is_measured && kept[0] == '\0';
}

static fm_status refuse_method(const char *method, const fm_result_files *run, fm_error *err)
{
    fm_text_list names = { 0 };
    for (size_t i = 0; i < run->count; i++)
        if (!text_list_has(&names, run->cases[i].method))
            text_list_add(&names, run->cases[i].method);
    const char *nearest = text_nearest(method, text_list_items(&names), names.count);
    fm_fail(err, FM_INVALID, "--reference %.64s: %s has no case of that method%s%s%s", method,
            run->directory, nearest != NULL ? "; the nearest is '" : "",
            nearest != NULL ? nearest : "", nearest != NULL ? "'" : "");
    text_list_free(&names);
    return FM_INVALID;
}

static fm_status find_references(fm_references *references, const fm_result_files *run,
                                 const char *method, fm_error *err)
{
    bool is_there = false;
    references->run = run;
    references->cases = calloc(run->count + 1, sizeof *references->cases);
    if (references->cases == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", run->count);
    for (size_t i = 0; i < run->count; i++) {
        const fm_case_row *row = &run->cases[i];
        if (strcmp(row->method, method) != 0)
            continue;
        is_there = true;
        if (quantity_is_reference(row))
            references->cases[references->count++] = i;
    }
    return is_there ? FM_OK : refuse_method(method, run, err);
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
    fm_status status = choose_over(quantity, reference, machines, err);
    if (status != FM_OK || quantity->over != FM_OVER_METHOD)
        return status;
    status = find_references(&quantity->references[0], base, quantity->method, err);
    return status == FM_OK ? find_references(&quantity->references[1], now, quantity->method, err)
                           : status;
}

void quantity_free(fm_quantity *quantity)
{
    for (int i = 0; i < 2; i++)
        free(quantity->references[i].cases);
    *quantity = (fm_quantity){ 0 };
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

/* NULL: the run has none. */
static const fm_case_row *find_reference(const fm_quantity *quantity,
                                         const fm_result_files *results, const fm_case_row *row)
{
    const fm_references *references = &quantity->references[quantity->references[0].run != results];
    for (size_t i = 0; i < references->count; i++)
        if (workload_same(row, &results->cases[references->cases[i]], NULL))
            return &results->cases[references->cases[i]];
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
    const fm_case_row *reference = find_reference(quantity, results, row);
    if (reference == row)
        return interval_exact(1.0);
    return reference != NULL
               ? interval_ratio(own, case_interval(results, reference, &quantity->metric, 1))
               : none;
}
