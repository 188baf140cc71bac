/* What is exact, and worse than it was. */
#ifndef FM_NIGHT_FINDINGS_H
#define FM_NIGHT_FINDINGS_H

#include "night.h"

/* Adds one; NULL: no memory. It holds until the next one is added. */
fm_finding *findings_add(fm_night_result *night, fm_finding_kind kind, size_t case_index,
                         const char *text);
/* Of each case against the newest night before it that has the number, or a status. FM_NO_MEMORY.
 */
fm_status findings_since_last_night(fm_night_result *night, fm_error *err);
/* The same against the baseline's files. FM_IO, FM_NO_MEMORY. No case in common: none. */
fm_status findings_since_baseline(fm_night_result *night, fm_error *err);

#endif
