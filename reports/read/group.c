#include "group.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "options.h"
#include "workload.h"

bool group_same_series(const fm_case_row *a, const fm_case_row *b)
{
    return strcmp(a->method, b->method) == 0 &&
           options_are_same(a->options, b->options, FM_OPTIONS_OWN, NULL);
}

void group_series_title(char title[96], const fm_case_row *result, const fm_text_list *without)
{
    char options[FM_OPTIONS_TEXT_BYTES], unusual[FM_OPTIONS_TEXT_BYTES];
    options_drop(unusual, result->options, result->look.defaults);
    options_select(options, unusual, FM_OPTIONS_OWN, without);
    if (options[0] == '\0')
        snprintf(title, 96, "%.95s", result->look.title);
    else
        snprintf(title, 96, "%.40s (%.50s)", result->look.title, options);
}

bool group_uses_k(const fm_group *group, const fm_case_row *result)
{
    bool several = false;
    if (isnan(result->k))
        return false;
    for (size_t i = 0; i < group->count; i++) {
        const fm_case_row *other = group->cases[i];
        several |= !isnan(other->k) && other->k != result->k;
        if (other != result && group_same_series(other, result))
            return true;
    }
    return !several;
}

/* The usual one first, then counters=2 before counters=10. */
static int compare_options(const fm_case_row *a, const fm_case_row *b)
{
    char of_a[FM_OPTIONS_TEXT_BYTES], of_b[FM_OPTIONS_TEXT_BYTES];
    if (strcmp(a->options, b->options) == 0)
        return 0;
    options_drop(of_a, a->options, a->look.defaults);
    options_drop(of_b, b->options, b->look.defaults);
    return strverscmp(of_a, of_b);
}

static int compare_cases(const void *a, const void *b)
{
    const fm_case_row *x = *(const fm_case_row *const *)a;
    const fm_case_row *y = *(const fm_case_row *const *)b;
    int order = (int)x->look.is_control - (int)y->look.is_control;
    if (order == 0)
        order = (int)x->look.family - (int)y->look.family;
    if (order == 0)
        order = strcmp(x->method, y->method);
    if (order == 0)
        order = compare_options(x, y);
    if (order == 0)
        order = (x->k > y->k) - (x->k < y->k);
    return order != 0 ? order : (x > y) - (x < y);
}

static void add_number(char *text, size_t room, const char *name, double value)
{
    size_t used = strlen(text);
    if (!isnan(value))
        snprintf(text + used, room - used, "%s%s %.6g", used > 0 ? ", " : "", name, value);
}

bool group_is_stand_in(const char *scene)
{
    static const char *const names[] = { "bunny-in-cube", "palace", "hairball", "hotel",
                                         "ivy",           "engine", "temple" };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(scene, names[i]) == 0)
            return true;
    return false;
}

/* A case that knows what all of its group share: one that ran, if any did. */
static const fm_case_row *best_known(const fm_group *group)
{
    for (size_t i = 0; i < group->count; i++)
        if (group->cases[i]->device_name[0] != '\0' && !isnan(group->cases[i]->metric[FM_METRIC_N]))
            return group->cases[i];
    return group->cases[0];
}

static void describe(fm_group *group, const fm_text_list *free_columns)
{
    const fm_case_row *one = best_known(group);
    snprintf(group->title, sizeof group->title, "%s%.60s, %.20s%s%.50s, %.30s",
             group_is_stand_in(one->scene) ? "stand-in for " : "", one->scene, one->device,
             one->device_name[0] != '\0' ? ": " : "", one->device_name, one->feed);
    const struct {
        const char *column, *title;
        double value;
    } numbers[] = {
        { "n", "n =", one->metric[FM_METRIC_N] },
        { "r", "r =", one->r },
        { "pixel_density", "pixel density", one->pixel_density },
        { "fragment_probability", "survival", one->fragment_probability },
        { "tessellation", "tessellation", one->tessellation },
    };
    if (!text_list_has(free_columns, "width_px"))
        snprintf(group->workload, sizeof group->workload, "%.0f x %.0f pixels", one->width_px,
                 one->height_px);
    size_t room = sizeof group->workload;
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        if (!text_list_has(free_columns, numbers[i].column) && !(i == 0 && !isnan(one->r)))
            add_number(group->workload, room, numbers[i].title, numbers[i].value);
    size_t used = strlen(group->workload);
    if (one->order[0] != '\0')
        snprintf(group->workload + used, room - used, ", order %s", one->order);
    char options[FM_OPTIONS_TEXT_BYTES];
    options_select(options, one->options, FM_OPTIONS_OF_SCENE, free_columns);
    used = strlen(group->workload);
    if (options[0] != '\0')
        snprintf(group->workload + used, room - used, ", %s", options);
}

