/* What a nightly is asked for: a policy file, or what stands for one.
 *
 * The room nightly holds `fragmark nightly`: it chooses what fits the time, has `fragmark run`
 * measure it, and has `fragmark-report night` record and judge it. A night's folder says how far it
 * came (state.h), so that a nightly that was killed goes on. */
#ifndef FM_NIGHTLY_POLICY_H
#define FM_NIGHTLY_POLICY_H

#include <stdint.h>

#include "base/path.h"
#include "base/text.h"

typedef struct fm_policy {
    fm_text_list methods, scenes, devices, feeds, axes, plugin_folders; /* as after --method, ... */
    fm_text_list build;             /* a command and its arguments; none: nothing is built */
    char folder[FM_PATH_MAX_BYTES]; /* of the policy's file, in which it is executed */
    char base[FM_PATH_MAX_BYTES];   /* a build, or a folder of methods, that what is slower is held
                                       against; "": none */
    char spec[FM_PATH_MAX_BYTES];   /* a spec file that they stand over; "": none */
    char output[FM_PATH_MAX_BYTES]; /* the folder of nights; "": STATE/nights */
    char state[FM_PATH_MAX_BYTES];  /* "": the usual folder (base/state.h) */
    char baseline[96];              /* "": none */
    char reference[64];             /* a method; "": floor */
    double budget_minutes;
    double effect;                          /* a step of this factor is to be found; above 1 */
    uint32_t launches_least, launches_most; /* of each case */
    char hash[17]; /* of what was asked for: nights of one hash measure the same */
} fm_policy;

/* Reads a file; NULL: the defaults, all methods on a small scene for ten minutes. Paths in it are
 * seen from its folder. FM_INVALID with file and line, FM_IO, FM_NO_MEMORY. The caller frees, after
 * a failure too. */
fm_status policy_read(fm_policy *policy, const char *path, fm_error *err);
void policy_free(fm_policy *policy);

/* What is left of the budget once it was built for so long. */
double policy_seconds(const fm_policy *policy, double built_s);
/* The share of that which launches take: the rest draws and judges, and confirms where there is a
 * base. */
double policy_launch_share(const fm_policy *policy);

#endif
