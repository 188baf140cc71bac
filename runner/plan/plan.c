#include "plan.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/text_index.h"
#include "chosen.h"
#include "decide/precision.h"
#include "plan_case.h"

/* Everything looked up, and the cases so far. */
typedef struct expansion {
    fm_chosen chosen;
    fm_case *cases;
    size_t count, capacity;
    fm_text_index ids;
    fm_mesh_memo memo;
    fm_device_memo *device_memos; /* one for each chosen device */
    fm_error *err;
} expansion;

static fm_status no_memory(fm_error *err)
{
    return fm_fail(err, FM_NO_MEMORY, "no memory for the plan");
}

static bool is_swept(const fm_plugin_entry *entry, const fm_sweep *sweep)
{
    if (entry->plugin == NULL) /* one case says that it was refused */
        return false;
    return sweep->key != NULL || option_find(entry->plugin->method, sweep->name) != NULL;
}

/* How many cases the axes make, before equal ones become one; FM_PLAN_MAX_CASES + 1: more. */
static uint64_t count_cases(const fm_chosen *chosen)
{
    uint64_t sum = 0;
    const uint64_t places = chosen->selection.names[FM_LISTED_SCENES].count *
                            chosen->selection.names[FM_LISTED_DEVICES].count *
                            chosen->selection.names[FM_LISTED_FEEDS].count;
    for (size_t i = 0; i < chosen->method_count; i++) {
        uint64_t product = places;
        for (size_t j = 0; j < chosen->selection.sweep_count; j++) {
            if (product > FM_PLAN_MAX_CASES)
                return FM_PLAN_MAX_CASES + 1;
            if (is_swept(chosen->methods[i], &chosen->selection.sweeps[j]))
                product *= chosen->selection.sweeps[j].values.count;
        }
        sum += product;
        if (sum > FM_PLAN_MAX_CASES)
            return FM_PLAN_MAX_CASES + 1;
    }
    return sum;
}

static fm_status add_case(expansion *state, const fm_plan_point *point)
{
    if (state->count == state->capacity) {
        const size_t capacity = state->capacity > 0 ? 2 * state->capacity : 64;
        fm_case *cases = realloc(state->cases, capacity * sizeof *cases);
        if (cases == NULL)
            return no_memory(state->err);
        state->cases = cases;
        state->capacity = capacity;
    }
    fm_case *made = &state->cases[state->count];
    const fm_status status = plan_case_make(made, point, state->err);
    if (status != FM_OK)
        return status;
    const size_t index = text_index_add(&state->ids, made->id, state->count);
    if (index == state->count)
        state->count++;
    else /* another case has the id */
        plan_case_release(made);
    return index != FM_TEXT_INDEX_NONE ? FM_OK : no_memory(state->err);
}

/* The next point, the last axis fastest; false: there is none. */
static bool next_point(size_t *values, const expansion *state, const fm_plugin_entry *entry)
{
    for (size_t i = state->chosen.selection.sweep_count; i-- > 0;) {
        const fm_sweep *sweep = &state->chosen.selection.sweeps[i];
        if (!is_swept(entry, sweep))
            continue;
        if (++values[i] < sweep->values.count)
            return true;
        values[i] = 0;
    }
    return false;
}

static fm_status expand_methods(expansion *state, fm_plan_point *point)
{
    size_t values[FM_MAX_SWEEPS] = { 0 };
    fm_status status = FM_OK;
    point->values = values;
    for (size_t i = 0; i < state->chosen.method_count; i++) {
        point->entry = state->chosen.methods[i];
        do
            status = add_case(state, point);
        while (status == FM_OK && next_point(values, state, point->entry));
        if (status != FM_OK)
            break;
    }
    point->values = NULL;
    return status;
}

