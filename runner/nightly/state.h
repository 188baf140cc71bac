/* How far a night came: NIGHT/nightly.json, written before each stage. */
#ifndef FM_NIGHTLY_STATE_H
#define FM_NIGHTLY_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/path.h"
#include "base/text.h"

typedef enum fm_night_stage {
    FM_NIGHT_BUILDS,   /* the policy's `build` is at work */
    FM_NIGHT_PLANS,    /* it has ended well; what fits is not chosen yet */
    FM_NIGHT_MEASURES, /* NIGHT/run is begun */
    FM_NIGHT_JUDGES,   /* it is measured, or its time is over; perhaps for the second time */
    FM_NIGHT_CONFIRMS, /* NIGHT/gate is begun, for what was found slower */
    FM_NIGHT_DONE,
    FM_NIGHT_GIVEN_UP, /* it was not built, or could not be planned; or its rows were begun with
                          other code, or another plan, than came after */
    FM_NIGHT_STAGES
} fm_night_stage;

/* What a gate said of findings on time. */
typedef enum fm_night_gate {
    FM_NIGHT_GATE_NONE, /* it was not asked */
    FM_NIGHT_GATE_ANSWERED,
    FM_NIGHT_GATE_NO_TIME, /* the budget was spent before its end */
    FM_NIGHT_GATE_FAILED,  /* it could not measure */
    FM_NIGHT_GATES
} fm_night_gate;

typedef struct fm_night_state {
    char folder[FM_PATH_MAX_BYTES]; /* NIGHT: ROOT/20260131T010000Z */
    fm_night_stage stage;
    char policy[17];      /* fm_policy.hash */
    int64_t begun_s;      /* since 1970 */
    uint32_t launches;    /* of each case */
    uint32_t cases;       /* that are launched; 0: not known */
    uint32_t part, parts; /* tonight's share of the methods; parts 1: all */
    fm_text_list methods; /* of the part; none: those of the policy */
    double measured_s;    /* in attempts that ended, or were killed */
    int64_t attempt_s;    /* when the attempt began that runs, or was killed; 0: none */
    bool is_cut_off;      /* the time was over before all launches were */
    double built_s;       /* what `build` took, in all attempts that ended */
    fm_night_gate gate;
    double confirmed_s;     /* in gates that ended, or were killed */
    int64_t gate_attempt_s; /* as attempt_s, of the gate */
    int code;               /* with which the night ended; DONE alone */
} fm_night_state;

/* Replaces nightly.json, as a whole. FM_IO, FM_NO_MEMORY. */
fm_status night_state_write(const fm_night_state *state, fm_error *err);
/* FM_IO: there is none; FM_INVALID: damaged. The caller frees, after a failure too. */
fm_status night_state_read(fm_night_state *state, const char *folder, fm_error *err);
void night_state_free(fm_night_state *state);

/* Whether there is something left to do. */
bool night_is_open(const fm_night_state *state);

/* The nights in ROOT, by name and so by time; none without it. FM_IO, FM_NO_MEMORY. */
fm_status nights_list(fm_text_list *names, const char *root, fm_error *err);

/* What the night before this one found out, for a plan of the next; zero: unknown. */
typedef struct fm_night_past {
    double seconds_per_round; /* of one launch of each of its cases; of a night that was cut off
                                 by the launches that its journal has */
    uint32_t launches_needed; /* NIGHT/night.json */
    uint32_t nights;          /* that were done, of this policy: whose part it is */
    uint32_t parts;           /* of the last of them */
} fm_night_past;
/* Of the nights of this policy; damaged ones count as none. FM_IO, FM_NO_MEMORY. */
fm_status night_past(fm_night_past *past, const char *root, const char *policy, fm_error *err);

/* Launches of the night that ended, by its journal. */
uint64_t night_launches_ended(const fm_night_state *state);

/* The time that was measured, with that of an attempt that was killed: up to the last line of its
 * journal. */
double night_measured_s(const fm_night_state *state);
/* The same of confirmations. */
double night_confirmed_s(const fm_night_state *state);

#endif
