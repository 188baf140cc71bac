/* Kind `tornado`: how far each swept parameter moves a method's ratio, a block of bars a method. */
#ifndef FM_FIGURE_TORNADO_H
#define FM_FIGURE_TORNADO_H

#include "figure_values.h"

/* FM_UNSUPPORTED: nothing to draw; FM_NO_MEMORY. */
fm_status figure_make_tornado(fm_figure_job *job, fm_error *err);

#endif
