#include <jansson.h>
#include <math.h>
#include <stdlib.h>

#include "comparison.h"

/* JSON has no infinite numbers, and none that is none. */
static json_t *number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *interval(const fm_interval *of)
{
    return json_pack("{s:o, s:o, s:o}", "median", number(of->median), "low", number(of->low),
                     "high", number(of->high));
}

/* Texts of files may be no UTF-8: such bytes become '?'. */
static json_t *text(const char *bytes)
{
    fm_text copy = { 0 };
    text_add(&copy, "%s", bytes);
    if (copy.bytes == NULL)
        return NULL;
    text_make_utf8(copy.bytes);
    json_t *made = json_string(copy.bytes);
    text_free(&copy);
    return made;
}

static json_t *row(const fm_case_row *of)
{
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "case_id", text(of->id),
                     "status", text(of->status), "method", text(of->method), "options",
                     text(of->options), "scene", text(of->scene), "device", text(of->device),
                     "feed", text(of->feed), "k", number(of->k), "n",
                     number(of->metric[FM_METRIC_N]));
}

static json_t *changes(const fm_changes *of)
{
    json_t *list = json_array();
    for (size_t i = 0; i < of->count; i++)
        json_array_append_new(list,
                              json_pack("{s:s, s:o, s:o}", "what", of->items[i].name, "base",
                                        text(of->items[i].base), "new", text(of->items[i].now)));
    return list;
}

/* What of a case is exact. */
static json_t *compared_exactly(const fm_compared *of)
{
    char name[FM_COMPARED_NAME_BYTES];
    compared_name(name, of->pair.base);
    return json_pack("{s:o, s:o, s:o, s:s, s:o, s:s}", "case", text(name), "base_row",
                     row(of->pair.base), "new_row", row(of->pair.now), "verdict",
                     exact_verdict_name(exact_verdict(&of->changes)), "changes",
                     changes(&of->changes), "other_code", of->code);
}

/* With its time, whose verdict it has. */
static json_t *compared(const fm_compared *of)
{
    json_t *object = compared_exactly(of);
    json_object_set_new(object, "verdict", json_string(compared_verdict_name(of->verdict)));
    json_object_set_new(object, "why", json_string(of->why));
    json_object_set_new(object, "base", interval(&of->base));
    json_object_set_new(object, "new", interval(&of->now));
    json_object_set_new(object, "ratio", interval(&of->ratio));
    return object;
}

static json_t *machines(const fm_machines *of)
{
    json_t *list = json_array();
    for (size_t i = 0; i < of->count; i++)
        json_array_append_new(
            list, json_pack("{s:o, s:o, s:o}", "what", text(of->differing[i].name), "base",
                            text(of->differing[i].base), "new", text(of->differing[i].now)));
    return list;
}

static json_t *counts(const fm_comparison *of)
{
    json_t *object = json_object();
    for (int i = 0; i < FM_COMPARED_COUNT; i++)
        json_object_set_new(
            object, compared_verdict_name((fm_compared_verdict)i),
            json_integer((json_int_t)comparison_verdicts(of, (fm_compared_verdict)i)));
    json_object_set_new(object, "changed", json_integer((json_int_t)comparison_changed(of)));
    return object;
}

static json_t *exact_counts(const fm_comparison *of)
{
    json_t *object = json_object();
    for (int i = 0; i < FM_EXACT_COUNT; i++)
        json_object_set_new(object, exact_verdict_name((fm_exact_verdict)i),
                            json_integer((json_int_t)comparison_exact(of, (fm_exact_verdict)i)));
    return object;
}

/* What both kinds have; take: of each case that both runs have. */
static json_t *all_cases(const fm_comparison *of, json_t *(*take)(const fm_compared *compared),
                         json_t *verdicts)
{
    json_t *cases = json_array(), *only_base = json_array(), *only_now = json_array();
    for (size_t i = 0; i < of->count; i++)
        json_array_append_new(cases, take(&of->cases[i]));
    for (size_t i = 0; i < of->pairs.count; i++) {
        const fm_pair *pair = &of->pairs.items[i];
        if (pair->now == NULL)
            json_array_append_new(only_base, row(pair->base));
        else if (pair->base == NULL)
            json_array_append_new(only_now, row(pair->now));
    }
    return json_pack("{s:b, s:b, s:o, s:o, s:o, s:o, s:o}", "same_machine",
                     (int)of->machines.is_same_machine, "same_day", (int)of->machines.is_same_day,
                     "differs", machines(&of->machines), "counts", verdicts, "cases", cases,
                     "only_in_base", only_base, "only_in_new", only_now);
}

/* Drops the object. */
static fm_status add_object(fm_text *json, json_t *object, fm_error *err)
{
    char *bytes = object != NULL ? json_dumps(object, JSON_INDENT(2)) : NULL;
    if (bytes != NULL)
        text_add(json, "%s\n", bytes);
    json_decref(object);
    const bool is_made = bytes != NULL && !json->failed;
    free(bytes);
    return is_made ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for the JSON");
}

fm_status comparison_add_json(fm_text *json, const fm_comparison *comparison, fm_error *err)
{
    char title[128];
    json_t *object = all_cases(comparison, compared, counts(comparison));
    quantity_title(title, &comparison->quantity);
    json_object_set_new(object, "quantity", text(title));
    json_object_set_new(object, "band", json_real(comparison->band));
    return add_object(json, object, err);
}

fm_status comparison_add_exact_json(fm_text *json, const fm_comparison *comparison, fm_error *err)
{
    return add_object(json, all_cases(comparison, compared_exactly, exact_counts(comparison)), err);
}
