/* What the same code gives every time: status, memory, fragments, errors. No interval is needed. */
#ifndef FM_COMPARE_EXACT_H
#define FM_COMPARE_EXACT_H

#include "join.h"

enum { FM_CHANGE_TEXT_BYTES = 64 };

/* One column that differs; longer texts are cut. */
typedef struct fm_change {
    const char *name;                                           /* of the column or metric */
    char base[FM_CHANGE_TEXT_BYTES], now[FM_CHANGE_TEXT_BYTES]; /* "": empty there */
} fm_change;

typedef struct fm_changes {
    fm_change *items; /* [count]; owned */
    size_t count, capacity;
} fm_changes;

/* Of a case that both runs have: status, method_version, options; and of cases that were measured
 * in both each number that is no measurement (model/metrics.h): bytes, counts of fragments, the
 * truth's digest, modelled cycles and energy, and errors, which differ if they do by more than
 * rounding (tradeoff/error_kind.h). Of methods that are racy, or whose frames differed from one
 * another in BASE already, only memory and the scene are compared: their fragments and errors need
 * not repeat. If frames of another method differ in one run alone, that is a change: of
 * distinct_images, and frames_rmse_max. A number that one file has no column for is not compared; a
 * cell that is empty in one file alone is a change. FM_NO_MEMORY. The caller frees. */
fm_status exact_compare(fm_changes *changes, const fm_pair *pair, const fm_result_files *base,
                        const fm_result_files *now, fm_error *err);
/* Adds that the picture is another, told by its hash (images.h; "": not known). Pictures of two
 * drivers may round otherwise, and are not compared so; nor are those of methods that need not
 * repeat. FM_NO_MEMORY. */
fm_status exact_add_image(fm_changes *changes, const fm_pair *pair, const char *base,
                          const char *now, fm_error *err);
/* Whether a change is for the worse (below 0: another status of more harm, more bytes, more errors)
 * or for the better (above 0). 0: nobody can say: the picture, options, counts of fragments. */
int exact_order(const fm_change *change);

/* What the changes of a case come to, the worst first. */
typedef enum fm_exact_verdict {
    FM_EXACT_WORSE,   /* one of them is for the worse */
    FM_EXACT_DIFFERS, /* none is */
    FM_EXACT_EQUAL,   /* there are none */
    FM_EXACT_COUNT
} fm_exact_verdict;
fm_exact_verdict exact_verdict(const fm_changes *changes);
const char *exact_verdict_name(fm_exact_verdict verdict); /* "worse" */
void exact_free(fm_changes *changes);

/* Which of the four hashes of code differ: "program driver plugin shaders", or a part of it; "":
 * none of those that both have. */
enum { FM_CODE_TEXT_BYTES = 40 };
void exact_code(char differing[FM_CODE_TEXT_BYTES], const fm_pair *pair);

#endif
