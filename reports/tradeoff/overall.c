#include "overall.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cheapest.h"
#include "read/options.h"

/* The groups of one device and feed that have an exact case, and its time. */
typedef struct bucket {
    const fm_group **groups;
    const fm_case_row **cheapest; /* its exact case that takes the least time, */
    fm_span *exact;               /* and how long that takes */
    size_t count;
} bucket;

static const fm_case_row *first_case(const fm_group *group)
{
    return group->cases[0];
}

static bool is_alike(const fm_group *a, const fm_group *b)
{
    return strcmp(first_case(a)->device, first_case(b)->device) == 0 &&
           strcmp(first_case(a)->feed, first_case(b)->feed) == 0;
}

/* false: no memory. */
static bool fill_bucket(bucket *b, const fm_groups *groups, size_t first, const fm_error_kind *kind)
{
    fm_cheapest cheapest[CHEAPEST_BOUNDS];
    b->count = 0;
    for (size_t i = first; i < groups->count; i++) {
        const fm_group *group = &groups->groups[i];
        if (group->count == 0 || !is_alike(group, &groups->groups[first]))
            continue;
        if (!cheapest_make(cheapest, group, kind))
            return false;
        if (cheapest[0].row == NULL)
            continue;
        b->groups[b->count] = group;
        b->cheapest[b->count] = cheapest[0].row;
        b->exact[b->count++] = standing_time(cheapest[0].row);
    }
    return true;
}

static size_t count_scenes(const bucket *b)
{
    size_t count = 0;
    for (size_t i = 0; i < b->count; i++) {
        bool is_new = true;
        for (size_t j = 0; j < i && is_new; j++)
            is_new = strcmp(first_case(b->groups[i])->scene, first_case(b->groups[j])->scene) != 0;
        count += is_new;
    }
    return count;
}

static bool is_same(const fm_case_row *a, const fm_case_row *b)
{
    return strcmp(a->method, b->method) == 0 && (a->k == b->k || (isnan(a->k) && isnan(b->k))) &&
           options_are_same(a->options, b->options, FM_OPTIONS_OWN, NULL);
}

/* The one case of that method, options and k which competes; NULL: none, or several. */
static const fm_case_row *find_same(const fm_group *group, const fm_case_row *wanted,
                                    const fm_error_kind *kind)
{
    const fm_case_row *found = NULL;
    for (size_t i = 0; i < group->count; i++) {
        const fm_case_row *one = group->cases[i];
        if (!one->is_ok || !standing_has_point(one, kind) || !is_same(one, wanted))
            continue;
        if (found != NULL)
            return NULL;
        found = one;
    }
    return found;
}

/* false: it lacks in a workload. */
static bool sum_up(fm_overall_point *point, const bucket *b, const fm_case_row *first,
                   const fm_error_kind *kind)
{
    fm_span logs = { 0 };
    *point = (fm_overall_point){ .row = first };
    for (size_t i = 0; i < b->count; i++) {
        const fm_case_row *one = find_same(b->groups[i], first, kind);
        if (one == NULL)
            return false;
        const fm_span time = standing_time(one);
        const fm_span ratio =
            one == b->cheapest[i] ? (fm_span){ 1, 1, 1 } : span_ratio(&time, &b->exact[i]);
        logs.value += log(ratio.value) / (double)b->count;
        logs.low += log(ratio.low) / (double)b->count;
        logs.high += log(ratio.high) / (double)b->count;
        point->error = fmax(point->error, error_kind_of(kind, one));
    }
    point->ratio = (fm_span){ exp(logs.value), exp(logs.low), exp(logs.high) };
    return true;
}

static fm_status make_one(fm_overall *overall, const bucket *b, const fm_error_kind *kind,
                          fm_error *err)
{
    const fm_group *first = b->groups[0];
    *overall = (fm_overall){ .device = first_case(first)->device,
                             .feed = first_case(first)->feed,
                             .workload_count = b->count,
                             .scene_count = count_scenes(b),
                             .points = calloc(first->count + 1, sizeof *overall->points) };
    if (overall->points == NULL)
        return fm_fail(err, FM_NO_MEMORY, "methods over %zu workloads", b->count);
    for (size_t i = 0; i < first->count; i++)
        if (!first->cases[i]->look.is_control &&
            sum_up(&overall->points[overall->point_count], b, first->cases[i], kind))
            overall->point_count++;
    return FM_OK;
}

static bool is_first_of_its_kind(const fm_groups *groups, size_t index)
{
    for (size_t i = 0; i < index; i++)
        if (groups->groups[i].count > 0 && is_alike(&groups->groups[i], &groups->groups[index]))
            return false;
    return groups->groups[index].count > 0;
}

fm_status overalls_make(fm_overalls *overalls, const fm_groups *groups, const fm_error_kind *kind,
                        fm_error *err)
{
    const size_t room = groups->count + 1;
    bucket b = { calloc(room, sizeof *b.groups), calloc(room, sizeof *b.cheapest),
                 calloc(room, sizeof *b.exact), 0 };
    *overalls = (fm_overalls){ calloc(room, sizeof *overalls->items), 0 };
    fm_status status =
        b.groups != NULL && b.cheapest != NULL && b.exact != NULL && overalls->items != NULL
            ? FM_OK
            : fm_fail(err, FM_NO_MEMORY, "%zu workloads", groups->count);
    for (size_t i = 0; i < groups->count && status == FM_OK; i++) {
        if (!is_first_of_its_kind(groups, i))
            continue;
        if (!fill_bucket(&b, groups, i, kind))
            status = fm_fail(err, FM_NO_MEMORY, "%zu workloads", groups->count);
        else if (count_scenes(&b) >= 2)
            status = make_one(&overalls->items[overalls->count++], &b, kind, err);
    }
    free(b.groups);
    free(b.cheapest);
    free(b.exact);
    return status;
}

void overalls_free(fm_overalls *overalls)
{
    for (size_t i = 0; i < overalls->count; i++)
        free(overalls->items[i].points);
    free(overalls->items);
    *overalls = (fm_overalls){ 0 };
}
