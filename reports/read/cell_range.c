#include "cell_range.h"

fm_status table_in_range(double *value, fm_metric_range range, const fm_table *table, size_t row,
                         size_t column, fm_error *err)
{
    const fm_status status = table_number(value, table, row, column, err);
    const char *text = table_cell(table, row, column);
    if (status != FM_OK || text[0] == '\0' || metric_in_range(range, *value))
        return status;
    return fm_fail(err, FM_INVALID, "%s:%u: %s: \"%.80s\": %s is expected", table->path,
                   table->lines[row], table->names[column], text, fm_ranges[range].words);
}
