/* What is drawn, where and how: all that a method is measured on. */
#ifndef FM_WORKLOAD_H
#define FM_WORKLOAD_H

#include "base/text.h"
#include "result_files.h"

/* Same scene, size, fragments, device and feed, but for the free columns (NULL: none). An empty k
 * or n agrees with any; where n = r k, n is free with k. */
bool workload_same(const fm_case_row *a, const fm_case_row *b, const fm_text_list *free_columns);
/* The same, whatever their seeds are. */
bool workload_same_of_any_seed(const fm_case_row *a, const fm_case_row *b,
                               const fm_text_list *free_columns);

enum { WORKLOAD_KEY_BYTES = 1024 };
/* Cases of different keys are not of the same workload; those of one key may be. What does not fit
 * is left out. */
void workload_key(char key[WORKLOAD_KEY_BYTES], const fm_case_row *result,
                  const fm_text_list *free_columns);

/* ", n 128, k 8": of the case, the columns in which the cases differ that takes[results->count]
 * marks; NULL: nothing. What does not fit is left out. */
void workload_name(char *name, size_t room, const fm_result_files *results, const bool *takes,
                   const fm_case_row *result);

#endif
