/* What the parts of one report share. */
#ifndef FM_WRITER_H
#define FM_WRITER_H

#include "base/text.h"
#include "draw/chart.h"
#include "report.h"

typedef struct fm_writer {
    const fm_report_desc *desc;
    const fm_result_files *results; /* desc's */
    fm_text page;                   /* report.html so far; owned by report_write */
    fm_report_outcome *outcome;
    fm_error *err; /* of all of them */
} fm_writer;

/* Adds a chart: as charts/NAME.svg and .png, and in the page.
 * status  of making it: FM_UNSUPPORTED becomes a sentence in the page, other failures are returned
 * name    letters, digits and hyphens; at most 256 bytes
 * Frees the chart. FM_IO, FM_NO_MEMORY; FM_INVALID: it cannot be drawn. */
fm_status writer_add_chart(fm_writer *to, fm_chart *chart, fm_status status, const char *name);

#endif
