/* The table behind a chart: one row a case, those that were not measured with their reason. */
#ifndef FM_CASE_TABLE_H
#define FM_CASE_TABLE_H

#include "base/text.h"
#include "tradeoff/standing.h"

/* Cases on the frontier of the group, by that error, and tied ones are marked; a column of messages
 * is there only where a case has one. */
void case_table_add(fm_text *page, const fm_group *group, const fm_error_kind *kind);

#endif
