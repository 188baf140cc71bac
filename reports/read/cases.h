/* Rows of summary.csv: one a case. What each number means stands in model/metrics.h. */
#ifndef FM_READ_CASES_H
#define FM_READ_CASES_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "base/table.h"
#include "base/text_index.h"
#include "model/columns.h"
#include "model/outcome.h"
#include "provenance.h"

/* One row. Texts belong to the table and the manifest, and are "" where the cell is empty; numbers
 * are NAN there. Names, units and meanings are those of the columns. */
typedef struct fm_case_row {
    /* who, where, and what became of it */
    const char *id; /* at most 64 bytes, without '/': names of pictures are made from it */
    const char *status, *message, *method, *method_version, *device, *device_name, *feed;
    const char *scene, *order, *seed, *options; /* options: read by options.h */
    const char *reason; /* of not_supported, a word of model/outcome.h; "": of an older run, too */
    const char *limited_by; /* feed, bytes, atomics; "": not known */
    const char *noisy;      /* why its times are not to be relied on; "": no reason is known */
    /* what it was measured by: hashes; "": none came so far, or an older file */
    const char *code_program, *code_driver, *code_plugin, *code_shaders;
    /* the workload; k is NAN for methods that keep no k nearest */
    double width_px, height_px, k, r, pixel_density, fragment_probability, tessellation;
    /* By fm_metric; NAN for those that summary.csv has no column for. total_rmse of an older run,
     * which has none, is from samples.csv; where that lacks it, too, it is rmse, if nothing was
     * truncated. */
    double metric[FM_METRIC_COUNT];
    /* Ends of its interval, the same: NAN where one launch has none, or the file has no column. */
    double low[FM_METRIC_COUNT], high[FM_METRIC_COUNT];

    /* what follows from the row and from manifest.json */
    fm_case_status outcome; /* of the word `status` */
    fm_method_info look;    /* of the method; its id for a title where the manifest lacks it */
    uint64_t figures;       /* bit i: figures.csv lists the case for figure_names[i] */
    bool is_ok;
    bool is_measured;     /* has a time, and its error: ok, or wrong_image */
    bool is_simulated;    /* feed frames: counts and models, no times */
    bool is_software;     /* the device; also where the manifest does not list it yet */
    bool is_device_known; /* the manifest lists it */
} fm_case_row;

/* One row of the table each, in its order, and the place of each id. FM_INVALID, naming file, line
 * and column: another schema; a column is missing, or is unknown and stands before known ones
 * (those of newer programs stand behind them); a number is none, or out of range: times and amounts
 * are finite and not negative, shares at most 1, ends of an interval in order; a status, reason,
 * id or method cannot be; two rows are of one case. FM_NO_MEMORY. The caller frees *cases and the
 * index, after a failure too. */
fm_status cases_read(fm_case_row **cases, fm_text_index *ids, const fm_table *table,
                     const fm_provenance *manifest, fm_error *err);

/* 2^E of the case's exposure, by which it scales errors and their rounding; at least 1: dark
 * pictures round no less. */
double case_brightness(const fm_case_row *result);

/* The number column of that name; false: there is none. */
bool case_number(double *value, const fm_case_row *result, const char *name);

#endif
