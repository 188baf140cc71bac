#include "pairs.h"

#include <math.h>
#include <stdlib.h>

#include "base/clock.h"
#include "base/random.h"
#include "numbers.h"

ab_side_name pairs_first_side(uint64_t seed, size_t case_index, uint32_t pair)
{
    uint64_t state = seed ^ (case_index * 0x9E3779B97F4A7C15u);
    const bool begins_with_new = (random_next(&state) & 1u) != 0;
    return (pair % 2 == 1) != begins_with_new ? AB_NEW : AB_BASE;
}

/* The cases of a round in an order of its own: it depends on the seed alone. */
static void shuffle(size_t *order, size_t count, uint64_t seed, uint32_t round)
{
    uint64_t state = seed + round;
    state = random_next(&state);
    for (size_t i = 0; i < count; i++)
        order[i] = i;
    for (size_t i = count; i > 1; i--) {
        const size_t j = random_below(&state, (uint32_t)i), kept = order[i - 1];
        order[i - 1] = order[j];
        order[j] = kept;
    }
}

static bool should_stop(ab_session *session)
{
    for (int side = 0; side < AB_SIDE_COUNT && session->result->stop_signal == 0; side++)
        session->result->stop_signal = run_stop_signal(session->runs[side]);
    return session->result->stop_signal != 0;
}

static void take_numbers(ab_session *session, size_t index, uint32_t pair)
{
    ab_case *of = &session->result->cases[index];
    for (int s = 0; s < AB_STATISTIC_COUNT; s++) {
        for (int side = 0; side < AB_SIDE_COUNT; side++) {
            const size_t at = session->result->pairs.items[index].at[side];
            of->numbers[side][s][pair] = numbers_of_launch(
                &run_results(session->runs[side])->cases[at], pair, (ab_statistic)s);
        }
        const double base = of->numbers[AB_BASE][s][pair], now = of->numbers[AB_NEW][s][pair];
        of->differences[s][pair] = base > 0.0 && now > 0.0 ? log(now / base) : NAN;
    }
    session->result->measured_pairs += isnan(of->differences[AB_TIME][pair]) ? 0 : 1;
}

/* A case that went wrong on one side is not launched on the other any more. */
static bool has_failed(const ab_session *session, size_t index)
{
    for (int side = 0; side < AB_SIDE_COUNT; side++) {
        const size_t at = session->result->pairs.items[index].at[side];
        const fm_case_status status = run_results(session->runs[side])->cases[at].status;
        if (session->result->cases[index].planned[side]->skip != NULL ||
            !case_status_continues(status))
            return true;
    }
    return false;
}

static fm_status measure_pair(ab_session *session, size_t index, uint32_t pair, fm_error *err)
{
    const ab_side_name first = pairs_first_side(session->result->seed, index, pair);
    const double began_s = clock_s();
    char current[320];
    fm_status status = FM_OK;
    snprintf(current, sizeof current, "%.140s, pair %u", session->result->cases[index].name, pair);
    progress_begin(&session->progress, current);
    /* Both sides, also where the first fails: only so is known whether the other does, too. */
    const int sides = has_failed(session, index) ? 0 : AB_SIDE_COUNT;
    for (int i = 0; i < sides && status == FM_OK && !should_stop(session); i++) {
        const int side = i == 0 ? (int)first : 1 - (int)first;
        const size_t at = session->result->pairs.items[index].at[side];
        status = run_launch(session->runs[side], at, pair, err);
        if (status != FM_OK)
            fm_error_prefix(err, "%s", ab_side_names[side]);
    }
    take_numbers(session, index, pair);
    progress_end(&session->progress, clock_s() - began_s);
    return status;
}

static uint32_t count_wanted(const ab_session *session, bool (*wants)(const ab_case *of))
{
    uint32_t wanted = 0;
    for (size_t i = 0; i < session->result->count; i++)
        wanted += wants(&session->result->cases[i]) && !has_failed(session, i);
    return wanted;
}

fm_status pairs_measure(ab_session *session, uint32_t first, uint32_t count,
                        bool (*wants)(const ab_case *of), fm_error *err)
{
    const size_t case_count = session->result->count;
    size_t *order = calloc(case_count + 1, sizeof *order);
    fm_status status = FM_OK;
    if (order == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", case_count);
    session->progress.total += count * count_wanted(session, wants);
    for (uint32_t pair = first; pair < first + count && status == FM_OK; pair++) {
        shuffle(order, case_count, session->result->seed, pair);
        for (size_t i = 0; i < case_count && status == FM_OK && !should_stop(session); i++)
            if (wants(&session->result->cases[order[i]]) && !has_failed(session, order[i]))
                status = measure_pair(session, order[i], pair, err);
    }
    free(order);
    return status;
}
