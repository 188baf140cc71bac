#include "group.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "settings.h"

/* "options" also holds keys of the scene that have no column: they belong to the workload. Copies
 * the pairs of one sort, but for those named in `without`, which may be NULL. */
static void select_options(char chosen[256], const char *options, bool of_scene,
                           const fm_name_list *without)
{
    size_t used = 0;
    chosen[0] = '\0';
    while (*options != '\0') {
        char name[64];
        size_t length = strcspn(options, " ");
        snprintf(name, sizeof name, "%.*s", (int)strcspn(options, "= "), options);
        const fm_key *key = key_find(name);
        bool is_scene = key != NULL && key->scope == FM_SCOPE_SCENE;
        const bool is_left_out = without != NULL && name_list_names(without, name);
        if (is_scene == of_scene && !is_left_out && used + length + 2 < 256)
            used += (size_t)snprintf(chosen + used, 256 - used, "%s%.*s", used > 0 ? " " : "",
                                     (int)length, options);
        options += length;
        options += strspn(options, " ");
    }
}

static bool same_options(const fm_case_row *a, const fm_case_row *b, bool of_scene,
                         const fm_name_list *without)
{
    char of_a[256], of_b[256];
    select_options(of_a, a->options, of_scene, without);
    select_options(of_b, b->options, of_scene, without);
    return strcmp(of_a, of_b) == 0;
}

bool group_same_scene_options(const fm_case_row *a, const fm_case_row *b,
                              const fm_name_list *without)
{
    return same_options(a, b, true, without);
}

bool group_same_own_options(const fm_case_row *a, const fm_case_row *b, const fm_name_list *without)
{
    return same_options(a, b, false, without);
}

static bool same_number(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

/* A case that was never opened on its device has not got the device's name. */
static bool same_device(const fm_case_row *a, const fm_case_row *b)
{
    return strcmp(a->device, b->device) == 0 &&
           (a->device_name[0] == '\0' || b->device_name[0] == '\0' ||
            strcmp(a->device_name, b->device_name) == 0);
}

/* n of a mesh is known only from truth, the same for all; n of r * k layers grows with k. */
static bool same_workload(const fm_case_row *a, const fm_case_row *b)
{
    return strcmp(a->scene, b->scene) == 0 && same_device(a, b) && strcmp(a->feed, b->feed) == 0 &&
           strcmp(a->order, b->order) == 0 && strcmp(a->seed, b->seed) == 0 &&
           same_number(a->width_px, b->width_px) && same_number(a->height_px, b->height_px) &&
           (isnan(a->n) || isnan(b->n) || a->n == b->n) && same_number(a->r, b->r) &&
           same_number(a->pixel_density, b->pixel_density) &&
           same_number(a->fragment_probability, b->fragment_probability) &&
           same_number(a->tessellation, b->tessellation) && same_options(a, b, true, NULL);
}

bool group_same_series(const fm_case_row *a, const fm_case_row *b)
{
    return strcmp(a->method, b->method) == 0 && same_options(a, b, false, NULL);
}

void group_series_title(char title[96], const fm_case_row *result)
{
    char options[256];
    select_options(options, result->options, false, NULL);
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
        order = strcmp(x->options, y->options);
    if (order == 0)
        order = (x->k > y->k) - (x->k < y->k);
    return order != 0 ? order : (x > y) - (x < y);
}

static void add_number(char *text, size_t room, const char *name, double value)
{
    size_t used = strlen(text);
    if (!isnan(value))
        snprintf(text + used, room - used, ", %s %.6g", name, value);
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
        if (group->cases[i]->device_name[0] != '\0' && !isnan(group->cases[i]->n))
            return group->cases[i];
    return group->cases[0];
}

static void describe(fm_group *group)
{
    const fm_case_row *one = best_known(group);
    snprintf(group->title, sizeof group->title, "%s%.60s, %.20s%s%.50s, %.30s",
             group_is_stand_in(one->scene) ? "stand-in for " : "", one->scene, one->device,
             one->device_name[0] != '\0' ? ": " : "", one->device_name, one->feed);
    snprintf(group->workload, sizeof group->workload, "%.0f x %.0f pixels", one->width_px,
             one->height_px);
    size_t room = sizeof group->workload;
    add_number(group->workload, room, "n =", one->n);
    add_number(group->workload, room, "r =", one->r);
    add_number(group->workload, room, "pixel density", one->pixel_density);
    add_number(group->workload, room, "survival", one->fragment_probability);
    add_number(group->workload, room, "tessellation", one->tessellation);
    size_t used = strlen(group->workload);
    if (one->order[0] != '\0')
        snprintf(group->workload + used, room - used, ", order %s", one->order);
    char options[256];
    select_options(options, one->options, true, NULL);
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

static fm_group *find_group(fm_groups *groups, const fm_case_row *result, size_t case_limit)
{
    for (size_t i = 0; i < groups->count; i++)
        if (same_workload(groups->groups[i].cases[0], result))
            return &groups->groups[i];
    fm_group *grown = reallocarray(groups->groups, groups->count + 1, sizeof *grown);
    if (grown == NULL)
        return NULL;
    groups->groups = grown;
    grown[groups->count] = (fm_group){ .cases = calloc(case_limit, sizeof(void *)) };
    return grown[groups->count].cases == NULL ? NULL : &grown[groups->count++];
}

fm_status groups_make(fm_groups *groups, const fm_result_files *results, fm_case_filter filter,
                      const void *context, fm_error *err)
{
    *groups = (fm_groups){ 0 };
    for (size_t i = 0; i < results->count; i++) {
        const fm_case_row *result = &results->cases[i];
        if (filter != NULL && !filter(result, context))
            continue;
        fm_group *group = find_group(groups, result, results->count);
        if (group == NULL) {
            groups_free(groups);
            return fm_fail(err, FM_NO_MEMORY, "%zu cases", results->count);
        }
        group->cases[group->count++] = result;
    }
    for (size_t i = 0; i < groups->count; i++) {
        fm_group *group = &groups->groups[i];
        /* NOLINTNEXTLINE(bugprone-sizeof-expression): pointers are what is sorted */
        qsort(group->cases, group->count, sizeof group->cases[0], compare_cases);
        describe(group);
        name_group(groups, i);
    }
    return FM_OK;
}

void groups_free(fm_groups *groups)
{
    for (size_t i = 0; i < groups->count; i++)
        free(groups->groups[i].cases);
    free(groups->groups);
    *groups = (fm_groups){ 0 };
}
