#include "noise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draws.h"

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
                          double least, fm_error *err)
{
    ab_judged judged;
    const fm_status status = judge_pairs(&judged, differences, policy->looks[0], policy,
                                         1.0 - policy->levels[0], least, err);
    if (status != FM_OK)
        return status;
    judged.adjusted = judged.p;
    judge_verdict(&judged, policy, 0);
    *alarm = judged.verdict == AB_WORSE || judged.verdict == AB_BETTER;
    return FM_OK;
}

static fm_status count_alarms(ab_noise_statistic *noise, const double *differences, size_t count,
                              const ab_policy *policy, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i + policy->looks[0] <= count && status == FM_OK; i += policy->looks[0]) {
        bool alarm = false;
        status = is_alarm(&alarm, differences + i, policy,
                          AB_ERRORS_THAT_COUNT * noise->standard_error, err);
        noise->gates++;
        noise->alarms += alarm;
    }
    return status;
}

static fm_status find_detectable(ab_noise_statistic *noise, const ab_draws *draws,
                                 ab_statistic statistic, const ab_policy *policy, fm_error *err)
{
    const uint32_t first[] = { policy->looks[0], 0 };
    const double least = AB_ERRORS_THAT_COUNT * noise->standard_error;
    ab_policy first_look;
    fm_status status = ab_policy_make(&first_look, first, err);
    first_look.band = policy->band;
    if (status == FM_OK)
        status =
            draws_detectable(&noise->detectable_first, draws, statistic, least, &first_look, err);
    return status == FM_OK
               ? draws_detectable(&noise->detectable, draws, statistic, least, policy, err)
               : status;
}

static fm_status take_statistic(ab_noise_statistic *noise, const ab_draws *draws,
                                ab_statistic statistic, const ab_policy *policy, fm_error *err)
{
    const double *differences = draws->differences[statistic];
    *noise = (ab_noise_statistic){ .deviation = deviation_of(differences, draws->count) };
    fm_status status = draws_error(&noise->standard_error, draws, statistic, policy->looks[0], err);
    if (status == FM_OK)
        status = find_detectable(noise, draws, statistic, policy, err);
    return status == FM_OK ? count_alarms(noise, differences, draws->count, policy, err) : status;
}

fm_status noise_of_pairs(ab_noise *noise, const double *const differences[AB_STATISTIC_COUNT],
                         size_t count, const ab_policy *policy, fm_error *err)
{
    ab_draws draws;
    fm_status status = draws_open(&draws, differences, count, err);
    noise->pairs = (uint32_t)draws.known_count;
    noise->planned = policy->looks[0];
    memset(noise->statistics, 0, sizeof noise->statistics);
    if (status == FM_OK && draws.known_count < policy->looks[0])
        status = fm_fail(err, FM_INVALID, "%zu pairs: a calibration needs at least %u",
                         draws.known_count, policy->looks[0]);
    for (int s = 0; s < AB_STATISTIC_COUNT && status == FM_OK; s++)
        if (differences[s] != NULL)
            status = take_statistic(&noise->statistics[s], &draws, (ab_statistic)s, policy, err);
    draws_close(&draws);
    return status;
}

static ab_noise *find_device(const ab_noise_list *list, const char *device_name)
{
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->items[i].device_name, device_name) == 0)
            return &list->items[i];
    return NULL;
}

double noise_least(const ab_noise_list *list, const char *device_name, ab_statistic statistic,
                   const ab_policy *policy)
{
    const ab_noise *noise = find_device(list, device_name);
    return noise != NULL ? AB_ERRORS_THAT_COUNT * noise->statistics[statistic].standard_error *
                               sqrt((double)noise->planned / (double)policy->looks[0])
                         : 0.0;
}

/* By the statistic that decides. Of two that detect the band alone, the one that scatters more. */
static bool is_noisier(const ab_noise *a, const ab_noise *b)
{
    const ab_statistic decisive = a->statistics[AB_CPU].detectable > 0.0 ? AB_CPU : AB_TIME;
    const ab_noise_statistic *x = &a->statistics[decisive], *y = &b->statistics[decisive];
    return x->detectable != y->detectable ? x->detectable > y->detectable
                                          : x->standard_error > y->standard_error;
}

fm_status noise_keep_noisiest(ab_noise_list *list, const ab_noise *noise, fm_error *err)
{
    const ab_noise *there = find_device(list, noise->device_name);
    return there == NULL || is_noisier(noise, there) ? noise_keep(list, noise, err) : FM_OK;
}

fm_status noise_keep(ab_noise_list *list, const ab_noise *noise, fm_error *err)
{
    ab_noise *there = find_device(list, noise->device_name);
    if (there != NULL) {
        *there = *noise;
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
