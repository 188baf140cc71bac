/* How long cases may take: a guess from the number of fragments, for people who wait and for plans
 * that are parted. */
#ifndef FM_PLAN_COST_H
#define FM_PLAN_COST_H

#include "plan.h"

/* Seconds of all launches of a case on two CPU cores, with its check; 0: it is not launched. */
double plan_case_seconds(const fm_plan *plan, size_t index);
/* Of all cases. */
double plan_seconds(const fm_plan *plan);
/* The same if each is precise enough after the fewest launches (key precision). */
double plan_least_seconds(const fm_plan *plan);

#endif
