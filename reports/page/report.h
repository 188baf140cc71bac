/* A directory of results becomes charts/, pictures and report.html. */
#ifndef FM_REPORT_H
#define FM_REPORT_H

#include <stddef.h>

#include "base/error.h"
#include "claims/verdicts.h"
#include "read/paper_figure.h"
#include "read/result_files.h"

typedef struct fm_report_desc {
    const fm_result_files *results;
    const fm_result_files *reference; /* of another machine; NULL: none */
    bool draws_reference;             /* in all charts, not in ratios only */
    const fm_claim_results *verdicts;
    const fm_paper_figure *const *figures; /* [figure_count]; none: no figures section */
    size_t figure_count;
} fm_report_desc;

typedef struct fm_report_outcome {
    size_t chart_count, picture_count;
} fm_report_outcome;

/* Writes charts/NAME.svg and .png, pictures in images/, and report.html at last, whole or not at
 * all. FM_IO, FM_NO_MEMORY; FM_INVALID: a damaged picture or table. */
fm_status report_write(fm_report_outcome *outcome, const fm_report_desc *desc, fm_error *err);

#endif
