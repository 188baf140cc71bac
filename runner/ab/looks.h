/* All cases of a command at a look that was planned: which of them are decided, which go on, and
 * which of those that are worse are so again on launches of their own. */
#ifndef FM_AB_LOOKS_H
#define FM_AB_LOOKS_H

#include "judge.h"

/* The statistics of one case. Zero it, then set what stands above the line. */
typedef struct ab_tested {
    const double *differences[AB_STATISTIC_COUNT]; /* [ab_policy_pairs]; NAN: no such pair (yet);
                                                      NULL: the statistic is not used */
    double least[AB_STATISTIC_COUNT]; /* that counts, as calibrated: judge.h; 0: not known */
    bool is_out;                      /* it is not timed (any more); its tests stand as they are */
    /* ---- by looks_judge and looks_confirm */
    ab_judged judged[AB_STATISTIC_COUNT];    /* at the last look that it was open at */
    ab_judged confirmed[AB_STATISTIC_COUNT]; /* of the confirmation; pairs 0: there was none */
    bool is_decided;
    ab_verdict verdict;    /* AB_WORSE is a suspicion until it is confirmed */
    bool is_confirmed;     /* worse, twice */
    bool is_not_confirmed; /* it was suspected, and then not seen again: unclear */
    uint32_t looks_seen;
} ab_tested;

/* The statistic that can prove that a case is the same: processor time where it is used, which
 * hardly feels other programs. */
ab_statistic looks_decisive(const ab_tested *tested);

/* Judges all open cases after policy->looks[look] pairs. Tests of cases that were decided earlier
 * stay among those that p is adjusted for, and keep the adjusted p of their own look. A case is
 * worse, or better, if one of its statistics is (worse wins), the same if the decisive one is, else
 * unclear; at the last look all are decided. FM_NO_MEMORY; FM_INVALID as judge_pairs. */
fm_status looks_judge(ab_tested *cases, size_t count, const ab_policy *policy, size_t look,
                      fm_error *err);
/* Whether it is to have the pairs of a confirmation: worse, not yet confirmed, not is_out. */
bool looks_suspects(const ab_tested *tested);
/* Judges what all suspects' pairs of the confirmation say of the statistics that were worse: worse
 * again, if p of being slower, adjusted among the suspects, is at most policy->confirm_level.
 * Others are unclear. Whether it counts was judged before. */
fm_status looks_confirm(ab_tested *cases, size_t count, const ab_policy *policy, fm_error *err);

#endif
