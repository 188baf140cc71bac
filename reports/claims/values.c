#include "values.h"

#include <math.h>

#include "read/case_metrics.h"

/* What timings scatter by from process to process where a processor does the work. */
static const double few_samples_share = 0.15;

static bool is_time(const fm_text_list *metrics)
{
    for (size_t i = 0; i < metrics->count; i++)
        if (metric_is_time(metrics->items[i]))
            return true;
    return false;
}

static fm_interval widened(fm_interval value)
{
    value.low = fmin(value.low, value.median * (1.0 - few_samples_share));
    value.high = fmax(value.high, value.median * (1.0 + few_samples_share));
    return value;
}

fm_interval value_measured(bool *has_few_samples, const fm_claim_selection *selection,
                           const fm_claim_rows *rows, const fm_case_row *result)
{
    size_t samples = 0;
    fm_interval value =
        case_interval(&samples, rows->results, result, text_list_items(&selection->metrics),
                      selection->metrics.count);
    if (samples == 0)
        samples = isnan(result->metric[FM_METRIC_SAMPLES])
                      ? 0
                      : (size_t)result->metric[FM_METRIC_SAMPLES];
    const bool is_single = result->is_software && result->metric[FM_METRIC_LAUNCHES] < 2.0;
    if (!is_time(&selection->metrics) || (samples >= FM_SAMPLES_WANTED && !is_single))
        return value;
    *has_few_samples = true;
    return widened(value);
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
    return (fm_interval){ sum, sum, sum };
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
