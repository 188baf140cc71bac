#include "values.h"

#include <math.h>

#include "read/case_metrics.h"

fm_interval value_measured(const fm_claim_selection *selection, const fm_claim_rows *rows,
                           const fm_case_row *result)
{
    return case_interval(rows->results, result, text_list_items(&selection->metrics),
                         selection->metrics.count);
}

fm_interval value_by_formula(const fm_claim_selection *selection, const fm_case_row *result)
{
    const double pixels = result->width_px * result->height_px;
    const double factors[FM_FORMULA_TERMS] = { 1.0, pixels, pixels * result->k,
                                               pixels * result->metric[FM_METRIC_N],
                                               result->metric[FM_METRIC_FRAGMENTS_GENERATED] };
    double sum = 0.0;
    for (int i = 0; i < FM_FORMULA_TERMS; i++)
        if (selection->formula[i] != 0.0)
            sum += selection->formula[i] * factors[i];
    return interval_exact(sum);
}

double value_of_memory(const fm_claim_selection *selection, const fm_claim_rows *rows, size_t row)
{
    double sum = 0.0;
    for (size_t i = 0; i < selection->metrics.count; i++) {
        double value = NAN;
        table_number(&value, rows->memory, row,
                     table_column(rows->memory, selection->metrics.items[i]), NULL);
        sum += value;
    }
    return sum;
}

bool value_is_taken(const fm_claim_selection *selection, double value, double best)
{
    return selection->take == FM_TAKE_GREATEST ? value > best : value < best;
}
