/* A history as a page of its own: a line a case, with what it did in the last nights. */
#ifndef FM_HISTORY_PAGE_H
#define FM_HISTORY_PAGE_H

#include "history/runs.h"
#include "history/series.h"

typedef struct fm_history_page_desc {
    const fm_series_list *series; /* in the order of the page */
    const fm_run_list *runs;
    const char *reference; /* a method; NULL: floor */
} fm_history_page_desc;

/* Writes one file that opens from disk: machines, a table of all series with sparklines in which
 * steps are marked, and the runs. FM_IO, FM_NO_MEMORY; what was at the path stays on failure. */
fm_status history_page_write(const char *path, const fm_history_page_desc *desc, fm_error *err);

#endif
