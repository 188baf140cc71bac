#include "standing.h"

#include <math.h>
#include <stdlib.h>

const char *standing_name(fm_standing standing)
{
    static const char *const names[] = { "", "dominated", "tied", "frontier" };
    return names[standing];
}

bool standing_has_point(const fm_case_row *result, const fm_error_kind *kind)
{
    return result->is_measured && !result->is_simulated && isfinite(error_kind_of(kind, result)) &&
           result->metric[FM_METRIC_FRAME_MS] > 0;
}

static bool competes(const fm_case_row *result, const fm_error_kind *kind)
{
    return result->is_ok && !result->look.is_control && standing_has_point(result, kind);
}

fm_span standing_time(const fm_case_row *result)
{
    const double low = result->low[FM_METRIC_FRAME_MS], high = result->high[FM_METRIC_FRAME_MS];
    const bool has_interval = isfinite(low) && isfinite(high);
    return (fm_span){ .value = result->metric[FM_METRIC_FRAME_MS],
                      .low = has_interval ? low : 0,
                      .high = has_interval ? high : INFINITY };
}

fm_span span_ratio(const fm_span *a, const fm_span *b)
{
    return (fm_span){ .value = a->value / b->value,
                      .low = isinf(b->high) ? 0 : a->low / b->high,
                      .high = b->low > 0 ? a->high / b->low : INFINITY };
}

static int compare_contenders(const void *a, const void *b)
{
    const fm_contender *x = a, *y = b;
    const int order = (x->work > y->work) - (x->work < y->work);
    return order != 0 ? order : (x->error > y->error) - (x->error < y->error);
}

/* How much a case has to do: n, where it is known. */
static double work_of(const fm_case_row *result)
{
    const double n = result->metric[FM_METRIC_N];
    return isnan(n) ? 0 : n;
}

static size_t collect(fm_contender *contenders, const fm_group *group, const fm_error_kind *kind)
{
    size_t count = 0;
    for (size_t i = 0; i < group->count; i++)
        if (competes(group->cases[i], kind))
            contenders[count++] =
                (fm_contender){ work_of(group->cases[i]), error_kind_of(kind, group->cases[i]),
                                standing_time(group->cases[i]), i };
    return count;
}

/* Of all with no more error: which ends first, and the two lows that come first. */
typedef struct rivals {
    double first_high, first_low, second_low;
    size_t ends_first, begins_first;
} rivals;

static void add_rival(rivals *r, const fm_contender *one)
{
    if (one->time.high < r->first_high) {
        r->first_high = one->time.high;
        r->ends_first = one->index;
    }
    if (one->time.low < r->first_low) {
        r->second_low = r->first_low;
        r->first_low = one->time.low;
        r->begins_first = one->index;
    } else if (one->time.low < r->second_low) {
        r->second_low = one->time.low;
    }
}

static fm_place place_of(const fm_contender *one, const rivals *r)
{
    const double other_low = r->begins_first == one->index ? r->second_low : r->first_low;
    if (r->first_high < one->time.low)
        return (fm_place){ FM_STANDING_DOMINATED, r->ends_first };
    return (fm_place){ one->time.high < other_low || isinf(other_low) ? FM_STANDING_FRONTIER
                                                                      : FM_STANDING_TIED,
                       0 };
}

void contenders_place(fm_place *places, fm_contender *contenders, size_t count)
{
    const rivals none = { INFINITY, INFINITY, INFINITY, SIZE_MAX, SIZE_MAX };
    rivals r = none;
    qsort(contenders, count, sizeof *contenders, compare_contenders);
    for (size_t first = 0, next; first < count; first = next) {
        if (first == 0 || contenders[first].work != contenders[first - 1].work)
            r = none;
        for (next = first;
             next < count && compare_contenders(&contenders[next], &contenders[first]) == 0; next++)
            add_rival(&r, &contenders[next]);
        for (size_t i = first; i < next; i++)
            places[contenders[i].index] = place_of(&contenders[i], &r);
    }
}

bool standings_make(fm_place *places, const fm_group *group, const fm_error_kind *kind)
{
    fm_contender *contenders = calloc(group->count + 1, sizeof *contenders);
    if (contenders == NULL)
        return false;
    for (size_t i = 0; i < group->count; i++)
        places[i] = (fm_place){ FM_STANDING_NONE, 0 };
    contenders_place(places, contenders, collect(contenders, group, kind));
    free(contenders);
    return true;
}
