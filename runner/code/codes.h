/* What the rows of a run were measured by. Rows share codes: a run has as many as there are
 * different ones. */
#ifndef FM_CODES_H
#define FM_CODES_H

#include "code.h"

typedef struct fm_row_code {
    uint32_t index;    /* in codes, plus 1; 0: no launch yet */
    bool lacks_code;   /* a launch was recorded without */
    uint32_t launches; /* that ended, or whose worker died */
    uint32_t forgets;  /* how often what was measured of the row is to be forgotten */
} fm_row_code;

/* Starts as {0}. */
typedef struct fm_codes {
    fm_code *codes; /* [count], none twice; owned */
    size_t count;
    fm_row_code *rows; /* [row_count]; owned */
    size_t row_count;
} fm_codes;

fm_status codes_create(fm_codes *codes, size_t row_count, fm_error *err);
void codes_free(fm_codes *codes);

/* A launch of the row ended, or its worker died; NULL: it was recorded without a code. What it read
 * beyond what is known of the row is added to that. FM_NO_MEMORY. */
fm_status codes_add(fm_codes *codes, size_t row, const fm_code *code, fm_error *err);
void codes_forget(fm_codes *codes, size_t row);
/* Borrowed until the next codes_add; NULL: nothing is known of the row. */
const fm_code *codes_of(const fm_codes *codes, size_t row);

#endif
