/* The table behind a chart: one row a case, those that were not measured with their reason. */
#ifndef FM_CASE_TABLE_H
#define FM_CASE_TABLE_H

#include "base/text.h"
#include "read/group.h"

/* Cases on the Pareto frontier of the group are marked; a column of messages is there only where a
 * case has one. */
void case_table_add(fm_text *page, const fm_group *group);

#endif
