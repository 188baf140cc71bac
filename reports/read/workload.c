#include "workload.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "options.h"

/* `k` and `n` are empty where a method does not use them. */
static const struct {
    const char *name;
    size_t offset;
    bool is_text, may_be_empty;
} workload_columns[] = {
    { "scene", offsetof(fm_case_row, scene), true, false },
    { "device", offsetof(fm_case_row, device), true, false },
    { "feed", offsetof(fm_case_row, feed), true, false },
    { "order", offsetof(fm_case_row, order), true, false },
    { "seed", offsetof(fm_case_row, seed), true, false },
    { "width_px", offsetof(fm_case_row, width_px), false, false },
    { "height_px", offsetof(fm_case_row, height_px), false, false },
    { "n", offsetof(fm_case_row, metric[FM_METRIC_N]), false, true },
    { "k", offsetof(fm_case_row, k), false, true },
    { "r", offsetof(fm_case_row, r), false, false },
    { "pixel_density", offsetof(fm_case_row, pixel_density), false, false },
    { "fragment_probability", offsetof(fm_case_row, fragment_probability), false, false },
    { "tessellation", offsetof(fm_case_row, tessellation), false, false },
};
enum { WORKLOAD_COLUMNS = sizeof workload_columns / sizeof workload_columns[0] };

static const char *text_of(const fm_case_row *row, size_t column)
{
    const void *field = (const char *)row + workload_columns[column].offset;
    return *(const char *const *)field;
}

static double number_of(const fm_case_row *row, size_t column)
{
    const void *field = (const char *)row + workload_columns[column].offset;
    return *(const double *)field;
}

static bool same_column(const fm_case_row *a, const fm_case_row *b, size_t column)
{
    if (workload_columns[column].is_text)
        return strcmp(text_of(a, column), text_of(b, column)) == 0;
    const double x = number_of(a, column), y = number_of(b, column);
    if (isnan(x) || isnan(y))
        return workload_columns[column].may_be_empty || (isnan(x) && isnan(y));
    return x == y;
}

/* n = r k layers grow with k: who may differ in k may differ in n. */
static bool is_free(const fm_text_list *free_columns, const char *name, const fm_case_row *a)
{
    return text_list_has(free_columns, name) ||
           (strcmp(name, "n") == 0 && !isnan(a->r) && text_list_has(free_columns, "k"));
}

/* A case that was never opened on its device has not got the device's name. */
static bool same_device(const fm_case_row *a, const fm_case_row *b)
{
    return a->device_name[0] == '\0' || b->device_name[0] == '\0' ||
           strcmp(a->device_name, b->device_name) == 0;
}

bool workload_same_of_any_seed(const fm_case_row *a, const fm_case_row *b,
                               const fm_text_list *free_columns)
{
    for (size_t i = 0; i < WORKLOAD_COLUMNS; i++)
        if (strcmp(workload_columns[i].name, "seed") != 0 &&
            !is_free(free_columns, workload_columns[i].name, a) && !same_column(a, b, i))
            return false;
    return (text_list_has(free_columns, "device") || same_device(a, b)) &&
           options_are_same(a->options, b->options, FM_OPTIONS_OF_SCENE, free_columns);
}

bool workload_same(const fm_case_row *a, const fm_case_row *b, const fm_text_list *free_columns)
{
    return (text_list_has(free_columns, "seed") || strcmp(a->seed, b->seed) == 0) &&
           workload_same_of_any_seed(a, b, free_columns);
}

void workload_key(char key[WORKLOAD_KEY_BYTES], const fm_case_row *result,
                  const fm_text_list *free_columns)
{
    size_t used = 0;
    key[0] = '\0';
    for (size_t i = 0; i < WORKLOAD_COLUMNS && used < WORKLOAD_KEY_BYTES; i++) {
        if (workload_columns[i].may_be_empty ||
            is_free(free_columns, workload_columns[i].name, result))
            continue;
        if (workload_columns[i].is_text)
            used +=
                (size_t)snprintf(key + used, WORKLOAD_KEY_BYTES - used, "|%s", text_of(result, i));
        else if (isnan(number_of(result, i)))
            used += (size_t)snprintf(key + used, WORKLOAD_KEY_BYTES - used, "|");
        else /* -0 equals 0 */
            used += (size_t)snprintf(key + used, WORKLOAD_KEY_BYTES - used, "|%.17g",
                                     number_of(result, i) + 0.0);
    }
}

void workload_name(char *name, size_t room, const fm_result_files *results, const bool *takes,
                   const fm_case_row *result)
{
    size_t used = 0;
    name[0] = '\0';
    for (size_t i = 0; i < WORKLOAD_COLUMNS && used + 40 < room; i++) {
        bool differs = false;
        for (size_t j = 0; j < results->count && takes != NULL && !differs; j++)
            differs = takes[j] && !same_column(result, &results->cases[j], i);
        const bool is_known = workload_columns[i].is_text ? text_of(result, i)[0] != '\0'
                                                          : !isnan(number_of(result, i));
        if (!differs || !is_known)
            continue;
        if (workload_columns[i].is_text)
            used += (size_t)snprintf(name + used, room - used, ", %.24s", text_of(result, i));
        else
            used += (size_t)snprintf(name + used, room - used, ", %s %.6g",
                                     workload_columns[i].name, number_of(result, i));
    }
}
