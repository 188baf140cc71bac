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

/* One launch of a case. */
typedef struct fm_launch_numbers {
    uint32_t launch;
    double value, over; /* medians of its frames; NAN: it has none */
} fm_launch_numbers;

typedef struct fm_launch_list {
    fm_launch_numbers *items; /* [count]; owned */
    size_t count;
} fm_launch_list;

/* Of all launches that have the metric, by number. FM_NO_MEMORY. The caller frees
 * the items, which are NULL on failure. */
fm_status launches_numbers(fm_launch_list *list, const fm_result_files *results,
                           const fm_case_row *row, const char *metric, const char *over,
                           fm_error *err);

#endif
