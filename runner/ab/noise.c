#include "noise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double deviation_of(const double *values, size_t count)
{
    double sum = 0.0, squares = 0.0;
    size_t known = 0;
    for (size_t i = 0; i < count; i++)
        if (!isnan(values[i])) {
            sum += values[i];
            known++;
        }
    for (size_t i = 0; i < count; i++)
        if (!isnan(values[i]))
            squares += (values[i] - sum / (double)known) * (values[i] - sum / (double)known);
    return known > 1 ? sqrt(squares / (double)(known - 1)) : 0.0;
}

/* What a gate of one case would say after its first look. */
static fm_status is_alarm(bool *alarm, const double *differences, const ab_policy *policy,
                          double noise, fm_error *err)
{
    ab_judged judged;
    const fm_status status = judge_pairs(&judged, differences, policy->looks[0], policy,
                                         1.0 - policy->levels[0], noise, err);
    if (status != FM_OK)
        return status;
    judged.adjusted = judged.p;
    judge_verdict(&judged, policy->levels[0]);
    *alarm = judged.verdict == AB_WORSE || judged.verdict == AB_BETTER;
    return FM_OK;
}

fm_status noise_of_pairs(ab_noise_statistic *noise, const double *differences, size_t count,
                         const ab_policy *policy, fm_error *err)
{
    ab_judged all;
    const uint32_t planned = policy->looks[0];
    *noise = (ab_noise_statistic){ .deviation = deviation_of(differences, count) };
    fm_status status = judge_pairs(&all, differences, count, policy, 0.95, 0.0, err);
    if (status == FM_OK && all.pairs < planned)
        status = fm_fail(err, FM_INVALID, "%zu pairs: a calibration needs at least %u", all.pairs,
                         planned);
    if (status != FM_OK)
        return status;
    noise->standard_error = all.median.standard_error * sqrt((double)all.pairs / (double)planned);
    for (size_t i = 0; i + planned <= count && status == FM_OK; i += planned) {
        bool alarm = false;
        status = is_alarm(&alarm, differences + i, policy, noise->standard_error, err);
        noise->gates++;
        noise->alarms += alarm;
    }
    return status;
}

double noise_detectable(const ab_noise_statistic *noise, const ab_noise *of, uint32_t pairs,
                        double band)
{
    const double error = noise->standard_error * sqrt((double)of->planned / (double)pairs);
    return fmax(band, expm1(3.0 * error));
}

double noise_find(const ab_noise_list *list, const char *device_name, ab_statistic statistic,
                  uint32_t planned)
{
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->items[i].device_name, device_name) == 0)
            return list->items[i].statistics[statistic].standard_error *
                   sqrt((double)list->items[i].planned / (double)planned);
    return 0.0;
}

fm_status noise_keep(ab_noise_list *list, const ab_noise *noise, fm_error *err)
{
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->items[i].device_name, noise->device_name) == 0) {
            list->items[i] = *noise;
            return FM_OK;
        }
    ab_noise *grown = reallocarray(list->items, list->count + 1, sizeof *grown);
    if (grown == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu calibrations", list->count + 1);
    list->items = grown;
    list->items[list->count++] = *noise;
    return FM_OK;
}

void noise_free(ab_noise_list *list)
{
    free(list->items);
    *list = (ab_noise_list){ 0 };
}
