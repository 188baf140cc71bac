/* Named runs that later ones are held against: "release-1", "before-the-rewrite".
 *
 * The room reports/baseline keeps copies of result files, so that a baseline outlives the folder
 * that it was set from, and is a folder of results itself, which fragmark compare reads:
 *
 *   STATE/baselines/NAME/FINGERPRINT/manifest.json summary.csv samples.csv journal.jsonl
 *                                    baseline.json  where from, when, and the hash of each file
 *
 * One name may have a run of each machine (model/hardware.h). */
#ifndef FM_BASELINE_H
#define FM_BASELINE_H

#include <stddef.h>

#include "base/path.h"
#include "base/text.h"
#include "model/hardware.h"
#include "read/result_files.h"

enum { FM_BASELINE_NAME_BYTES = 65 };

typedef struct fm_baseline {
    char name[FM_BASELINE_NAME_BYTES];
    char machine[FM_FINGERPRINT_BYTES];
    char path[FM_PATH_MAX_BYTES]; /* its folder */
    void *json;                   /* baseline.json; owned by the list */
} fm_baseline;

typedef struct fm_baseline_list {
    fm_baseline *items; /* [count], by name, then machine; owned */
    size_t count;
} fm_baseline_list;

/* A line of baseline.json: "from" (absolute), "set", "run_id", "started", "git_commit", "cpu",
 * "cores". "": none. It lives as long as the list. */
const char *baseline_fact(const fm_baseline *baseline, const char *name);

/* Copies the files of a run that was read, and puts the copy into the place of what the name had of
 * this machine, as a whole. FM_UNSUPPORTED: a name with other characters than letters, digits,
 * '.', '_' and '-', one that begins with '.', or is too long; or the manifest does not tell the
 * machine. FM_INVALID, FM_IO, FM_NO_MEMORY: a file cannot be copied; what was there stays.
 * path: of the baseline; store: the folder STATE/baselines, which is made if need be. */
fm_status baseline_set(char path[FM_PATH_MAX_BYTES], const char *store, const char *name,
                       const fm_result_files *results, fm_error *err);

/* All of a name, or all; without a store there are none. FM_INVALID: a damaged baseline.json;
 * FM_IO, FM_NO_MEMORY. The caller frees, after a failure too. */
fm_status baselines_read(fm_baseline_list *list, const char *store, const char *name,
                         fm_error *err);
void baselines_free(fm_baseline_list *list);

/* Whether its files are those that were copied. FM_INVALID: one is gone or other; FM_IO. */
fm_status baseline_check(const fm_baseline *baseline, fm_error *err);

/* The folder of NAME, or NAME@FINGERPRINT, to hold a run against: that of the run's machine,
 * checked. FM_UNSUPPORTED: no such baseline, with the nearest, or none of this machine, with the
 * fingerprints that there are: milliseconds of those do not compare, ratios do. Else as above. */
fm_status baseline_find(char path[FM_PATH_MAX_BYTES], const char *store, const char *wanted,
                        const fm_provenance *now, fm_error *err);

/* A line each, below headings; none: a sentence. */
void baselines_add_lines(fm_text *text, const fm_baseline_list *list);
/* What baseline.json says, as JSON. FM_NO_MEMORY. */
fm_status baselines_add_json(fm_text *json, const fm_baseline_list *list, fm_error *err);

#endif
