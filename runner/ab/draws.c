#include "draws.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"

enum { SETS = 2000, GATES = 500, FOUND = 470, SEED = 1, STEPS = 40 };

/* A million times slower; and how near the answer is to the smallest. */
static const double effect_most = 13.8, effect_precision = 1.05;

static bool is_known(const ab_draws *draws, size_t pair)
{
    for (int s = 0; s < AB_STATISTIC_COUNT; s++)
        if (draws->differences[s] != NULL && isnan(draws->differences[s][pair]))
            return false;
    return true;
}

fm_status draws_open(ab_draws *draws, const double *const differences[AB_STATISTIC_COUNT],
                     size_t count, fm_error *err)
{
    *draws = (ab_draws){ .count = count, .known = calloc(count + 1, sizeof *draws->known) };
    if (draws->known == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu pairs", count);
    for (int s = 0; s < AB_STATISTIC_COUNT; s++)
        draws->differences[s] = differences[s];
    for (size_t i = 0; i < count; i++)
        if (is_known(draws, i))
            draws->known[draws->known_count++] = i;
    return FM_OK;
}

void draws_close(ab_draws *draws)
{
    free(draws->known);
    *draws = (ab_draws){ 0 };
}

/* drawn: [AB_STATISTIC_COUNT * pairs] */
static void draw(double *drawn, const ab_draws *draws, const ab_gates_desc *desc, uint32_t pairs,
                 uint64_t *state)
{
    for (uint32_t i = 0; i < pairs; i++) {
        const size_t pair = draws->known[random_below(state, (uint32_t)draws->known_count)];
        const double sign = random_below(state, 2) == 0 ? 1.0 : -1.0;
        for (uint32_t s = 0; s < AB_STATISTIC_COUNT; s++)
            if (draws->differences[s] != NULL)
                drawn[s * pairs + i] = sign * draws->differences[s][pair] + desc->shift[s];
    }
}

static fm_status judge(ab_tested *tested, const ab_policy *policy, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t look = 0; look < policy->look_count && status == FM_OK; look++)
        status = looks_judge(tested, 1, policy, look, err);
    return status == FM_OK ? looks_confirm(tested, 1, policy, err) : status;
}

fm_status draws_gates(uint32_t verdicts[AB_VERDICT_COUNT], const ab_draws *draws,
                      const ab_gates_desc *desc, const ab_policy *policy, uint64_t *state,
                      fm_error *err)
{
    const uint32_t pairs = ab_policy_pairs(policy);
    double *drawn = calloc((size_t)pairs * AB_STATISTIC_COUNT, sizeof *drawn);
    fm_status status =
        drawn != NULL ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for %u pairs", pairs);
    memset(verdicts, 0, AB_VERDICT_COUNT * sizeof *verdicts);
    for (uint32_t i = 0; i < desc->gates && status == FM_OK; i++) {
        ab_tested tested = { .is_decided = false };
        draw(drawn, draws, desc, pairs, state);
        for (uint32_t s = 0; s < AB_STATISTIC_COUNT; s++) {
            tested.differences[s] = draws->differences[s] != NULL ? drawn + s * pairs : NULL;
            tested.least[s] = desc->least[s];
        }
        status = judge(&tested, policy, err);
        verdicts[tested.verdict]++;
    }
    free(drawn);
    return status;
}

/* The estimates of one set of pairs. */
static fm_status draw_estimates(double estimates[2], const ab_draws *draws, ab_statistic statistic,
                                double *drawn, uint32_t pairs, uint64_t *state, fm_error *err)
{
    static const ab_gates_desc equal = { .gates = 0 };
    fm_shift shift;
    draw(drawn, draws, &equal, pairs, state);
    double *values = drawn + (size_t)statistic * pairs;
    const fm_status status = walsh_shift(&shift, values, pairs, 0.95, err);
    estimates[0] = shift.interval.median;
    estimates[1] = stats_median(values, pairs);
    return status;
}

fm_status draws_error(double *error, const ab_draws *draws, ab_statistic statistic, uint32_t pairs,
                      fm_error *err)
{
    double squares[2] = { 0.0, 0.0 };
    uint64_t state = SEED;
    double *drawn = calloc((size_t)pairs * AB_STATISTIC_COUNT, sizeof *drawn);
    fm_status status =
        drawn != NULL ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for %u pairs", pairs);
    for (int i = 0; i < SETS && status == FM_OK; i++) {
        double estimates[2];
        status = draw_estimates(estimates, draws, statistic, drawn, pairs, &state, err);
        squares[0] += estimates[0] * estimates[0];
        squares[1] += estimates[1] * estimates[1];
    }
    free(drawn);
    *error = sqrt(fmax(squares[0], squares[1]) / SETS);
    return status;
}

/* Whether gates find an effect often enough. */
static fm_status is_found(bool *found, double effect, const ab_draws *draws, ab_statistic statistic,
                          double least, const ab_policy *policy, fm_error *err)
{
    ab_gates_desc desc = { .gates = GATES };
    uint32_t verdicts[AB_VERDICT_COUNT];
    uint64_t state = SEED;
    desc.shift[statistic] = effect;
    for (int s = 0; s < AB_STATISTIC_COUNT; s++) /* the other one is not slower anyhow */
        desc.least[s] = least;
    const fm_status status = draws_gates(verdicts, draws, &desc, policy, &state, err);
    *found = verdicts[AB_WORSE] >= FOUND;
    return status;
}

fm_status draws_detectable(double *effect, const ab_draws *draws, ab_statistic statistic,
                           double least, const ab_policy *policy, fm_error *err)
{
    double low = fmax(log1p(policy->band), least), high = low;
    bool found = false;
    fm_status status = is_found(&found, low, draws, statistic, least, policy, err);
    while (status == FM_OK && !found && high < effect_most) {
        low = high;
        high *= 2.0;
        status = is_found(&found, high, draws, statistic, least, policy, err);
    }
    for (int i = 0; i < STEPS && status == FM_OK && high > effect_precision * low; i++) {
        const double middle = sqrt(low * high);
        status = is_found(&found, middle, draws, statistic, least, policy, err);
        *(found ? &high : &low) = middle;
    }
    *effect = high;
    return status;
}
