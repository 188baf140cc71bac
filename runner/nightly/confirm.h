/* The stage in which what was found slower is measured again, against a base, by `fragmark gate`.
 */
#ifndef FM_NIGHTLY_CONFIRM_H
#define FM_NIGHTLY_CONFIRM_H

#include "tonight.h"

/* Whether something was found that can be confirmed: night.json has findings on time, the policy
 * has a base, and no gate was asked yet. */
bool confirm_is_wanted(const fm_tonight *tonight);
/* Has a gate hold these cases against the base in what is left of the budget. night.stage is JUDGES
 * after it, and night.gate what came of it. FM_IO: somebody stopped the gate, or the state cannot
 * be written, or no process started: the same command continues. FM_INVALID: plugins cannot be
 * found; FM_NO_MEMORY. */
fm_status stage_confirm(fm_tonight *tonight, fm_error *err);
/* Why findings on time are not confirmed, for readers: of those that a gate has no answer on, where
 * one was asked. */
const char *confirm_reason(const fm_tonight *tonight);

#endif
