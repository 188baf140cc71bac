/* Numbers of one case that columns are made of. */
#include "base/stats.h"
#include "decide/precision.h"
#include "summary_internal.h"

static bool is_used(const row_state *row, const fm_kept_sample *sample)
{
    const uint32_t frames = row->results->plan->frames;
    return sample->frame >= frames ||
           !row->is_off_clock[(size_t)sample->launch * frames + sample->frame];
}

size_t summary_gather(const row_state *row, fm_metric metric, uint32_t launch)
{
    size_t count = 0;
    for (size_t i = 0; i < row->result->sample_count; i++) {
        const fm_kept_sample *sample = &row->result->samples[i];
        if (sample->metric != metric || (launch != UINT32_MAX && sample->launch != launch) ||
            !is_used(row, sample))
            continue;
        row->values[count] = sample->value;
        row->groups[count++] = sample->launch;
    }
    return count;
}

double summary_median(const row_state *row, fm_metric metric, uint32_t launch)
{
    return stats_median(row->values, summary_gather(row, metric, launch));
}

double summary_coverage(const row_state *row)
{
    const fm_plan *plan = row->results->plan;
    if (row->measured->settings.precision_percent <= 0.0)
        return 0.0;
    const uint32_t last = plan_case_launches(plan, (size_t)(row->measured - plan->cases));
    return precision_coverage(last, row->result->done);
}

fm_interval summary_frames(const row_state *row, fm_metric metric)
{
    const size_t count = summary_gather(row, metric, UINT32_MAX);
    return stats_by_launch(&(fm_samples){ .values = row->values,
                                          .group_of = row->groups,
                                          .count = count,
                                          .group_count = row->results->plan->launches,
                                          .coverage = summary_coverage(row) });
}

const json_t *summary_metric(const row_state *row, fm_metric metric)
{
    return json_object_get(row->result->metrics, fm_metrics[metric].name);
}