static fm_status expand(expansion *state)
{
    const fm_text_list *devices = &state->chosen.selection.names[FM_LISTED_DEVICES];
    const fm_text_list *feeds = &state->chosen.selection.names[FM_LISTED_FEEDS];
    const size_t scene_count = state->chosen.selection.names[FM_LISTED_SCENES].count;
    const size_t place_count = scene_count * devices->count * feeds->count;
    fm_status status = FM_OK;
    for (size_t i = 0; status == FM_OK && i < place_count; i++) {
        const fm_chosen_scene *scene = &state->chosen.scenes[i / (devices->count * feeds->count)];
        const size_t device = i / feeds->count % devices->count;
        fm_plan_point point = {
            .scene = scene->name,
            .base = &scene->settings,
            .device = devices->items[device],
            .ops = state->chosen.devices[device],
            .feed = feeds->items[i % feeds->count],
            .selection = &state->chosen.selection,
            .memo = &state->memo,
            .device_memo = &state->device_memos[device],
        };
        status = expand_methods(state, &point);
    }
    return status;
}

/* The keys of the whole run: the same in every case, and the first seed. */
static void fill_run(fm_plan *plan, const fm_selection *selection)
{
    fm_settings settings;
    settings_default(&settings);
    for (size_t i = 0; i < selection->sweep_count; i++) {
        const fm_sweep *sweep = &selection->sweeps[i];
        if (sweep->key != NULL)
            settings_set(&settings, sweep->key, sweep->values.items[0], NULL);
    }
    plan->seed = settings.seed;
    const bool is_adaptive = settings.precision_percent > 0.0;
    plan->launches = is_adaptive && selection_find(selection, "launches") == NULL
                         ? PRECISION_LAST
                         : settings.launches;
    plan->frames = settings.frames;
    plan->warmup = settings.warmup;
}

static void cap_launches(fm_plan *plan)
{
    uint32_t most = 0;
    for (size_t i = 0; i < plan->count; i++)
        most = plan_case_launches(plan, i) > most ? plan_case_launches(plan, i) : most;
    plan->launches = most > 0 ? most : plan->launches;
}

static fm_status make_memos(expansion *state, const fm_plan_request *request)
{
    const size_t count = state->chosen.selection.names[FM_LISTED_DEVICES].count;
    state->device_memos = calloc(count + 1, sizeof *state->device_memos);
    if (state->device_memos == NULL)
        return no_memory(state->err);
    for (size_t i = 0; i < count; i++)
        state->device_memos[i].request = request;
    return FM_OK;
}

/* The first device that could not be asked. */
static void tell_unknown(fm_plan *plan, const expansion *state)
{
    const size_t count = state->chosen.selection.names[FM_LISTED_DEVICES].count;
    for (size_t i = count; i-- > 0;)
        if (state->device_memos[i].error.status != FM_OK)
            plan->unknown = state->device_memos[i].error;
}

static fm_status expand_all(expansion *state, const fm_plan_request *request)
{
    const fm_status status = make_memos(state, request);
    if (status != FM_OK)
        return status;
    if (count_cases(&state->chosen) > FM_PLAN_MAX_CASES)
        return fm_fail(state->err, FM_INVALID, "the axes make more than %d cases",
                       FM_PLAN_MAX_CASES);
    return expand(state);
}

fm_status plan_expand(fm_plan *plan, const fm_plan_request *request, const fm_plugin_list *plugins,
                      fm_error *err)
{
    fm_error own;
    expansion state = { .err = err != NULL ? err : &own };
    *plan = (fm_plan){ 0 };
    fm_status status = chosen_create(&state.chosen, request, plugins, state.err);
    if (status == FM_OK)
        status = expand_all(&state, request);
    if (status == FM_OK) {
        fill_run(plan, &state.chosen.selection);
        plan->cases = state.cases;
        plan->count = state.count;
        cap_launches(plan);
        tell_unknown(plan, &state);
        state.cases = NULL;
    }
    for (size_t i = 0; state.cases != NULL && i < state.count; i++)
        plan_case_release(&state.cases[i]);
    text_index_free(&state.ids);
    free(state.cases);
    free(state.device_memos);
    chosen_destroy(&state.chosen);
    return status;
}

uint32_t plan_case_launches(const fm_plan *plan, size_t index)
{
    const uint32_t own = plan->cases[index].settings.launches;
    return own > 0 && own < plan->launches ? own : plan->launches;
}

uint32_t plan_case_least_launches(const fm_plan *plan, size_t index)
{
    fm_precision_looks looks;
    const uint32_t most = plan_case_launches(plan, index);
    if (plan->cases[index].settings.precision_percent <= 0.0 || most == 0)
        return most;
    precision_looks(&looks, most);
    return looks.launches[0];
}

