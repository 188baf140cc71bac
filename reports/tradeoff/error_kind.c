#include "error_kind.h"

#include <math.h>
#include <string.h>

#include "base/text.h"

static const fm_error_kind kinds[] = {
    { FM_METRIC_TOTAL_RMSE, 1e-6, true, FM_METRIC_FRAMES_TOTAL_RMSE_MAX },
    { FM_METRIC_TOTAL_MAX_ABS, 1e-5, true, FM_METRIC_COUNT },
    { FM_METRIC_TOTAL_SSIM, 1e-6, false, FM_METRIC_COUNT },
    { FM_METRIC_TOTAL_FLIP, 2e-4, false, FM_METRIC_COUNT },
    { FM_METRIC_RMSE, 1e-6, true, FM_METRIC_FRAMES_RMSE_MAX },
    { FM_METRIC_MAX_ABS, 1e-5, true, FM_METRIC_FRAMES_MAX_ABS },
    { FM_METRIC_SSIM, 1e-6, false, FM_METRIC_COUNT },
    { FM_METRIC_FLIP, 2e-4, false, FM_METRIC_COUNT },
    { FM_METRIC_COVERED_RMSE, 1e-6, true, FM_METRIC_COUNT },
    { FM_METRIC_COVERED_MAX_ABS, 1e-5, true, FM_METRIC_COUNT },
    { FM_METRIC_COVERED_SSIM, 1e-6, false, FM_METRIC_COUNT },
    { FM_METRIC_COVERED_FLIP, 2e-4, false, FM_METRIC_COUNT },
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

const fm_error_kind *error_kind_find(const char *name, const char **nearest)
{
    const char *names[KINDS];
    if (name == NULL)
        return &kinds[0];
    for (int i = 0; i < KINDS; i++) {
        names[i] = fm_metrics[kinds[i].metric].name;
        if (strcmp(names[i], name) == 0)
            return &kinds[i];
    }
    *nearest = text_nearest(name, names, KINDS);
    if (*nearest == NULL)
        *nearest = names[0];
    return NULL;
}

const fm_error_kind *error_kind_by_metric(fm_metric metric)
{
    for (int i = 0; i < KINDS; i++)
        if (kinds[i].metric == metric)
            return &kinds[i];
    return NULL;
}

double error_kind_of(const fm_error_kind *kind, const fm_case_row *result)
{
    const double last = result->metric[kind->metric];
    const double worst = kind->worst < FM_METRIC_COUNT ? result->metric[kind->worst] : NAN;
    const double value = worst > last ? worst : last;
    const double error = fm_metrics[kind->metric].better == FM_BETTER_MORE ? 1 - value : value;
    const double rounding = kind->exact_below * (kind->is_exposed ? case_brightness(result) : 1);
    return error <= rounding ? 0.0 : error;
}