/* Letters, digits and hyphens of scene, device and feed, and a number when that is not unique. */
static bool name_group(fm_groups *groups, size_t index, fm_text_index *names)
{
    fm_group *group = &groups->groups[index];
    const fm_case_row *one = group->cases[0];
    char text[128];
    snprintf(text, sizeof text, "%.50s-%.40s-%.24s", one->scene, one->device, one->feed);
    for (char *at = text; *at != '\0'; at++)
        *at = isalnum((unsigned char)*at) ? *at : '-';
    snprintf(group->name, sizeof group->name, "%.120s", text);
    size_t owner = text_index_add(names, group->name, index);
    if (owner == FM_TEXT_INDEX_NONE)
        return false;
    fm_group *first = &groups->groups[owner];
    while (owner != index) {
        snprintf(group->name, sizeof group->name, "%.100s-%zu", text, ++first->same_names + 1);
        owner = text_index_add(names, group->name, index);
        if (owner == FM_TEXT_INDEX_NONE)
            return false;
    }
    return true;
}

/* What collecting needs: the first group of each key. */
typedef struct collection {
    fm_groups *groups;
    fm_text_index keys;
    const fm_text_list *free_columns;
} collection;

static fm_group *add_group(fm_groups *groups)
{
    fm_group *grown = reallocarray(groups->groups, groups->count + 1, sizeof *grown);
    if (grown == NULL)
        return NULL;
    groups->groups = grown;
    grown[groups->count] = (fm_group){ .next_alike = SIZE_MAX };
    return &grown[groups->count++];
}

/* The group of the case; a new one, if none is. Groups of another key cannot be. NULL: no memory.
 */
static fm_group *find_group(collection *into, const fm_case_row *result)
{
    char key[WORKLOAD_KEY_BYTES];
    fm_groups *groups = into->groups;
    workload_key(key, result, into->free_columns);
    const size_t first = text_index_add(&into->keys, key, groups->count);
    if (first == FM_TEXT_INDEX_NONE)
        return NULL;
    size_t last = SIZE_MAX;
    for (size_t i = first; i < groups->count; i = groups->groups[i].next_alike) {
        if (workload_same(groups->groups[i].cases[0], result, into->free_columns))
            return &groups->groups[i];
        last = i;
    }
    fm_group *added = add_group(groups);
    if (added != NULL && last != SIZE_MAX)
        groups->groups[last].next_alike = groups->count - 1;
    return added;
}

static bool add_case(fm_group *group, const fm_case_row *result)
{
    if (group->count == group->room) {
        const size_t room = group->room > 0 ? 2 * group->room : 8;
        const fm_case_row **grown = reallocarray(
            group->cases, room, sizeof *grown); /* NOLINT(bugprone-sizeof-expression) */
        if (grown == NULL)
            return false;
        group->cases = grown;
        group->room = room;
    }
    group->cases[group->count++] = result;
    return true;
}

/* Each case into the group that it may stand in; false: no memory. */
static bool collect(fm_groups *groups, const fm_result_files *results, const fm_groups_desc *desc,
                    const fm_text_list *free_columns)
{
    collection into = { .groups = groups, .free_columns = free_columns };
    bool is_done = true;
    for (size_t i = 0; i < results->count && is_done; i++) {
        const fm_case_row *result = &results->cases[i];
        if (desc->filter != NULL && !desc->filter(result, desc->context))
            continue;
        fm_group *group = find_group(&into, result);
        is_done = group != NULL && add_case(group, result);
    }
    text_index_free(&into.keys);
    return is_done;
}

fm_status groups_make(fm_groups *groups, const fm_result_files *results, const fm_groups_desc *desc,
                      fm_error *err)
{
    fm_status status = FM_OK;
    fm_text_list free_columns = { 0 };
    fm_text_index names = { 0 };
    *groups = (fm_groups){ 0 };
    if (!text_list_add_all(&free_columns, desc->free_columns) ||
        !text_list_add(&free_columns, "k") || !collect(groups, results, desc, &free_columns)) {
        status = fm_fail(err, FM_NO_MEMORY, "%zu cases", results->count);
        groups_free(groups);
    }
    for (size_t i = 0; i < groups->count; i++) {
        fm_group *group = &groups->groups[i];
        /* NOLINTNEXTLINE(bugprone-sizeof-expression): pointers are what is sorted */
        qsort(group->cases, group->count, sizeof group->cases[0], compare_cases);
        describe(group, &free_columns);
        if (!name_group(groups, i, &names)) {
            status = fm_fail(err, FM_NO_MEMORY, "%zu groups of cases", groups->count);
            groups_free(groups);
        }
    }
    text_index_free(&names);
    text_list_free(&free_columns);
    return status;
}

void groups_free(fm_groups *groups)
{
    for (size_t i = 0; i < groups->count; i++)
        free(groups->groups[i].cases);
    free(groups->groups);
    *groups = (fm_groups){ 0 };
}
