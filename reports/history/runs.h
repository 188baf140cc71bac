/* The runs of a history. */
#ifndef FM_HISTORY_RUNS_H
#define FM_HISTORY_RUNS_H

#include <stddef.h>

#include "base/text.h"
#include "database.h"

/* Texts are shared (base/text.h): they stay. */
typedef struct fm_run_entry {
    const char *run_id, *started, *git_commit, *version, *command, *directory;
    const char *machine, *cpu; /* fingerprint, and the name of its processor */
    const char *cores;
    double memory_bytes;
    size_t cases, ok, failed; /* failed: neither ok nor not_supported nor skipped */
} fm_run_entry;

typedef struct fm_run_list {
    fm_run_entry *items; /* [count], the newest first; owned */
    size_t count;
} fm_run_list;

/* The caller frees, after a failure too. */
fm_status history_runs(fm_run_list *runs, fm_history *history, fm_error *err);
void history_runs_free(fm_run_list *runs);

/* Runs of a run's machine that began after it did, and have one of its cases. */
typedef struct fm_newer_runs {
    size_t count;
    const char *last; /* when the last of them began; "": there is none. Shared (base/text.h) */
} fm_newer_runs;

fm_status history_newer_runs(fm_newer_runs *newer, fm_history *history, const char *run_id,
                             fm_error *err);

/* A line a run below a line of headings; none: a sentence. */
void history_add_runs(fm_text *text, const fm_run_list *runs);
/* The same as JSON. FM_NO_MEMORY. */
fm_status history_add_runs_json(fm_text *json, const fm_run_list *runs, fm_error *err);

#endif
