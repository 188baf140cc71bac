#include "shard.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cost.h"
#include "plan_case.h"

/* Cases that stay together. */
typedef struct group {
    size_t first; /* case */
    double seconds;
    uint32_t shard;
} group;

typedef struct dealing {
    const fm_plan *plan;
    size_t *group_of; /* [plan->count] */
    group *groups;    /* [group_count] */
    size_t group_count;
    bool *is_reference; /* [plan->count] */
    char reference[sizeof((fm_case *)NULL)->method];
} dealing;

static fm_status no_memory(const fm_plan *plan, fm_error *err)
{
    return fm_fail(err, FM_NO_MEMORY, "no memory for the shards of %zu cases", plan->count);
}

fm_status shard_parse(fm_shard_desc *desc, const char *text, fm_error *err)
{
    char index_text[24];
    uint64_t index = 0, count = 0;
    const char *slash = strchr(text, '/');
    const size_t length = slash != NULL ? (size_t)(slash - text) : 0;
    if (length == 0 || length >= sizeof index_text)
        return fm_fail(err, FM_INVALID, "--shard %s: I/N, as in 2/16, please", text);
    snprintf(index_text, sizeof index_text, "%.*s", (int)length, text);
    if (!text_to_u64(&index, index_text) || !text_to_u64(&count, slash + 1))
        return fm_fail(err, FM_INVALID, "--shard %s: I/N, two whole numbers, please", text);
    if (count == 0 || count > FM_SHARDS_MAX)
        return fm_fail(err, FM_INVALID, "--shard %s: 1 to %d shards, please", text, FM_SHARDS_MAX);
    if (index == 0 || index > count)
        return fm_fail(err, FM_INVALID, "--shard %s: the shards are 1/%u to %u/%u", text,
                       (unsigned)count, (unsigned)count, (unsigned)count);
    desc->index = (uint32_t)index;
    desc->count = (uint32_t)count;
    return FM_OK;
}

/* What all cases of a group have in common. */
static void add_key(fm_text *key, const fm_case *planned)
{
    char value[FM_PATH_MAX_BYTES];
    text_add(key, "%s\n%s\n%s", planned->scene, planned->device, planned->feed);
    for (size_t i = 0; i < fm_key_count; i++) {
        const bool follows_k = planned->settings.r != 0 && strcmp(fm_keys[i].name, "n") == 0;
        if (fm_keys[i].scope != FM_SCOPE_SCENE || follows_k)
            continue;
        settings_text(value, &planned->settings, &fm_keys[i]);
        text_add(key, "\n%s", value);
    }
}

static fm_status find_groups(dealing *deal, fm_error *err)
{
    fm_text_index keys = { 0 };
    fm_text key = { 0 };
    bool is_done = true;
    for (size_t i = 0; i < deal->plan->count && is_done; i++) {
        key.length = 0;
        add_key(&key, &deal->plan->cases[i]);
        const size_t index =
            key.failed ? FM_TEXT_INDEX_NONE : text_index_add(&keys, key.bytes, deal->group_count);
        is_done = index != FM_TEXT_INDEX_NONE;
        if (index == deal->group_count)
            deal->groups[deal->group_count++] = (group){ .first = i };
        if (is_done)
            deal->group_of[i] = index;
    }
    text_free(&key);
    text_index_free(&keys);
    return is_done ? FM_OK : no_memory(deal->plan, err);
}

/* FM_INVALID: a method that was named is not there. */
static fm_status find_reference(dealing *deal, const char *wanted, fm_error *err)
{
    const fm_plan *plan = deal->plan;
    const char *name = wanted != NULL ? wanted : FM_SHARD_REFERENCE;
    fm_text_list methods = { 0 };
    fm_status status = FM_OK;
    for (size_t i = 0; i < plan->count; i++) {
        if (strcmp(plan->cases[i].method, name) == 0)
            snprintf(deal->reference, sizeof deal->reference, "%s", name);
        if (!text_list_has(&methods, plan->cases[i].method))
            text_list_add(&methods, plan->cases[i].method);
    }
    if (deal->reference[0] == '\0' && wanted != NULL && strcmp(wanted, "none") != 0 &&
        plan->count > 0) {
        const char *nearest = text_nearest(wanted, text_list_items(&methods), methods.count);
        status = fm_fail(err, FM_INVALID, "--shard-reference: the plan has no method '%s'; %s '%s'",
                         wanted, nearest != NULL ? "the nearest is" : "it has",
                         nearest != NULL ? nearest : plan->cases[0].method);
    }
    text_list_free(&methods);
    return status;
}

