#include "memory_points.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "values.h"

/* Of the same column of the paper's table, unless the selection names one; of the same row, if it
 * names nothing. */
static double memory_partner(const fm_claim_selection *selection, const fm_claim_rows *rows,
                             size_t row)
{
    const size_t workload = table_column(rows->memory, "workload");
    const fm_text_list *own = &selection->own_columns;
    double found = NAN;
    if (own->count == 0)
        return value_of_memory(selection, rows, row);
    for (size_t i = 0; i < rows->memory->row_count; i++) {
        if (!match_memory_row(selection, rows, i) ||
            (!text_list_has(own, "workload") &&
             strcmp(table_cell(rows->memory, i, workload),
                    table_cell(rows->memory, row, workload)) != 0))
            continue;
        const double value = value_of_memory(selection, rows, i);
        if (isnan(found) || value_is_taken(selection, value, found))
            found = value;
    }
    return found;
}

void memory_points_add(fm_claim_points *points, const fm_claim *claim, const fm_claim_rows *rows,
                       size_t index)
{
    for (size_t row = 0; rows->memory != NULL && row < rows->memory->row_count; row++) {
        if (!match_memory_row(&claim->of[index], rows, row))
            continue;
        double value = value_of_memory(&claim->of[index], rows, row);
        if (claim->has_minus)
            value -= memory_partner(&claim->minus, rows, row);
        if (claim->has_over_minus)
            value /= memory_partner(&claim->over, rows, row) -
                     memory_partner(&claim->over_minus, rows, row);
        else if (claim->has_over)
            value /= memory_partner(&claim->over, rows, row);
        if (!isfinite(value)) {
            if (points->missing_count++ == 0)
                snprintf(points->missing, sizeof points->missing, "memory.csv lacks a number");
        } else {
            claim_points_add(points, &(fm_claim_point){ .value = interval_exact(value),
                                                        .x = NAN,
                                                        .row = row,
                                                        .selection = index });
        }
    }
}
