/* What became of a case: one word a case in summary.csv. */
#ifndef FM_OUTCOME_H
#define FM_OUTCOME_H

#include <stdbool.h>

#include "base/error.h"

/* In rising order of harm: a case has the worst status of its launches. */
typedef enum fm_case_status {
    FM_CASE_SKIPPED, /* no launch yet: the run was stopped before its turn */
    FM_CASE_OK,
    FM_CASE_NOT_SUPPORTED, /* a result: this device, or the method, cannot do it */
    FM_CASE_WRONG_IMAGE,   /* a method declared exact was not */
    FM_CASE_PLUGIN_ERROR,  /* the plugin or a shader of it was refused */
    FM_CASE_DEVICE_LOST,
    FM_CASE_OUT_OF_MEMORY,
    FM_CASE_TIMEOUT,
    FM_CASE_CRASH,
    FM_CASE_STATUS_COUNT
} fm_case_status;

/* What the message of a case says, perhaps among others, if its picture has no fragment at all. */
#define FM_NOTHING_DRAWN "nothing was drawn: no fragment lies in the picture"

const char *case_status_name(fm_case_status status);
/* false: no such word, or NULL. */
bool case_status_parse(fm_case_status *status, const char *name);
/* Launched in the next round? Only what measured something, or had no turn yet, is. */
bool case_status_continues(fm_case_status status);

/* Why a case is FM_CASE_NOT_SUPPORTED, in a word: column `reason` of summary.csv. What each means
 * stands beside fm_reason (base/error.h); its word is the end of its name, with hyphens:
 * "depth-test". Other statuses say it themselves, and have none. */
const char *case_reason_name(fm_reason reason); /* FM_REASON_NONE: "" */
/* "" is FM_REASON_NONE. false: no such word, or NULL; then *nearest is a word that is meant
 * perhaps, or NULL; nearest may be NULL. */
bool case_reason_parse(fm_reason *reason, const char *name, const char **nearest);

#endif
