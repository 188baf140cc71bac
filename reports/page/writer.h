/* What the parts of one report share. */
#ifndef FM_WRITER_H
#define FM_WRITER_H

#include "base/text.h"
#include "draw/chart.h"
#include "report.h"

typedef struct fm_writer {
    const fm_report_desc *desc;
    const fm_result_files *results; /* desc's */
    fm_text page;
    fm_report_outcome *outcome;
    fm_error *err;
} fm_writer;

/* The chart as charts/NAME.svg and .png and in the page. status: of making it; FM_UNSUPPORTED
 * becomes a sentence. Frees the chart. */
fm_status writer_add_chart(fm_writer *to, fm_chart *chart, fm_status status, const char *name);

#endif
