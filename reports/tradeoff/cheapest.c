#include "cheapest.h"

#include <math.h>
#include <stdlib.h>

const double cheapest_bounds[CHEAPEST_BOUNDS] = { 0, 1e-4, 1e-3, 1e-2, 1e-1 };

static bool is_within(const fm_place *places, const fm_group *group, size_t i,
                      const fm_error_kind *kind, double bound)
{
    return places[i].standing != FM_STANDING_NONE && error_kind_of(kind, group->cases[i]) <= bound;
}

static fm_cheapest find(const fm_place *places, const fm_group *group, const fm_error_kind *kind,
                        double bound)
{
    fm_cheapest best = { .ratio = { NAN, NAN, NAN } };
    for (size_t i = 0; i < group->count; i++) {
        const fm_case_row *one = group->cases[i];
        if (is_within(places, group, i, kind, bound) &&
            (best.row == NULL ||
             one->metric[FM_METRIC_FRAME_MS] < best.row->metric[FM_METRIC_FRAME_MS]))
            best.row = one;
    }
    if (best.row == NULL)
        return best;
    const fm_span own = standing_time(best.row);
    for (size_t i = 0; i < group->count; i++)
        best.tied_count += group->cases[i] != best.row &&
                           is_within(places, group, i, kind, bound) &&
                           standing_time(group->cases[i]).low <= own.high;
    return best;
}

static bool has_one_n(const fm_place *places, const fm_group *group)
{
    double n = NAN;
    for (size_t i = 0; i < group->count; i++) {
        const double own = group->cases[i]->metric[FM_METRIC_N];
        if (places[i].standing == FM_STANDING_NONE || isnan(own))
            continue;
        if (!isnan(n) && own != n)
            return false;
        n = own;
    }
    return true;
}

bool cheapest_make(fm_cheapest *cheapest, const fm_group *group, const fm_error_kind *kind)
{
    fm_place *places = calloc(group->count + 1, sizeof *places);
    if (places == NULL || !standings_make(places, group, kind)) {
        free(places);
        return false;
    }
    const bool is_fair = has_one_n(places, group);
    for (int i = 0; i < CHEAPEST_BOUNDS; i++)
        cheapest[i] = is_fair ? find(places, group, kind, cheapest_bounds[i])
                              : (fm_cheapest){ .ratio = { NAN, NAN, NAN } };
    for (int i = 0; i < CHEAPEST_BOUNDS && cheapest[0].row != NULL; i++) {
        const fm_span own = standing_time(cheapest[i].row);
        const fm_span exact = standing_time(cheapest[0].row);
        cheapest[i].ratio =
            cheapest[i].row == cheapest[0].row ? (fm_span){ 1, 1, 1 } : span_ratio(&own, &exact);
    }
    free(places);
    return true;
}
