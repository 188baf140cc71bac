/* One night judged: what became worse, against the nights before and a baseline.
 *
 * The room reports/night makes findings (this header) of a run that the history has recorded, and
 * writes them as one page of Markdown, as JUnit XML, and as JSON. It measures nothing. */
#ifndef FM_NIGHT_H
#define FM_NIGHT_H

#include "history/runs.h"
#include "history/series.h"
#include "read/result_files.h"

typedef enum fm_finding_kind {
    FM_FINDING_SLOWER, /* the alarm of its series */
    FM_FINDING_STATUS, /* a worse status */
    FM_FINDING_MEMORY, /* more bytes */
    FM_FINDING_ERROR,  /* a larger error, or more fragments missing, extra or out of order */
    FM_FINDING_COUNT
} fm_finding_kind;

const char *finding_kind_name(fm_finding_kind kind); /* "slower" */

typedef struct fm_finding {
    fm_finding_kind kind;
    size_t case_index; /* in the run */
    bool is_confirmed; /* by fresh launches; of exact findings nobody asks */
    bool is_dismissed; /* it was to be confirmed, and was not: no alarm */
    char text[320];    /* "bytes_allocated 4096 -> 8192 since 2026-01-31T01:00:00Z" */
} fm_finding;

/* ", confirmed", ", not confirmed" or "": behind the name of its kind. */
const char *finding_standing(const fm_finding *finding);

/* Whether a finding that hangs on noise stands after a look at fresh launches, say (gate.h). It may
 * set the text and is_confirmed: what nobody could look at stands, too, unconfirmed. */
typedef bool fm_night_confirm(fm_finding *finding, const fm_result_files *now, void *context);

typedef struct fm_night_desc {
    fm_history *history;             /* has recorded `now` */
    const fm_result_files *now;      /* the night's run */
    const fm_result_files *baseline; /* NULL: none */
    const char *baseline_name;       /* for texts; NULL: none */
    const char *reference;           /* of ratios: a method; NULL: floor */
    double effect;             /* a step of this factor should be found in three nights; 0: 1.06 */
    fm_night_confirm *confirm; /* FM_FINDING_SLOWER alone is handed to it; NULL: nobody confirms */
    void *context;
    const char *unconfirmed;   /* why findings on time are not: a sentence for the summary, if there
                                  is   such a finding; NULL: that they are not, alone */
    const fm_text_list *notes; /* sentences for the summary: what was left out, say; may be NULL */
} fm_night_desc;

/* What is known of one case of the run. */
typedef struct fm_night_case {
    const fm_series *series;         /* NULL: it has none */
    const fm_series_night *previous; /* the night before on this machine; NULL: none */
} fm_night_case;

typedef struct fm_night_result {
    const fm_night_desc *desc;
    fm_series_list series; /* up to this run */
    fm_newer_runs newer;   /* which the history has, too, and which are not looked at */
    fm_night_case *cases;  /* [now->count]; owned */
    fm_finding *findings;  /* [count], in the order of the kinds; owned */
    size_t count, capacity;
    size_t alarms;       /* findings that were not dismissed */
    size_t early;        /* cases of too few nights for an alarm on time */
    size_t new_failures; /* cases that failed and have no night before, nor a baseline */
    size_t
        launches_needed; /* a night, so that `effect` is found in the noisiest case; 0: unknown */
    double noisiest;     /* its standard error now; NAN: unknown */
} fm_night_result;

/* Judges this run, be it the last one of the history or not, by nights that began before it did.
 * Statuses, memory and errors are held against the night before and the baseline, exactly, as
 * fragmark compare does; times by the alarms of their series (history/alarm.h). Times are never
 * held against one night alone. desc is borrowed. FM_INVALID, FM_IO, FM_NO_MEMORY as database.h;
 * FM_UNSUPPORTED: the reference is not in the history. The caller frees, after a failure too. */
fm_status night_judge(fm_night_result *night, const fm_night_desc *desc, fm_error *err);
void night_free(fm_night_result *night);

/* One page: verdict, findings, counts, how sure, steps. */
void night_add_markdown(fm_text *text, const fm_night_result *night);
/* A testcase a case: findings are failures; what failed and has no night before is an error; what
 * is not supported, or failed before, is skipped. */
void night_add_junit(fm_text *xml, const fm_night_result *night);
/* For programs, and for the next night: verdict, findings, launches_needed. FM_NO_MEMORY. */
fm_status night_add_json(fm_text *json, const fm_night_result *night, fm_error *err);

#endif
