/* Fabricated results and figures for tests of claims. */
#ifndef FM_CLAIMS_KIT_H
#define FM_CLAIMS_KIT_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "base/table.h"
#include "base/text.h"
#include "claims/verdicts.h"
#include "image/image.h"
#include "read/paper_figure.h"
#include "read/result_files.h"

/* One fabricated case. Its launches have one frame each, and spread over `noise`. */
typedef struct fake {
    const char *method;
    double k, pixel_density, frame_ms, resolve_ms;
    const char *options, *status, *device, *feed; /* NULL: "", ok, soft, raster */
    double noise;                                 /* 0: one percent */
    int launches;                                 /* 0: 6 */
    double missing, bytes;
    unsigned seed;     /* 0: 1 */
    double n, r;       /* 0: n is 16, r is empty */
    const char *scene; /* NULL: layers */
} fake;

#define ROW(of, keeps, density, time_ms)                                                           \
    .method = (of), .k = (keeps), .pixel_density = (density), .frame_ms = (time_ms), .resolve_ms = 1

typedef struct fakes {
    fake rows[12];
} fakes;

/* What is left of a judged claim. */
typedef struct judged {
    fm_verdict verdict;
    char device[160];
    size_t count, required_failed;
} judged;

/* Writes summary.csv, samples.csv and manifest.json into a new directory. */
void kit_make_results(char directory[64], const fakes *all);
void kit_write_file(const char *directory, const char *name, const char *text);
void kit_remove_directory(const char *directory);
/* Writes a figure with the one claim whose keys are given, one a line, and reads it. */
fm_status kit_read_figure(fm_paper_figure **figure, const char *directory, const char *claim,
                          fm_error *err);
/* Judges the claim on these rows; reference: of another machine, or NULL. */
judged judge_beside(const char *claim, const fakes *rows, const fakes *reference);
/* The verdict of a claim on these rows of memory.csv, which come without their head. */
fm_verdict_kind kit_judge_memory(const char *memory_rows, const char *claim);

#endif
