/* Which case of one run is which of the other. */
#ifndef FM_COMPARE_JOIN_H
#define FM_COMPARE_JOIN_H

#include "read/result_files.h"

/* One case in both runs, or in one alone. Rows are borrowed. */
typedef struct fm_pair {
    const fm_case_row *base, *now; /* NULL: not there */
    bool is_by_name;               /* their ids differ */
} fm_pair;

typedef struct fm_pairs {
    fm_pair *items; /* base's cases in their order, then those of `now` alone; owned */
    size_t count;
} fm_pairs;

/* Joins by id. What is left is joined by what names a case: method, scene, device as it was asked
 * for, feed, all keys, and options that are not the method's defaults in its own run; of these the
 * layout, which a device may have decided, always names it. So a case is found again when a new
 * version of its method, generator or driver, or another default, gave it another id. n counts
 * where both tell it: of meshes it is measured. Each case is in one pair. FM_NO_MEMORY. The caller
 * frees. */
fm_status join_cases(fm_pairs *pairs, const fm_result_files *base, const fm_result_files *now,
                     fm_error *err);
void join_free(fm_pairs *pairs);

/* Adds what names a case, but for n: of two cases of one name and, where both tell it, one n, the
 * same was asked. */
void join_add_name(fm_text *name, const fm_case_row *row);

#endif
