/* Did a case become slower in the last nights? The alarm of one night.
 *
 * The room reports/history keeps what runs of many nights measured, in one SQLite file
 * (database.h, runs.h, record.h), finds cases again (series.h), and decides when a series says
 * that something became slower (this header). Nothing here draws or writes a page. */
#ifndef FM_HISTORY_ALARM_H
#define FM_HISTORY_ALARM_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

/* One night of a series, the oldest first. */
typedef struct fm_night {
    double ratio;   /* of a case to its reference in the same run, above 0; NAN: not measured */
    size_t machine; /* any number: nights of one machine have the same */
} fm_night;

typedef struct fm_alarm_desc {
    double level;  /* chance of an alarm in ALARM_MONTH nights without a step; 0: 0.05 */
    size_t series; /* so many series are judged each night, and share the level; 0: 1 */
    double least;  /* no alarm below this factor; 0: 1.02 */
    double drift;  /* what a drift may add to the recent nights, as a factor; 0: 1.005 */
} fm_alarm_desc;

enum {
    ALARM_MONTH = 30,  /* nights that share the level */
    ALARM_BEFORE = 30, /* so many nights before the recent ones are looked at, at most */
    ALARM_RECENT = 3,  /* recent nights, at least: one odd night is no step */
    ALARM_RECENT_MOST = 10,
};

typedef enum fm_alarm_verdict {
    FM_ALARM_NONE,      /* no step is seen */
    FM_ALARM_STEP,      /* the recent nights are slower */
    FM_ALARM_EARLY,     /* too few nights of this machine so far: no step could be seen */
    FM_ALARM_UNMEASURED /* the last night has no ratio */
} fm_alarm_verdict;

const char *alarm_verdict_name(fm_alarm_verdict verdict); /* "step" */

typedef struct fm_alarm {
    fm_alarm_verdict verdict;
    double factor;         /* recent nights over those before: Hodges and Lehmann's; NAN: EARLY */
    double p;              /* of the exact rank-sum test, beyond a drift; NAN: EARLY */
    double level;          /* that p must not exceed: this night's share, of this series */
    size_t recent, before; /* how many nights were compared; EARLY: recent is 0, and before how many
                              there are */
    size_t needed;         /* EARLY: nights of this machine, with this one, from which on a step can
                              be seen; else 0 */
} fm_alarm;

/* Judges the last night by the nights of its machine alone: those of others are left out, be they
 * noisier or faster, and so are nights that were not measured. The last `recent` nights are held
 * against up to ALARM_BEFORE nights before them with the exact rank-sum test (decide/rank_sum.h),
 * one-sided, at level / ALARM_MONTH / series: are they above those by more than `drift`? `recent`
 * is the smallest number for which that test can reach the level, and 3 at least: 3 for one series
 * after 14 other nights, 5 for a hundred after 21. So the level holds whatever the distribution of
 * the noise, if nights are independent and alike but for a drift of up to `drift` in half a window.
 *
 * A step of 6 % is found in its first three nights in nine of ten months if a night's ratio has a
 * standard error of 1.6 % or less (tests/reports/alarm_test.c, which tells how many launches that
 * took on one busy machine).
 *
 * The alarm is for whoever watches: once it is raised, have it confirmed by fresh launches.
 *
 * FM_INVALID: no night, a ratio that is infinite or not above 0, a level not between 0 and 1, or a
 * factor below 1; FM_NO_MEMORY. */
fm_status alarm_judge(fm_alarm *alarm, const fm_night *nights, size_t count,
                      const fm_alarm_desc *desc, fm_error *err);

#endif
