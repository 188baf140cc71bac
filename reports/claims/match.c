#include "match.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "read/options.h"

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

bool match_row(const fm_claim_selection *selection, const fm_claim_rows *rows, size_t row)
{
    const fm_table *table = rows->results->summary;
    for (size_t i = 0; i < selection->test_count; i++) {
        char option[FM_OPTION_VALUE_BYTES];
        const char *cell = option;
        const size_t column = table_column(table, selection->tests[i].key);
        options_value(option, rows->results->cases[row].options, selection->tests[i].key);
        if (option[0] == '\0' && column != FM_TABLE_NO_COLUMN)
            cell = table_cell(table, row, column);
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
    if (claim->where == FM_CLAIM_SOFTWARE)
        return result->is_software;
    return claim->where != FM_CLAIM_HAZARDS || !result->is_software ||
           strcmp(result->feed, "compute-adjacent") == 0;
}

bool match_memory_row(const fm_claim_selection *selection, const fm_claim_rows *rows, size_t row)
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
