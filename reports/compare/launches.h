/* A number over that of the floor, which each launch measures beside its case. */
#ifndef FM_COMPARE_LAUNCHES_H
#define FM_COMPARE_LAUNCHES_H

#include "base/stats.h"
#include "read/result_files.h"

/* The median, with its interval by launches, of one metric over another of the same launch: the
 * median of its frames over that of the other's frames. A machine that is slow for a while is so
 * for both. All NAN: no launch has both, or no memory. */
fm_interval launches_ratio(const fm_result_files *results, const fm_case_row *row,
                           const char *metric, const char *over);

#endif
