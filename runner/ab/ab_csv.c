#include <math.h>

#include "ab.h"
#include "base/csv.h"
#include "pairs.h"

static void add_text(fm_text *csv, const char *text)
{
    csv_add(csv, text);
    text_add(csv, ",");
}

static void add_ratio(fm_text *csv, double difference)
{
    csv_add_real(csv, exp(difference));
    text_add(csv, ",");
}

static void add_interval(fm_text *csv, const fm_interval *interval)
{
    add_ratio(csv, interval->median);
    add_ratio(csv, interval->low);
    add_ratio(csv, interval->high);
}

static void add_judged(fm_text *csv, const ab_judged *judged)
{
    const bool is_judged = judged->pairs >= AB_PAIRS_LEAST;
    static const fm_interval none = { NAN, NAN, NAN };
    add_text(csv, is_judged ? ab_verdict_name(judged->verdict) : "");
    text_add(csv, "%zu,", judged->pairs);
    add_interval(csv, is_judged ? &judged->median.interval : &none);
    add_interval(csv, is_judged ? &judged->shift.interval : &none);
    csv_add_real(csv, is_judged ? judged->p : NAN);
    text_add(csv, ",");
    csv_add_real(csv, is_judged ? judged->adjusted : NAN);
    text_add(csv, ",");
    add_ratio(csv, is_judged ? judged->band : NAN);
}

static void add_header(fm_text *csv)
{
    text_add(csv, "schema,case,method,scene,device,device_name,feed,case_id_base,case_id_new,"
                  "verdict,confirmed,outputs,changes,status_base,status_new,pairs_wanted,");
    for (int s = 0; s < AB_STATISTIC_COUNT; s++) {
        const char *name = ab_statistic_names[s];
        text_add(csv, "%s_verdict,%s_pairs,%s_ratio,%s_ratio_low,%s_ratio_high,", name, name, name,
                 name, name);
        text_add(csv, "%s_shift,%s_shift_low,%s_shift_high,%s_p,%s_p_adjusted,%s_band,", name, name,
                 name, name, name, name);
    }
    text_add(csv, "why\n");
}

static void add_row(fm_text *csv, const ab_case *of, const ab_policy *policy)
{
    const fm_case *base = of->planned[AB_BASE];
    const ab_judged *decisive = &of->tested.judged[looks_decisive(&of->tested)];
    const char *const facts[] = { of->name,
                                  base->method,
                                  base->scene,
                                  base->device,
                                  of->device_name,
                                  base->feed,
                                  base->id,
                                  of->planned[AB_NEW]->id,
                                  ab_verdict_name(of->verdict),
                                  of->tested.is_confirmed ? "yes" : "",
                                  ab_outputs_name(of->outputs),
                                  of->changes.length > 0 ? of->changes.bytes : "",
                                  case_status_name(of->status[AB_BASE]),
                                  case_status_name(of->status[AB_NEW]) };
    fm_text why = { 0 };
    text_add(csv, "1,");
    for (size_t i = 0; i < sizeof facts / sizeof facts[0]; i++)
        add_text(csv, facts[i]);
    if (of->verdict == AB_UNCLEAR && decisive->pairs_wanted > 0)
        text_add(csv, "%u", decisive->pairs_wanted);
    text_add(csv, ",");
    for (int s = 0; s < AB_STATISTIC_COUNT; s++)
        add_judged(csv, &of->tested.judged[s]);
    ab_why(&why, of, policy);
    csv_add(csv, why.length > 0 ? why.bytes : "");
    text_add(csv, "\n");
    csv->failed |= why.failed;
    text_free(&why);
}

void ab_add_csv(fm_text *csv, const ab_result *result, const ab_policy *policy)
{
    add_header(csv);
    for (size_t i = 0; i < result->count; i++)
        add_row(csv, &result->cases[i], policy);
}

static void add_pair(fm_text *csv, const ab_result *result, size_t index, uint32_t pair)
{
    const ab_case *of = &result->cases[index];
    add_text(csv, of->name);
    add_text(csv, of->planned[AB_BASE]->id);
    add_text(csv, of->planned[AB_NEW]->id);
    text_add(csv, "%u,%s,%s", pair, pair < result->confirm_first ? "look" : "confirmation",
             ab_side_names[pairs_first_side(result->seed, index, pair)]);
    for (int s = 0; s < AB_STATISTIC_COUNT; s++)
        for (int side = 0; side < AB_SIDE_COUNT; side++) {
            text_add(csv, ",");
            csv_add_real(csv, of->numbers[side][s][pair]);
        }
    text_add(csv, "\n");
}

void ab_add_pairs(fm_text *csv, const ab_result *result)
{
    text_add(csv, "case,case_id_base,case_id_new,pair,part,first,frame_ms_base,frame_ms_new,"
                  "frame_cpu_ms_base,frame_cpu_ms_new\n");
    for (size_t i = 0; i < result->count; i++)
        for (uint32_t pair = 0; pair < result->pair_room; pair++)
            if (!isnan(result->cases[i].numbers[AB_BASE][AB_TIME][pair]) ||
                !isnan(result->cases[i].numbers[AB_NEW][AB_TIME][pair]))
                add_pair(csv, result, i, pair);
}
