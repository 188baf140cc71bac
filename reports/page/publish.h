/* The files of a report, put in place together once all of them are there: a report that fails
 * leaves the one before it as it was. */
#ifndef FM_PUBLISH_H
#define FM_PUBLISH_H

#include "base/text.h"
#include "claims/verdicts.h"

/* Where charts wait until they are put in place, in a folder of results. */
#define FM_PUBLISH_CHARTS "charts.partial"

/* What the page says in its first lines: how much its results lacked. */
#define FM_PUBLISH_MARK "<meta name=fragmark-missing content="

typedef struct fm_publish_desc {
    const char *directory;
    const fm_text *page;              /* of report.html */
    const fm_claim_results *verdicts; /* of claims.csv; NULL: it is left alone; none: it goes */
    const fm_text *tradeoff;          /* of tradeoff.csv; NULL: it is left alone */
    const fm_text *stability;         /* of stability.csv; NULL: it is left alone */
} fm_publish_desc;

/* Makes an empty DIRECTORY/charts.partial. FM_INVALID: DIRECTORY/report.html was made of results
 * that lacked less than `missing_count` things: it stays. FM_IO. */
fm_status publish_begin(const char *directory, size_t missing_count, fm_error *err);
/* Writes the page and the claims beside the old ones, then moves charts, claims and, at last, the
 * page into their places; charts of before that are none of the new go. FM_IO, FM_NO_MEMORY: while
 * it writes, nothing is replaced. */
fm_status publish_end(const fm_publish_desc *desc, fm_error *err);
/* Removes what publish_begin made; after a failure. */
void publish_drop(const char *directory);

#endif