void plan_free(fm_plan *plan)
{
    for (size_t i = 0; i < plan->count; i++)
        plan_case_release(&plan->cases[i]);
    free(plan->cases);
    text_free(&plan->shard.table);
    *plan = (fm_plan){ 0 };
}

void plan_hash(char hash[17], const fm_plan *plan, bool validation, bool no_timers)
{
    XXH3_state_t *state = XXH3_createState();
    const uint64_t numbers[] = { plan->seed,   plan->launches, plan->frames,
                                 plan->warmup, validation,     no_timers };
    const uint32_t shard[] = { plan->shard.index, plan->shard.count };
    hash[0] = '\0';
    if (state == NULL)
        return;
    XXH3_64bits_reset(state);
    XXH3_64bits_update(state, numbers, sizeof numbers);
    for (size_t i = 0; i < plan->count; i++) {
        const uint32_t launches = plan_case_launches(plan, i);
        const double precision = plan->cases[i].settings.precision_percent;
        XXH3_64bits_update(state, plan->cases[i].id, strlen(plan->cases[i].id) + 1);
        XXH3_64bits_update(state, &launches, sizeof launches);
        if (precision > 0.0)
            XXH3_64bits_update(state, &precision, sizeof precision);
    }
    if (plan->shard.count > 0) {
        XXH3_64bits_update(state, shard, sizeof shard);
        XXH3_64bits_update(state, plan->shard.plan, strlen(plan->shard.plan));
    }
    snprintf(hash, 17, "%016llx", (unsigned long long)XXH3_64bits_digest(state));
    XXH3_freeState(state);
}

bool plan_index_ids(fm_text_index *ids, const fm_plan *plan)
{
    for (size_t i = 0; i < plan->count; i++)
        if (text_index_add(ids, plan->cases[i].id, i) == FM_TEXT_INDEX_NONE)
            return false;
    return true;
}

static uint32_t larger(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

/* A case that several specs want is measured as often as any of them wants it: until it is as
 * precise as each wants, or, if one wants a number of launches, the larger number. */
static void take_most(fm_settings *settings, const fm_settings *more)
{
    settings->precision_percent = fmin(settings->precision_percent, more->precision_percent);
    settings->launches = larger(settings->launches, more->launches);
    settings->frames = larger(settings->frames, more->frames);
    settings->warmup = larger(settings->warmup, more->warmup);
}

/* All ids of both plans; those of `more` that `plan` lacks are numbered as if they stood behind its
 * own. */
static bool index_both(fm_text_index *ids, const fm_plan *plan, const fm_plan *more)
{
    bool is_done = plan_index_ids(ids, plan);
    size_t next = plan->count;
    for (size_t i = 0; i < more->count && is_done; i++) {
        const size_t index = text_index_add(ids, more->cases[i].id, next);
        is_done = index != FM_TEXT_INDEX_NONE;
        next += index == next;
    }
    return is_done;
}

static void take_cases(fm_plan *plan, fm_plan *more, const fm_text_index *ids)
{
    for (size_t i = 0; i < more->count; i++) {
        const size_t index = text_index_find(ids, more->cases[i].id);
        if (index < plan->count)
            take_most(&plan->cases[index].settings, &more->cases[i].settings);
        else {
            plan->cases[plan->count++] = more->cases[i];
            more->cases[i] = (fm_case){ 0 }; /* what it owned is the plan's now */
        }
    }
}

fm_status plan_merge(fm_plan *plan, fm_plan *more, fm_error *err)
{
    fm_text_index ids = { 0 };
    fm_case *grown = reallocarray(plan->cases, plan->count + more->count + 1, sizeof *grown);
    if (grown != NULL)
        plan->cases = grown;
    const bool has_all = grown != NULL && index_both(&ids, plan, more);
    if (has_all)
        take_cases(plan, more, &ids);
    text_index_free(&ids);
    if (!has_all)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", plan->count + more->count);
    plan->seed = more->seed;
    if (plan->unknown.status == FM_OK)
        plan->unknown = more->unknown;
    plan->launches = larger(plan->launches, more->launches);
    plan->frames = larger(plan->frames, more->frames);
    plan->warmup = larger(plan->warmup, more->warmup);
    return FM_OK;
}
