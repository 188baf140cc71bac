#include "alarm.h"

#include <math.h>

#include "decide/rank_sum.h"

static const double usual_level = 0.05, usual_least = 1.02, usual_drift = 1.005;

static const char *const verdict_names[] = {
    [FM_ALARM_NONE] = "none",
    [FM_ALARM_STEP] = "step",
    [FM_ALARM_EARLY] = "early",
    [FM_ALARM_UNMEASURED] = "unmeasured",
};

const char *alarm_verdict_name(fm_alarm_verdict verdict)
{
    return verdict_names[verdict];
}

/* How rare the last `recent` of `count` values are all the greatest, by chance. */
static double smallest_p(size_t count, size_t recent)
{
    double p = 1.0;
    for (size_t i = 0; i < recent; i++)
        p *= (double)(i + 1) / (double)(count - i);
    return p;
}

static size_t at_most(size_t count, size_t most)
{
    return count < most ? count : most;
}

/* 0: no number of recent nights is enough. There are as many before as recent, at least: a series
 * whose greater part is recent has no past to speak of. */
static size_t choose_recent(size_t count, double level)
{
    for (size_t recent = ALARM_RECENT; recent <= ALARM_RECENT_MOST && 2 * recent <= count; recent++)
        if (smallest_p(at_most(count, ALARM_BEFORE + recent), recent) <= level)
            return recent;
    return 0;
}

static size_t count_needed(double level)
{
    size_t count = 2 * (size_t)ALARM_RECENT;
    while (choose_recent(count, level) == 0 && count < 2 * (size_t)RANK_SUM_VALUES)
        count++;
    return count;
}

/* The logarithms of the last night's machine, at most `most`, the oldest first. */
static size_t take_nights(double *values, size_t most, const fm_night *nights, size_t count)
{
    size_t taken = 0, first = count;
    const size_t machine = nights[count - 1].machine;
    while (first > 0 && taken < most) {
        first--;
        taken += nights[first].machine == machine && !isnan(nights[first].ratio);
    }
    taken = 0;
    for (size_t i = first; i < count; i++)
        if (nights[i].machine == machine && !isnan(nights[i].ratio))
            values[taken++] = log(nights[i].ratio);
    return taken;
}

static fm_status check(const fm_night *nights, size_t count, const fm_alarm_desc *desc,
                       fm_error *err)
{
    if (count == 0)
        return fm_fail(err, FM_INVALID, "no night to judge");
    for (size_t i = 0; i < count; i++)
        if (!isnan(nights[i].ratio) && !(nights[i].ratio > 0 && isfinite(nights[i].ratio)))
            return fm_fail(err, FM_INVALID, "night %zu: a ratio of %g", i, nights[i].ratio);
    if (!(desc->level > 0 && desc->level < 1))
        return fm_fail(err, FM_INVALID, "a level of %g: not between 0 and 1", desc->level);
    if (!(desc->least >= 1 && isfinite(desc->least)))
        return fm_fail(err, FM_INVALID, "a least factor of %g: below 1", desc->least);
    if (!(desc->drift >= 1 && isfinite(desc->drift)))
        return fm_fail(err, FM_INVALID, "a drift of %g: below 1", desc->drift);
    return FM_OK;
}

static fm_alarm_desc with_defaults(const fm_alarm_desc *desc)
{
    return (fm_alarm_desc){
        .level = desc->level == 0 ? usual_level : desc->level,
        .series = desc->series == 0 ? 1 : desc->series,
        .least = desc->least == 0 ? usual_least : desc->least,
        .drift = desc->drift == 0 ? usual_drift : desc->drift,
    };
}

/* values[before + recent], the recent ones last; they are shifted. */
static fm_status test_step(fm_alarm *alarm, double *values, const fm_alarm_desc *desc,
                           fm_error *err)
{
    fm_rank_sum test;
    const double drift = log(desc->drift);
    const size_t count = alarm->before + alarm->recent;
    for (size_t i = alarm->before; i < count; i++)
        values[i] -= drift;
    const fm_status status = rank_sum_test(&test, values, alarm->before, count, err);
    if (status != FM_OK)
        return status;
    alarm->factor = exp(test.shift + drift);
    alarm->p = test.p_greater;
    if (alarm->p <= alarm->level && alarm->factor >= desc->least)
        alarm->verdict = FM_ALARM_STEP;
    return FM_OK;
}

fm_status alarm_judge(fm_alarm *alarm, const fm_night *nights, size_t count,
                      const fm_alarm_desc *desc, fm_error *err)
{
    double values[ALARM_BEFORE + ALARM_RECENT_MOST];
    const fm_alarm_desc full = with_defaults(desc);
    const fm_status status = check(nights, count, &full, err);
    if (status != FM_OK)
        return status;
    *alarm = (fm_alarm){ .verdict = FM_ALARM_NONE,
                         .factor = NAN,
                         .p = NAN,
                         .level = full.level / ALARM_MONTH / (double)full.series };
    if (isnan(nights[count - 1].ratio)) {
        alarm->verdict = FM_ALARM_UNMEASURED;
        return FM_OK;
    }
    const size_t taken = take_nights(values, ALARM_BEFORE + ALARM_RECENT_MOST, nights, count);
    alarm->recent = choose_recent(taken, alarm->level);
    alarm->before = at_most(taken - alarm->recent, ALARM_BEFORE);
    if (alarm->recent > 0)
        return test_step(alarm, values + (taken - alarm->recent - alarm->before), &full, err);
    alarm->verdict = FM_ALARM_EARLY;
    alarm->before = taken - 1;
    alarm->needed = count_needed(alarm->level);
    return FM_OK;
}
