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

/* Why a case is FM_CASE_NOT_SUPPORTED, in a word: column `reason` of summary.csv. Other statuses
 * say it themselves, and have none. feed          the method or the device does not take it, or the
 * scene is not made for it setting       the value of a key or of an option, alone or with others,
 * cannot be had with it depth-test    a pass tests the rasterised depth, and the projection is
 * reversed feature       the device lacks what the method needs: atomics, an interlock, a format,
 * ... device-limit  the device has it, but not so large or so many: bytes, samples, layers,
 * bindings loops         the driver would end, or has ended, loops that need more iterations
 *   suite-limit   fragmark's own: passes, resources, 2^32 fragments, iterations
 *   scene         its file cannot be read, or is not to be drawn so
 *   driver        its compiler gives up, or it refuses fragmark's own shaders */
const char *case_reason_name(fm_reason reason); /* FM_REASON_NONE: "" */
/* "" is FM_REASON_NONE. false: no such word, or NULL; then *nearest is a word that is meant
 * perhaps, or NULL; nearest may be NULL. */
bool case_reason_parse(fm_reason *reason, const char *name, const char **nearest);

#endif
