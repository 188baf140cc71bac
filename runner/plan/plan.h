/* methods x scenes x devices x feeds x axes -> cases.
 *
 * The room plan reads what is asked for and says what that is, case by case, and why a case cannot
 * run. It opens no device and measures nothing; what a device is others find out for it. */
#ifndef FM_PLAN_H
#define FM_PLAN_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "base/text.h"
#include "base/text_index.h"
#include "device/registry.h"
#include "model/auto_option.h"
#include "model/descriptor.h"
#include "model/outcome.h"
#include "model/settings.h"
#include "plugin/plugin.h"

/* One row of the summary. */
typedef struct fm_case {
    char id[17]; /* xxhash of what makes the case another one: method and its version, scene
                    by name and by hash, device, feed, k and the other keys of a case, and the
                    value of each option, given or not */
    char method[64];
    char scene[128];  /* name of the scene as given */
    char device[128]; /* "vulkan", "vulkan:1", "osmesa" */
    char feed[32];    /* "raster", "compute-layer", ... */
    fm_settings settings;
    uint64_t given[FM_MAX_KEYS / 64]; /* bit i: an axis sets fm_keys[i], not the scene */
    fm_choice *choices;               /* [choice_count]: of each option its value, that of the
                                         descriptor if no axis sets it, and for `auto` what it
                                         means on the device; owned by the plan */
    size_t choice_count;
    char *skip;                 /* why it is not launched; owned by the plan; NULL: it is */
    fm_case_status skip_status; /* what is then recorded: FM_CASE_NOT_SUPPORTED (k above k_max, a
                                   feed or an option's value that the method does not have, a mesh
                                   that cannot be read), or FM_CASE_PLUGIN_ERROR (it was refused) */
    fm_reason skip_reason;      /* with FM_CASE_NOT_SUPPORTED its word; else FM_REASON_NONE */
    bool is_unread;             /* it is skipped because its scene's file cannot be read */
    uint32_t worked_out;        /* bit i: choices[i] was left to the runner (model/auto_option.h) */
    bool no_image;              /* its picture is not kept; no part of its id */
} fm_case;

/* Whether an axis sets the key. */
bool case_is_given(const fm_case *planned, const fm_key *key);

/* Lists of texts, each ending with NULL. */
typedef struct fm_plan_request {
    const fm_device_list *known_devices; /* what the names in `devices` are looked up among */
    const char *spec;                    /* YAML file; NULL: none */
    const char *const *methods;          /* ids; empty or "all": all that are not controls */
    const char *const *scenes;  /* names in the scene folders or paths of .yml; empty: "layers" */
    const char *const *devices; /* empty: "vulkan" */
    const char *const *feeds;   /* empty: "raster" */
    const char *const *axes; /* "KEY=VALUE[,VALUE...]", "KEY=LOW:HIGH:*FACTOR|+STEP"; KEY is one of
                                fm_keys, an option of a chosen method, or method, scene, device
                                or feed, which add to the lists above */
    /* What a device is, as far as `auto` of an option hangs on it; asked once a device, and only
     * where a case has that. NULL, or an error, which the plan keeps: such cases have `auto`. */
    fm_status (*ask)(fm_auto_device *device, const void *context, const char *name, fm_error *err);
    const void *context;
} fm_plan_request;

#define FM_SHARD_TABLE "shard.csv" /* in the folder of a shard's results */

/* Which part of a plan this is; plan/shard.h makes it. */
typedef struct fm_shard {
    uint32_t index, count; /* 1..count; count 0: the plan is whole */
    char plan[17];         /* plan_hash of the whole plan */
    size_t case_count;     /* of the whole plan */
    size_t group_count;    /* of cases that stay together: more shards than that have none */
    char reference[64];    /* method whose cases are in every shard; "": none */
    fm_text table;         /* shard.csv: the shard of each case of the whole plan; owned */
} fm_shard;

typedef struct fm_plan {
    fm_case *cases;
    size_t count;
    uint64_t seed;           /* of the order of launches */
    uint32_t launches;       /* the most of any case */
    uint32_t frames, warmup; /* the same */
    fm_error unknown;        /* why a device could not be asked; FM_OK: none had to be, or all
                                answered. Else cases have `auto` for an option: none may be run */
    fm_shard shard;
} fm_plan;

enum { FM_PLAN_MAX_CASES = 100000 }; /* before equal ones become one */

/* Expands a request: scene by scene, device by device, feed by feed, method by method, the last
 * axis fastest. A spec is a YAML mapping of `methods`, `scenes`, `devices`, `feeds` (lists or one
 * name) and of keys and options, each with a value, a text as after -a, or a list; paths in it are
 * seen from its folder. An option concerns the methods that have it, a scene's key the scenes whose
 * generator reads it; one that concerns nobody is an error. n and r replace one another.
 * Command line wins over the spec, the spec over the scene file, the scene file
 * over defaults. Cases that differ only in a key their method does not use (k of an A-buffer)
 * are one case. Unknown names: FM_INVALID with file, line and the nearest legal one. Refused
 * plugins become cases that are not launched. */
fm_status plan_expand(fm_plan *plan, const fm_plan_request *request, const fm_plugin_list *plugins,
                      fm_error *err);
/* Takes the cases of another plan that this one does not have, and what they own; a case that both
 * have is measured as often as either wants. What stays of `more` is still to be freed.
 * FM_NO_MEMORY: nothing was taken. */
fm_status plan_merge(fm_plan *plan, fm_plan *more, fm_error *err);
void plan_free(fm_plan *plan);
/* What makes two runs the same run: what they measure, how often, in which order, and which shard
 * of a plan they are. 16 hex digits; "": no memory. */
void plan_hash(char hash[17], const fm_plan *plan, bool validation, bool no_timers);
/* Adds the id of each case, with its place in the plan. false: no memory. */
bool plan_index_ids(fm_text_index *ids, const fm_plan *plan);
/* How often a case is launched: as often as the plan says, but once if it is simulated and nobody
 * asked for more, since all launches of it would say the same. With a precision it is how often at
 * most; the run decides, at the looks of decide/precision.h. */
uint32_t plan_case_launches(const fm_plan *plan, size_t index);
/* How often at least: until the first look where there is a precision, else the same. */
uint32_t plan_case_least_launches(const fm_plan *plan, size_t index);

#endif
