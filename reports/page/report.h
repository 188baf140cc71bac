/* A directory of results becomes charts/, pictures and report.html.
 *
 * The room reports/page writes the report: one file that opens from disk, with charts, tables and
 * pictures inside. report.c puts the sections in order (publish.h puts all files in place;
 * paper_section, picture_section, speed_section, stability_section, page.h for all that is the same
 * in every report); writer.h is what they share; html.h, case_table, memory_rows and verdict_table
 * are pieces. HTML is written nowhere else. What is shown is worked out below: numbers by read,
 * verdicts by claims, charts and PNGs by draw. */
#ifndef FM_REPORT_H
#define FM_REPORT_H

#include <stddef.h>

#include "base/error.h"
#include "claims/verdicts.h"
#include "read/paper_figure.h"
#include "read/result_files.h"
#include "tradeoff/error_kind.h"

/* What a report is made of; all of it is borrowed. */
typedef struct fm_report_desc {
    const fm_result_files *results;        /* the report is written into their directory */
    const fm_result_files *reference;      /* of another machine; NULL: none */
    bool draws_reference;                  /* in all charts; false: in charts of ratios only */
    const fm_claim_results *verdicts;      /* of the figures' claims; NULL: none */
    const fm_paper_figure *const *figures; /* [figure_count]; 0: no sections of papers */
    size_t figure_count;
    const fm_error_kind *error; /* what is held against time */
} fm_report_desc;

/* How much was written. */
typedef struct fm_report_outcome {
    size_t chart_count, picture_count;
    size_t unexplained_count; /* cases whose errors no trait of their method explains */
} fm_report_outcome;

/* Writes charts/NAME.svg and .png, claims.csv, pictures in images/, and report.html. All but the
 * pictures are put in place together when everything is drawn (publish.h): if it fails, the report
 * that was there stays. Without a claim there is no claims.csv. FM_IO, FM_NO_MEMORY; FM_INVALID: a
 * damaged picture or table, a path that is too long, or the report that is there was made of
 * results that lacked less. */
fm_status report_write(fm_report_outcome *outcome, const fm_report_desc *desc, fm_error *err);

#endif
