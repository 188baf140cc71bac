/* The table behind a chart: one row a case, those that were not measured with their reason. */
#ifndef FM_CASE_TABLE_H
#define FM_CASE_TABLE_H

#include "base/text.h"
#include "read/group.h"

void case_table_add(fm_text *page, const fm_group *group);

/* "53.2 MiB", "640 B". */
void case_table_bytes(char text[24], double bytes);

#endif
