/* Which method is the cheapest for an error that one can bear. */
#ifndef FM_CHEAPEST_TABLE_H
#define FM_CHEAPEST_TABLE_H

#include "base/text.h"
#include "tradeoff/cheapest.h"

/* Nothing where no case of the group competes. */
void cheapest_table_add(fm_text *page, const fm_group *group, const fm_error_kind *kind);

#endif
