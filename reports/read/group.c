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
    bool alone = true, several = false;
    if (isnan(result->k))
        return false;
    for (size_t i = 0; i < group->count; i++) {
        const fm_case_row *other = group->cases[i];
        several |= !isnan(other->k) && other->k != result->k;
        alone &= other == result || !group_same_series(other, result);
    }
    return !(alone && several);
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
    options_select(options, one->options, FM_OPTIONS_OF_SCENE, NULL);
    used = strlen(group->workload);
    if (options[0] != '\0')
        snprintf(group->workload + used, room - used, ", %s", options);
}

/* Letters, digits and hyphens of scene, device and feed, and a number when that is not unique. */
static void name_group(fm_groups *groups, size_t index)
{
    fm_group *group = &groups->groups[index];
    const fm_case_row *one = group->cases[0];
    char text[128];
    snprintf(text, sizeof text, "%.50s-%.40s-%.24s", one->scene, one->device, one->feed);
    for (char *at = text; *at != '\0'; at++)
        *at = isalnum((unsigned char)*at) ? *at : '-';
    size_t number = 1;
    snprintf(group->name, sizeof group->name, "%.120s", text);
    for (size_t i = 0; i < index; i++)
        if (strcmp(groups->groups[i].name, group->name) == 0) {
            snprintf(group->name, sizeof group->name, "%.100s-%zu", text, ++number);
            i = (size_t)-1; /* look again with the new name */
        }
}

static fm_group *find_group(fm_groups *groups, const fm_case_row *result, size_t case_limit,
                            const fm_text_list *free_columns)
{
    for (size_t i = 0; i < groups->count; i++)
        if (workload_same(groups->groups[i].cases[0], result, free_columns))
            return &groups->groups[i];
    fm_group *grown = reallocarray(groups->groups, groups->count + 1, sizeof *grown);
    if (grown == NULL)
        return NULL;
    groups->groups = grown;
    grown[groups->count] = (fm_group){ .cases = calloc(case_limit, sizeof(void *)) };
    return grown[groups->count].cases == NULL ? NULL : &grown[groups->count++];
}

/* Each case into the group that it may stand in; false: no memory. */
static bool collect(fm_groups *groups, const fm_result_files *results, const fm_groups_desc *desc,
                    const fm_text_list *free_columns)
{
    for (size_t i = 0; i < results->count; i++) {
        const fm_case_row *result = &results->cases[i];
        if (desc->filter != NULL && !desc->filter(result, desc->context))
            continue;
        fm_group *group = find_group(groups, result, results->count, free_columns);
        if (group == NULL)
            return false;
        group->cases[group->count++] = result;
    }
    return true;
}

fm_status groups_make(fm_groups *groups, const fm_result_files *results, const fm_groups_desc *desc,
                      fm_error *err)
{
    fm_status status = FM_OK;
    fm_text_list free_columns = { 0 };
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
        name_group(groups, i);
    }
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
