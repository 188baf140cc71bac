/* Pairs of launches: which is next, and what they say. */
#ifndef FM_AB_PAIRS_H
#define FM_AB_PAIRS_H

#include "ab.h"
#include "parent/progress.h"
#include "parent/run_open.h"

/* Two open runs and the cases that both have. */
typedef struct ab_session {
    const ab_desc *desc;
    ab_result *result;
    fm_open_run *runs[AB_SIDE_COUNT];
    fm_progress progress;
} ab_session;

/* Which side of a pair is launched first: by turns, beginning by the seed. */
ab_side_name pairs_first_side(uint64_t seed, size_t case_index, uint32_t pair);

/* Launches pairs [first, first + count) of the cases that `wants` says, round by round, and takes
 * down their numbers. FM_OK also where a signal stops it: result->stop_signal. Else as run_launch,
 * with the side before the message. */
fm_status pairs_measure(ab_session *session, uint32_t first, uint32_t count,
                        bool (*wants)(const ab_case *of), fm_error *err);

#endif
