#include "numbers.h"

#include <math.h>
#include <stdlib.h>

#include "base/stats.h"

double numbers_of_launch(const fm_case_result *result, uint32_t launch, ab_statistic statistic)
{
    static const fm_metric metrics[AB_STATISTIC_COUNT] = {
        [AB_TIME] = FM_METRIC_FRAME_MS,
        [AB_CPU] = FM_METRIC_FRAME_CPU_MS,
    };
    size_t count = 0;
    double *values = malloc((result->sample_count + 1) * sizeof *values);
    if (values == NULL)
        return NAN;
    for (size_t i = 0; i < result->sample_count; i++)
        if (result->samples[i].launch == launch && result->samples[i].metric == metrics[statistic])
            values[count++] = result->samples[i].value;
    const double median = stats_median(values, count); /* which sorts them */
    const double number = statistic == AB_CPU && count > 0 ? values[0] : median;
    free(values);
    return number;
}
