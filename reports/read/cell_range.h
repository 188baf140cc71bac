/* Numbers of a table that a metric's range holds. */
#ifndef FM_CELL_RANGE_H
#define FM_CELL_RANGE_H

#include "base/table.h"
#include "model/metrics.h"

/* As table_number; FM_INVALID also for what is beyond the range. An empty cell is of every range.
 */
fm_status table_in_range(double *value, fm_metric_range range, const fm_table *table, size_t row,
                         size_t column, fm_error *err);

#endif
