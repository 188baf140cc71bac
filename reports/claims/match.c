#include "match.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "group.h"
#include "text.h"

/* What tells workloads apart; `k` and `n` are empty where a method does not use them. */
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
    { "n", offsetof(fm_case_row, n), false, true },
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
static bool is_free(const fm_name_list *free_columns, const char *name)
{
    return name_list_names(free_columns, name) ||
           (strcmp(name, "n") == 0 && name_list_names(free_columns, "k"));
}

bool match_workload(const fm_case_row *a, const fm_case_row *b, const fm_name_list *free_columns)
{
    for (size_t i = 0; i < WORKLOAD_COLUMNS; i++)
        if (!is_free(free_columns, workload_columns[i].name) && !same_column(a, b, i))
            return false;
    return group_same_scene_options(a, b, free_columns);
}

/* ---- tests ---- */

/* Texts are compared, or numbers where both are. */
static bool value_matches(const char *cell, const char *wanted)
{
    double limit, number;
    if (strncmp(wanted, "not ", 4) == 0)
        return !value_matches(cell, wanted + 4);
    const size_t sign = strspn(wanted, "<>=");
    const char *rest = wanted + sign + strspn(wanted + sign, " ");
    if (sign == 0 || !text_to_double(&limit, rest))
        return strcmp(cell, wanted) == 0 ||
               (text_to_double(&number, cell) && text_to_double(&limit, wanted) && number == limit);
    if (!text_to_double(&number, cell))
        return false;
    return (wanted[0] == '>' && number > limit) || (wanted[0] == '<' && number < limit) ||
           (wanted[sign - 1] == '=' && number == limit);
}

static bool test_matches(const fm_claim_test *test, const char *cell)
{
    if (test->value->kind == FM_YAML_SCALAR)
        return value_matches(cell, test->value->text);
    for (size_t i = 0; i < test->value->count; i++)
        if (value_matches(cell, test->value->items[i].text))
            return true;
    return false;
}

/* The value of key in "key=value key=value"; "" when it is not there. */
void match_option(char value[128], const char *options, const char *key)
{
    const size_t length = strlen(key);
    value[0] = '\0';
    while (*options != '\0') {
        const size_t pair = strcspn(options, " ");
        if (pair > length && options[length] == '=' && strncmp(options, key, length) == 0)
            snprintf(value, 128, "%.*s", (int)(pair - length - 1), options + length + 1);
        options += pair;
        options += strspn(options, " ");
    }
}

bool match_row(const fm_selection *selection, const fm_claim_rows *rows, size_t row)
{
    const fm_table *table = rows->results->summary;
    for (size_t i = 0; i < selection->test_count; i++) {
        char option[128];
        const char *cell = option;
        const size_t column = table_column(table, selection->tests[i].key);
        if (column != FM_TABLE_NO_COLUMN)
            cell = table_cell(table, row, column);
        else
            match_option(option, rows->results->cases[row].options, selection->tests[i].key);
        if (!test_matches(&selection->tests[i], cell))
            return false;
    }
    return true;
}

bool match_takes(const fm_claim *claim, const fm_claim_rows *rows, size_t row)
{
    const fm_case_row *result = &rows->results->cases[row];
    if (rows->takes != NULL && !rows->takes[row])
        return false;
    if (claim->where == FM_CLAIM_GPU)
        return !result->is_software;
    return claim->where != FM_CLAIM_HAZARDS || !result->is_software ||
           strcmp(result->feed, "compute-adjacent") == 0;
}

bool match_memory_row(const fm_selection *selection, const fm_claim_rows *rows, size_t row)
{
    const fm_table *table = rows->memory;
    if (strcmp(table_cell(table, row, table_column(table, "figure")), rows->figure) != 0)
        return false;
    for (size_t i = 0; i < selection->test_count; i++)
        if (!test_matches(&selection->tests[i],
                          table_cell(table, row, table_column(table, selection->tests[i].key))))
            return false;
    return true;
}

void match_name_columns(char *name, size_t room, const fm_claim_rows *rows,
                        const fm_case_row *result)
{
    size_t used = 0;
    name[0] = '\0';
    for (size_t i = 0; i < WORKLOAD_COLUMNS && used + 40 < room; i++) {
        bool differs = false;
        for (size_t j = 0; j < rows->results->count && !differs; j++)
            differs = (rows->takes == NULL || rows->takes[j]) &&
                      !same_column(result, &rows->results->cases[j], i);
        if (!differs || (!workload_columns[i].is_text && isnan(number_of(result, i))))
            continue;
        if (workload_columns[i].is_text)
            used += (size_t)snprintf(name + used, room - used, ", %.24s", text_of(result, i));
        else
            used += (size_t)snprintf(name + used, room - used, ", %s %.6g",
                                     workload_columns[i].name, number_of(result, i));
    }
}
