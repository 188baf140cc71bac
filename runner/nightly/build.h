/* The stage in which what is measured is built: the policy's `build`, without a shell. */
#ifndef FM_NIGHTLY_BUILD_H
#define FM_NIGHTLY_BUILD_H

#include "tonight.h"

/* The command of `build`: a path seen from the policy's folder, or what PATH has. FM_INVALID: there
 * is no such program. */
fm_status build_find_command(char path[FM_PATH_MAX_BYTES], const fm_policy *policy, fm_error *err);
/* Builds, for half of the budget at most. night.stage is PLANS after it, or GIVEN_UP: it failed,
 * which is told, and written as summary.md. FM_IO, FM_NO_MEMORY: the state cannot be written, no
 * process started. */
fm_status stage_build(fm_tonight *tonight, fm_error *err);
/* "Built in 3 s by `cmake --build build`." */
void build_add_note(fm_text *note, const fm_tonight *tonight);

#endif
