#include "join.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text_index.h"
#include "model/auto_option.h"
#include "read/options.h"
#include "read/workload.h"

/* The cases of `now` while they are given away. */
typedef struct joiner {
    const fm_result_files *now;
    bool *is_taken;      /* [now->count] */
    size_t *next_alike;  /* [now->count]: the next of the same name; SIZE_MAX: none */
    fm_text_index names; /* the last case of each name */
} joiner;

void join_add_name(fm_text *name, const fm_case_row *row)
{
    char workload[WORKLOAD_KEY_BYTES], kept[FM_OPTIONS_TEXT_BYTES];
    const char *options = row->options;
    workload_key(workload, row, NULL);
    if (strlen(options) < sizeof kept) {
        options_drop(kept, options, row->look.defaults);
        options = kept;
    }
    text_add(name, "%s%s|%.17g|%s", row->method, workload, isnan(row->k) ? 0.0 : row->k, options);
    for (size_t i = 0; i < AUTO_OPTION_COUNT; i++) { /* whose defaults differ between devices */
        char value[FM_OPTION_VALUE_BYTES];
        options_value(value, row->options, auto_options[i].name);
        text_add(name, "|%s", value[0] != '\0' ? value : auto_options[i].before);
    }
}

static bool agrees(double a, double b)
{
    return isnan(a) || isnan(b) || a == b;
}

static fm_status index_names(joiner *to, fm_error *err)
{
    for (size_t i = to->now->count; i-- > 0;) { /* so that chains begin at the first */
        fm_text name = { 0 };
        to->next_alike[i] = SIZE_MAX;
        if (to->is_taken[i])
            continue;
        join_add_name(&name, &to->now->cases[i]);
        const size_t first =
            name.failed ? FM_TEXT_INDEX_NONE : text_index_add(&to->names, name.bytes, i);
        text_free(&name);
        if (first == FM_TEXT_INDEX_NONE)
            return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", to->now->count);
        if (first != i) { /* behind the one that stands for the name */
            to->next_alike[i] = to->next_alike[first];
            to->next_alike[first] = i;
        }
    }
    return FM_OK;
}

static void take(fm_pair *pair, joiner *from, size_t index, bool is_by_name)
{
    pair->now = &from->now->cases[index];
    pair->is_by_name = is_by_name;
    from->is_taken[index] = true;
}

static void take_by_id(fm_pairs *pairs, joiner *from)
{
    for (size_t i = 0; i < pairs->count; i++) {
        const size_t found = text_index_find(&from->now->ids, pairs->items[i].base->id);
        if (found != FM_TEXT_INDEX_NONE)
            take(&pairs->items[i], from, found, false);
    }
}

static fm_status take_by_name(fm_pairs *pairs, joiner *from, fm_error *err)
{
    for (size_t i = 0; i < pairs->count; i++) {
        fm_text name = { 0 };
        fm_pair *pair = &pairs->items[i];
        if (pair->now != NULL)
            continue;
        join_add_name(&name, pair->base);
        if (name.failed) {
            text_free(&name);
            return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", pairs->count);
        }
        size_t at = text_index_find(&from->names, name.bytes);
        text_free(&name);
        while (at != SIZE_MAX &&
               (from->is_taken[at] ||
                !agrees(pair->base->metric[FM_METRIC_N], from->now->cases[at].metric[FM_METRIC_N])))
            at = from->next_alike[at];
        if (at != SIZE_MAX)
            take(pair, from, at, true);
    }
    return FM_OK;
}

static fm_status join(fm_pairs *pairs, joiner *from, const fm_result_files *base, fm_error *err)
{
    for (size_t i = 0; i < base->count; i++)
        pairs->items[pairs->count++].base = &base->cases[i];
    take_by_id(pairs, from);
    fm_status status = index_names(from, err);
    if (status == FM_OK)
        status = take_by_name(pairs, from, err);
    for (size_t i = 0; i < from->now->count && status == FM_OK; i++)
        if (!from->is_taken[i])
            pairs->items[pairs->count++].now = &from->now->cases[i];
    return status;
}

fm_status join_cases(fm_pairs *pairs, const fm_result_files *base, const fm_result_files *now,
                     fm_error *err)
{
    joiner from = { .now = now,
                    .is_taken = calloc(now->count + 1, sizeof *from.is_taken),
                    .next_alike = calloc(now->count + 1, sizeof *from.next_alike) };
    *pairs = (fm_pairs){ calloc(base->count + now->count + 1, sizeof *pairs->items), 0 };
    fm_status status =
        pairs->items != NULL && from.is_taken != NULL && from.next_alike != NULL
            ? join(pairs, &from, base, err)
            : fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", base->count + now->count);
    text_index_free(&from.names);
    free(from.next_alike);
    free(from.is_taken);
    if (status != FM_OK)
        join_free(pairs);
    return status;
}

void join_free(fm_pairs *pairs)
{
    free(pairs->items);
    *pairs = (fm_pairs){ 0 };
}
