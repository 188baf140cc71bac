/* Fabricated runs for tests of comparisons. */
#ifndef FM_COMPARE_KIT_H
#define FM_COMPARE_KIT_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "compare/comparison.h"

/* A run as it lies on disk, and as it is read. */
typedef struct kit_run {
    char directory[64];
    fm_result_files *results;
} kit_run;

/* What differs from a usual run; NULL: nothing. */
typedef struct kit_run_desc {
    const char *const *rows; /* [row_count]: "method=a;k=4;frame_ms=10": cells of summary.csv; the
                                others are as usual, and the id is c0, c1, ... */
    size_t row_count;
    const char *samples; /* "c0 0 frame_ms 10\n...": case, launch, metric, value of one frame */
    const char *journal; /* lines after the first; NULL: there is no journal */
    const char *machine; /* "\"cpu\": \"x\", ..." */
    const char *started; /* "2026-01-02T..." */
    const char *devices; /* of the manifest: "{...}, {...}"; "": none, as of an interrupted run */
    const char *run_id;
} kit_run_desc;

/* rows and row_count of a desc, from an array. */
#define ROWS(array) .rows = (array), .row_count = sizeof(array) / sizeof(array)[0]

void kit_open(kit_run *run, const kit_run_desc *desc);
void kit_close(kit_run *run);

/* Two runs of that, compared; all is freed by kit_end. */
typedef struct kit_comparison {
    kit_run base, now;
    fm_comparison made;
    fm_status status;
    fm_error err;
} kit_comparison;

void kit_compare(kit_comparison *kit, const kit_run_desc *base, const kit_run_desc *now,
                 const fm_quantity_desc *quantity);
void kit_end(kit_comparison *kit);

/* The case of that id in BASE. */
const fm_compared *kit_case(const kit_comparison *kit, const char *id);

#endif