/* Of each device and feed the first of the shortest. */
static fm_status mark_references(dealing *deal, fm_error *err)
{
    const fm_plan *plan = deal->plan;
    size_t *best = calloc(plan->count + 1, sizeof *best), place_count = 0;
    char place[sizeof plan->cases->device + sizeof plan->cases->feed];
    fm_text_index places = { 0 };
    bool is_done = best != NULL;
    for (size_t i = 0; i < plan->count && is_done; i++) {
        if (plan->cases[i].skip != NULL || strcmp(plan->cases[i].method, deal->reference) != 0)
            continue;
        snprintf(place, sizeof place, "%s\n%s", plan->cases[i].device, plan->cases[i].feed);
        const size_t at = text_index_add(&places, place, place_count);
        is_done = at != FM_TEXT_INDEX_NONE;
        if (is_done &&
            (at == place_count || plan_case_seconds(plan, i) < plan_case_seconds(plan, best[at])))
            best[at] = i;
        place_count += at == place_count;
    }
    for (size_t i = 0; i < place_count && is_done; i++)
        deal->is_reference[best[i]] = true;
    text_index_free(&places);
    free(best);
    return is_done ? FM_OK : no_memory(plan, err);
}

/* What takes long first; then in the order of the plan. */
static int compare_groups(const void *left, const void *right)
{
    const group *a = *(group *const *)left, *b = *(group *const *)right;
    if (a->seconds > b->seconds || a->seconds < b->seconds)
        return a->seconds > b->seconds ? -1 : 1;
    return (a->first > b->first) - (a->first < b->first);
}

static uint32_t least_of(const double *seconds, uint32_t count)
{
    uint32_t least = 0;
    for (uint32_t i = 1; i < count; i++)
        least = seconds[i] < seconds[least] ? i : least;
    return least;
}

/* References are left out: each shard has them all. */
static fm_status deal_groups(dealing *deal, uint32_t count, fm_error *err)
{
    double *seconds = calloc(count, sizeof *seconds);
    group **order = calloc(deal->group_count + 1, sizeof(group *));
    const bool has_room = seconds != NULL && order != NULL;
    for (size_t i = 0; i < deal->plan->count; i++)
        if (!deal->is_reference[i])
            deal->groups[deal->group_of[i]].seconds += plan_case_seconds(deal->plan, i);
    for (size_t i = 0; has_room && i < deal->group_count; i++)
        order[i] = &deal->groups[i];
    if (has_room)
        qsort(order, deal->group_count, sizeof(group *), compare_groups);
    for (size_t i = 0; has_room && i < deal->group_count; i++) {
        const uint32_t least = least_of(seconds, count);
        seconds[least] += order[i]->seconds;
        order[i]->shard = least + 1;
    }
    free(order);
    free(seconds);
    return has_room ? FM_OK : no_memory(deal->plan, err);
}

/* shard.csv: all cases of the whole plan, in its order, so that who merges knows what lacks. */
static void write_table(fm_text *table, const dealing *deal)
{
    text_add(table, "case_id,shard,is_reference\n");
    for (size_t i = 0; i < deal->plan->count; i++)
        text_add(table, "%s,%u,%d\n", deal->plan->cases[i].id,
                 deal->groups[deal->group_of[i]].shard, deal->is_reference[i]);
}

static fm_status deal_cases(dealing *deal, const fm_shard_desc *desc, fm_error *err)
{
    const size_t room = deal->plan->count + 1;
    deal->group_of = calloc(room, sizeof *deal->group_of);
    deal->groups = calloc(room, sizeof *deal->groups);
    deal->is_reference = calloc(room, sizeof *deal->is_reference);
    if (deal->group_of == NULL || deal->groups == NULL || deal->is_reference == NULL)
        return no_memory(deal->plan, err);
    fm_status status = find_reference(deal, desc->reference, err);
    if (status == FM_OK)
        status = find_groups(deal, err);
    if (status == FM_OK)
        status = mark_references(deal, err);
    return status == FM_OK ? deal_groups(deal, desc->count, err) : status;
}

static void keep_cases(fm_plan *plan, const dealing *deal, uint32_t index)
{
    size_t kept = 0;
    for (size_t i = 0; i < plan->count; i++) {
        if (deal->is_reference[i] || deal->groups[deal->group_of[i]].shard == index)
            plan->cases[kept++] = plan->cases[i];
        else
            plan_case_release(&plan->cases[i]);
    }
    plan->count = kept;
}

fm_status plan_shard(fm_plan *plan, const fm_shard_desc *desc, fm_error *err)
{
    dealing deal = { .plan = plan };
    fm_shard shard = { .index = desc->index, .count = desc->count, .case_count = plan->count };
    fm_status status = deal_cases(&deal, desc, err);
    if (status == FM_OK) {
        plan_hash(shard.plan, plan, false, false);
        shard.group_count = deal.group_count;
        snprintf(shard.reference, sizeof shard.reference, "%s", deal.reference);
        write_table(&shard.table, &deal);
        if (shard.table.failed)
            status = no_memory(plan, err);
    }
    if (status == FM_OK) {
        keep_cases(plan, &deal, desc->index);
        plan->shard = shard;
    } else
        text_free(&shard.table);
    free(deal.is_reference);
    free(deal.groups);
    free(deal.group_of);
    return status;
}
