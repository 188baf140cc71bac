/* Two runs compared, as a page of its own. */
#ifndef FM_COMPARISON_PAGE_H
#define FM_COMPARISON_PAGE_H

#include "compare/comparison.h"

/* Writes one file that opens from disk: summary, what differs between the runs, a dumbbell chart,
 * and a table of all cases. FM_IO, FM_NO_MEMORY; FM_INVALID: a chart that cannot be drawn. What was
 * at the path stays on failure. */
fm_status comparison_page_write(const char *path, const fm_comparison *comparison, fm_error *err);

#endif
