/* Kind `lines`: a curve for each method, ours and the paper's. */
#ifndef FM_FIGURE_LINES_H
#define FM_FIGURE_LINES_H

#include "figure_values.h"

/* FM_UNSUPPORTED: nothing to draw; FM_NO_MEMORY. reference: the same of another machine, drawn
 * thin; its group is NULL where there is none. */
fm_status figure_make_lines(fm_figure_job *job, const fm_figure_job *reference, fm_error *err);

#endif
