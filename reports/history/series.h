/* One case through all nights on one machine: its ratio to a reference of the same run. */
#ifndef FM_HISTORY_SERIES_H
#define FM_HISTORY_SERIES_H

#include "alarm.h"
#include "base/stats.h"
#include "base/text.h"
#include "centre.h"
#include "database.h"
#include "decide/steps.h"

/* One night. Texts are shared (base/text.h): they stay. */
typedef struct fm_series_night {
    const char *run_id, *started, *git_commit, *case_id, *status, *noisy, *image;
    const char *code[4]; /* program, driver, plugin, shaders */
    fm_interval frame_ms;
    fm_centre centre; /* of the launches' ratios to the reference */
    double bytes_allocated, missing, extra, misordered, max_abs, total_rmse;
} fm_series_night;

typedef struct fm_series {
    const char *name;  /* what joins it (compare/join.h) */
    const char *title; /* as a reader calls it; of the last night */
    const char *method;
    const char *machine; /* fingerprint */
    const char *device_name;
    double n;
    fm_series_night *nights; /* [count], the oldest first; owned */
    size_t count;
    fm_step *steps; /* [step_count]: index is that of a night; owned */
    size_t step_count;
    fm_alarm alarm; /* of the last night */
} fm_series;

typedef struct fm_series_desc {
    const char *wanted;    /* a method, an id or a title of a case; NULL: all */
    const char *machine;   /* fingerprint; NULL: all machines, each on its own */
    const char *reference; /* a method; NULL, "floor": the floor of the same launch */
    double level;          /* of a step in one series where there is none; 0: 0.01 */
    const char *until;     /* a run_id: nights are those that began before this run did, and it, the
                              last one; NULL: all */
    size_t most;           /* the last so many nights; 0 or above RANK_SUM_VALUES: as many */
} fm_series_desc;

typedef struct fm_series_list {
    fm_series *items; /* [count]; owned */
    size_t count;
} fm_series_list;

/* All series that were asked for: those whose last step is newest come first; of one night's the
 * greatest slow-down; then those without a step, by name. A night is a run that has the case; runs
 * of one machine are in the order in which they began. Nights without a ratio are in it, and steps
 * pass over them. Alarms share their level over the series of their machine that the last run has.
 *
 * FM_UNSUPPORTED: no case of that name, with the nearest; no such machine or run; no case of the
 * reference method; else as database.h says. The caller frees, after a failure too. */
fm_status history_series(fm_series_list *list, fm_history *history, const fm_series_desc *desc,
                         fm_error *err);
void history_series_free(fm_series_list *list);

/* NULL: it has none. */
const fm_step *series_last_step(const fm_series *series);

/* Adds a sentence without its end. */
void alarm_add_words(fm_text *text, const fm_alarm *alarm);
/* Lines of all series, a block each. */
void history_add_series(fm_text *text, const fm_series_list *list, const char *reference);
/* The same as JSON. FM_NO_MEMORY. */
fm_status history_add_series_json(fm_text *json, const fm_series_list *list, const char *reference,
                                  fm_error *err);

#endif
