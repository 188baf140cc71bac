/* Kinds `stacked-bars` and `grouped-bars`: a cluster of bars for each x, and one for the cases that
 * do not use it. */
#ifndef FM_FIGURE_BARS_H
#define FM_FIGURE_BARS_H

#include "figure_values.h"

/* FM_UNSUPPORTED: nothing to draw; FM_NO_MEMORY. */
fm_status figure_make_bars(fm_figure_job *job, fm_error *err);

#endif
