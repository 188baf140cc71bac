/* All claims of a report's figures, judged: claims.csv.
 *
 * The room reports/claims judges what papers claim (read/claim.h is the manual of claims) by the
 * cases of a run. A claim's selections mean rows (match.h); rows become points, values with
 * intervals (points.h, made by summary_points and memory_points); the claim's form judges the
 * points (forms.h, curves.h), and the worst of them decides (judging.h). The only files that are
 * touched here are kept pictures, which are read, and claims.csv, which is written. Nothing here
 * reads YAML or draws. */
#ifndef FM_CLAIM_VERDICTS_H
#define FM_CLAIM_VERDICTS_H

#include "forms.h"
#include "read/paper_figure.h"

/* One row of claims.csv. */
typedef struct fm_claim_result {
    const fm_paper_figure *figure; /* borrowed */
    const fm_claim *claim;         /* of the figure */
    char device[160];              /* whose rows decided: its name, or "by formula" */
    bool is_reference;             /* of the other machine, which its device then says */
    fm_verdict verdict;
} fm_claim_result;

typedef struct fm_claim_results {
    fm_claim_result *items; /* figure by figure, claim by claim; owned */
    size_t count;
} fm_claim_results;

typedef struct fm_verdicts_desc {
    const fm_result_files *results;
    const fm_result_files *reference;      /* of another machine; NULL: none */
    const fm_paper_figure *const *figures; /* [figure_count] */
    size_t figure_count;
} fm_verdicts_desc;

/* A row for each claim and device of the results. A claim that none of them can test gets its
 * verdict from the reference's devices; others get the reference's beside their own. The verdicts
 * borrow the figures. FM_NO_MEMORY; FM_IO, FM_INVALID: a damaged picture or table. On failure there
 * are none. The caller frees them. */
fm_status verdicts_make(fm_claim_results *verdicts, const fm_verdicts_desc *desc, fm_error *err);
void verdicts_free(fm_claim_results *verdicts);

/* Writes claims.csv, whole or not at all. FM_IO, FM_NO_MEMORY. Its columns:
 * claim,paper,figure,text,device,measured,low,high,paper_value,verdict,reason,basis */
fm_status verdicts_write(const fm_claim_results *verdicts, const char *path, fm_error *err);

/* Verdicts by what their claims rest on, and by kind, those of the reference included. */
typedef struct fm_verdict_counts {
    size_t counts[FM_BASIS_COUNT][FM_VERDICT_COUNT];
} fm_verdict_counts;

/* paper: of its figures alone; NULL: of all. */
fm_verdict_counts verdicts_count(const fm_claim_results *verdicts, const char *paper);
/* Whether any verdict is of that basis. */
bool verdict_counts_has(const fm_verdict_counts *counts, fm_claim_basis basis);

/* How many required claims fail on the results' own devices. */
size_t verdicts_required_failed(const fm_claim_results *verdicts);

/* "25; its own plot: 8.9" */
void claim_paper_value(char text[256], const fm_claim *claim);

#endif
