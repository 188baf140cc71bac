/* What the files that fill a row of summary.csv share; nobody else includes it. From below:
 *   summary_row.c      samples of a case, and their medians
 *   summary_ratios.c   times over the floor's and over the bound
 *   summary.c          all columns */
#ifndef FM_SUMMARY_INTERNAL_H
#define FM_SUMMARY_INTERNAL_H

#include "results.h"

/* What the columns of one row read. */
typedef struct row_state {
    const fm_results *results;
    const fm_case *measured;
    const fm_case_result *result;
    const fm_plugin_entry *plugin; /* may be NULL */
    size_t samples, excluded;      /* frames used and left out */
    bool *is_off_clock;            /* [launch * frames + frame] */
    double *values;                /* room for all samples */
    uint32_t *groups;
    double *by_launch; /* room for all launches */
} row_state;

/* summary_row.c */
/* Gathers a metric's used samples of one launch, or of all (UINT32_MAX), in values and groups;
 * returns how many there are. */
size_t summary_gather(const row_state *row, fm_metric metric, uint32_t launch);
/* Of all launches, with its interval. */
fm_interval summary_frames(const row_state *row, fm_metric metric);
/* Of a metric's used samples of one launch, or of all (UINT32_MAX); NAN: there are none. */
double summary_median(const row_state *row, fm_metric metric, uint32_t launch);
/* Of the row's intervals; 0: the usual one. */
double summary_coverage(const row_state *row);
/* A metric of the checked launch; NULL: it has none of this name. */
const json_t *summary_metric(const row_state *row, fm_metric metric);

/* summary_ratios.c: all NAN where something is not known. */
fm_interval summary_times_floor(const row_state *row);
fm_interval summary_bound_ms(const row_state *row);
fm_interval summary_times_bound(const row_state *row);
/* NULL: the device of the case was not measured, or is not known yet. */
const fm_device_limits *summary_limits(const fm_results *results, const fm_case_result *result);
/* What the device of the row can do. */
fm_interval summary_limit(const row_state *row, fm_limit limit);
/* Column limited_by. */
const char *summary_limited_by(const row_state *row);

#endif
