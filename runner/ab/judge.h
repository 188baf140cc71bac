/* One statistic of one case: is NEW slower than BASE, by how much, and does that count?
 *
 * The room ab compares two builds of a method by pairs of launches that run one after the other
 * (ab.h). judge.h and looks.h decide, on arrays of numbers alone; noise.h says what this machine
 * can see; outputs.h compares what needs no statistics; sides.h joins the cases of both builds;
 * pairs.h measures; ab.h does all of it, and writes it down. */
#ifndef FM_AB_JUDGE_H
#define FM_AB_JUDGE_H

#include <stdbool.h>
#include <stdint.h>

#include "decide/median.h"
#include "decide/walsh.h"

/* What is compared of each pair of launches. */
typedef enum ab_statistic {
    AB_TIME, /* median of frame_ms of a launch */
    AB_CPU,  /* least frame_cpu_ms of a launch: other programs only add to it, by what they do to
                caches and shared cores; of software devices alone, since it is their work */
    AB_STATISTIC_COUNT
} ab_statistic;
extern const char *const ab_statistic_names[AB_STATISTIC_COUNT]; /* "time", "cpu" */

/* In rising order of merit. */
typedef enum ab_verdict {
    AB_WORSE,
    AB_UNMEASURED, /* one side, or both, has no launch that went well: see the message */
    AB_UNCLEAR,    /* more pairs might tell */
    AB_SAME,       /* the whole interval lies inside the band: proved */
    AB_BETTER,
    AB_VERDICT_COUNT
} ab_verdict;
const char *ab_verdict_name(ab_verdict verdict); /* "worse" */

/* A change of fewer standard errors of a first look does not count. */
#define AB_ERRORS_THAT_COUNT 3.0

enum { AB_LOOKS = 8, AB_PAIRS_LEAST = 6 /* fewer have no interval of 95 % */ };

/* What is planned before anything is measured. */
typedef struct ab_policy {
    uint32_t looks[AB_LOOKS]; /* pairs of a case at each look, rising from AB_PAIRS_LEAST on */
    size_t look_count;
    double levels[AB_LOOKS]; /* of each look; by ab_policy_make */
    double level;            /* of all looks together: false verdicts among those that say
                                worse or better, over all cases of the command */
    double confirm_level;    /* of the confirmation, one-sided */
    double band;             /* the least share of a time that counts */
    bool stops_at_outputs;   /* a case with worse outputs is not timed any further */
    bool only_looks;         /* nothing is confirmed: both sides are the same build */
} ab_policy;

/* Looks at 20 and 40 pairs, level 5 %, band 2 %, and levels of the looks; with `looks` (ends with
 * 0) instead of those. FM_INVALID: looks that do not rise from AB_PAIRS_LEAST on, too many, or more
 * pairs than can be judged. */
fm_status ab_policy_make(ab_policy *policy, const uint32_t *looks, fm_error *err);
/* Pairs that a case can have: those of the last look, and as many as the first look has to confirm
 * what is worse. Pairs of the confirmation are numbered behind all looks'. */
uint32_t ab_policy_pairs(const ab_policy *policy);
uint32_t ab_policy_confirm_first(const ab_policy *policy);

/* What one statistic of one case says at a look. Of logarithms of ratios NEW / BASE. */
typedef struct ab_judged {
    size_t pairs;
    fm_median median; /* with its bootstrap interval */
    fm_shift shift;   /* Hodges and Lehmann's, whose interval decides */
    double p, p_greater;
    double adjusted;       /* p among all tests of the command (Benjamini and Hochberg) */
    double band;           /* what counts */
    ab_verdict verdict;    /* of this statistic alone; AB_UNMEASURED: no pairs */
    uint32_t pairs_wanted; /* unclear: so many might decide; 0: not even DECIDE_VALUES */
} ab_judged;

/* Everything but `adjusted` and `verdict`, which hang on the other cases.
 * differences  [count]; NAN: the pair has none, and is left out
 * coverage     of both intervals
 * least        logarithm of the smallest effect that counts on this machine, as calibrated
 * (noise.h): three standard errors of policy->looks[0] pairs, of the median or of Hodges and
 *              Lehmann's estimate, whichever is larger; 0: not known, and taken from the
 * differences themselves The band is the larger of policy->band and that. FM_INVALID: an infinite
 * difference; FM_NO_MEMORY. */
fm_status judge_pairs(ab_judged *judged, const double *differences, size_t count,
                      const ab_policy *policy, double coverage, double least, fm_error *err);

/* AB_SAME, AB_WORSE, AB_BETTER or AB_UNCLEAR, by the interval, the band and `adjusted` at that
 * look. What is worse or better is certain, and the estimate itself is at least policy->band. Sets
 * pairs_wanted. */
void judge_verdict(ab_judged *judged, const ab_policy *policy, size_t look);

#endif
