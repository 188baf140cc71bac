/* A figure's table of memory: the methods' own formulas beside what its paper prints. */
#ifndef FM_MEMORY_ROWS_H
#define FM_MEMORY_ROWS_H

#include "base/table.h"
#include "base/text.h"

/* The rows of memory.csv that belong to the figure; nothing where it has none, or memory is NULL.
 */
void memory_rows_add(fm_text *page, const fm_table *memory, const char *figure);

#endif
