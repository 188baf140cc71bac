/* What fits tonight's time: launches of each case, or a part of the methods. */
#ifndef FM_NIGHTLY_CHOOSE_H
#define FM_NIGHTLY_CHOOSE_H

#include "plan/plan.h"
#include "policy.h"
#include "state.h"

/* Sets launches, cases, part, parts and methods of a new night. A round is one launch of each case:
 * it takes what it took in the night before, or what a plan says. So many rounds as fit into the
 * launches' share of the budget are measured, at most launches_most, and no more than the night
 * before found to be needed. If not even launches_least fit, methods take turns: a part of them
 * each night, with the reference in all. FM_NO_MEMORY. */
fm_status choose_tonight(fm_night_state *night, const fm_policy *policy, const fm_night_past *past,
                         const fm_plan *plan, double round_s, fm_error *err);

#endif
