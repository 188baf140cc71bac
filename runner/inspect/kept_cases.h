/* Which cases of a run something was kept of, and their files. */
#ifndef FM_KEPT_CASES_H
#define FM_KEPT_CASES_H

#include "base/text.h"
#include "base/text_index.h"
#include "truth/kept_file.h"

/* What is told of a case: columns of summary.csv. */
typedef enum kept_fact {
    KEPT_CASE_ID,
    KEPT_STATUS,
    KEPT_METHOD,
    KEPT_DEVICE,
    KEPT_FEED,
    KEPT_SCENE,
    KEPT_N,
    KEPT_K,
    KEPT_SEED,
    KEPT_OPTIONS,
    KEPT_FACT_COUNT
} kept_fact;
extern const char *const kept_facts[KEPT_FACT_COUNT];

typedef struct kept_case {
    char *facts[KEPT_FACT_COUNT]; /* owned; "" where summary.csv has no row of it */
    uint32_t kinds;               /* files that there are, as bits 1u << kept_kind */
} kept_case;

/* Starts as {0}. */
typedef struct kept_cases {
    kept_case *cases; /* by their ids */
    size_t count, capacity;
    fm_text_index ids; /* while they are read */
} kept_cases;

/* What lies in DIRECTORY/kept. FM_INVALID: nothing was kept. FM_IO: a folder or summary.csv cannot
 * be read; a run that was stopped before its first row has none. FM_NO_MEMORY. kept_cases_free in
 * any case. */
fm_status kept_cases_read(kept_cases *cases, const char *directory, fm_error *err);
void kept_cases_free(kept_cases *cases);

/* The one case that has these facts; NULL or "": any. FM_INVALID: none, with the nearest there is,
 * or several, which the message lists. */
fm_status kept_cases_choose(const kept_case **chosen, const kept_cases *cases,
                            const char *const wanted[KEPT_FACT_COUNT], fm_error *err);

/* Files of one case, or one file alone. Starts as {0}. */
typedef struct kept_files {
    kept_map maps[KEPT_KIND_COUNT];
    const kept_map *files[KEPT_KIND_COUNT]; /* NULL: there is none */
    bool is_damaged;                        /* what failed is what a file holds */
} kept_files;

/* All of the case's. kept_files_close in any case; else as kept_open. FM_IO with is_damaged, too:
 * fragments and truth are of pictures of different sizes. */
fm_status kept_files_open(kept_files *files, const char *directory, const kept_case *of,
                          fm_error *err);
fm_status kept_files_open_one(kept_files *files, const char *path, fm_error *err);
void kept_files_close(kept_files *files);

#endif
