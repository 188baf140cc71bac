#include "noise.h"

#include <math.h>
#include <stdlib.h>

#include "base/stats.h"

/* A number of a launch as a whole; NAN: it has none. */
static double number_of(const fm_case_result *result, uint32_t launch, fm_metric metric)
{
    for (size_t i = 0; i < result->sample_count; i++) {
        const fm_kept_sample *sample = &result->samples[i];
        if (sample->metric == metric && sample->launch == launch && sample->frame == FM_FRAME_NONE)
            return sample->value;
    }
    return NAN;
}

/* Of the time that its threads could have run, what they waited. */
static double waited_share(const fm_case_result *result, uint32_t launch)
{
    const double waited_s = number_of(result, launch, FM_METRIC_WAITED_S);
    return waited_s / (waited_s + number_of(result, launch, FM_METRIC_TIMED_CPU_S));
}

static bool was_throttled(const fm_case_result *result, uint32_t launch)
{
    const double share = number_of(result, launch, FM_METRIC_THROTTLED_S) /
                         number_of(result, launch, FM_METRIC_TIMED_S);
    return share > NOISE_THROTTLED_SHARE ||
           number_of(result, launch, FM_METRIC_THERMAL_EVENTS) > 0.0;
}

/* The shares that are known, of each launch; returns how many. */
static size_t add_shares(double *shares, const fm_case_result *result, uint32_t launches)
{
    size_t count = 0;
    for (uint32_t i = 0; i < launches && result->is_software; i++) {
        const double share = waited_share(result, i);
        if (!isnan(share))
            shares[count++] = share;
    }
    return count;
}

static double spread_of(const double *frame_ms, uint32_t launches)
{
    double least = INFINITY, greatest = 0.0;
    for (uint32_t i = 0; i < launches; i++) {
        least = fmin(least, frame_ms[i]);
        greatest = fmax(greatest, frame_ms[i]);
    }
    return least > 0.0 ? greatest / least : NAN;
}

static const char *separator(const fm_text *text, size_t before)
{
    return text->length > before ? "; " : "";
}

void noise_reasons(fm_text *text, const fm_case_result *result, uint32_t launches,
                   const double *frame_ms)
{
    const size_t before = text->length;
    uint32_t throttled = 0;
    double *shares = calloc((size_t)launches + 1, sizeof *shares);
    if (shares == NULL) {
        text->failed = true;
        return;
    }
    const double waited = stats_median(shares, add_shares(shares, result, launches));
    const double spread = spread_of(frame_ms, launches);
    for (uint32_t i = 0; i < launches; i++)
        throttled += was_throttled(result, i);
    if (waited > NOISE_WAITED_SHARE)
        text_add(text, "threads waited for a processor %.0f %% of the time", 100.0 * waited);
    if (throttled > 0 && 2 * throttled >= result->done)
        text_add(text, "%sthe processors were throttled in %u of %u launches",
                 separator(text, before), throttled, result->done);
    if (spread > NOISE_SPREAD)
        text_add(text, "%slaunches differ by a factor of %.2g", separator(text, before), spread);
    free(shares);
}

static double greatest_load(const fm_case_result *result)
{
    double load = NAN;
    for (size_t i = 0; i < result->sample_count; i++)
        if (result->samples[i].metric == FM_METRIC_LOAD_BEGIN ||
            result->samples[i].metric == FM_METRIC_LOAD_END)
            load = fmax(load, result->samples[i].value);
    return load;
}

fm_status noise_of_host(fm_noise_host *host, const fm_results *results, fm_error *err)
{
    const fm_plan *plan = results->plan;
    size_t count = 0;
    double *shares = calloc(plan->count * plan->launches + 1, sizeof *shares);
    *host = (fm_noise_host){ NAN, NAN };
    if (shares == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", plan->count);
    for (size_t i = 0; i < plan->count; i++) {
        count += add_shares(shares + count, &results->cases[i], plan->launches);
        host->load = fmax(host->load, greatest_load(&results->cases[i]));
    }
    host->waited_share = stats_median(shares, count);
    free(shares);
    return FM_OK;
}
