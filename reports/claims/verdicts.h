/* All claims of a report's figures, judged: claims.csv. */
#ifndef FM_CLAIM_VERDICTS_H
#define FM_CLAIM_VERDICTS_H

#include "forms.h"
#include "read/paper_figure.h"

typedef struct fm_claim_result {
    const fm_paper_figure *figure;
    const fm_claim *claim;
    char device[160]; /* whose rows decided */
    bool is_reference;
    fm_verdict verdict;
} fm_claim_result;

typedef struct fm_claim_results {
    fm_claim_result *items; /* figure by figure, claim by claim; owned */
    size_t count;
} fm_claim_results;

typedef struct fm_verdicts_desc {
    const fm_result_files *results;
    const fm_result_files *reference; /* of another machine; NULL: none */
    const fm_paper_figure *const *figures;
    size_t figure_count;
} fm_verdicts_desc;

/* A row for each claim and device of the results. A claim that none of them can test gets its
 * verdict from the reference's devices; others get the reference's beside their own. Borrows
 * figures. FM_NO_MEMORY, FM_IO; FM_INVALID: a damaged picture or table. The caller frees. */
fm_status verdicts_make(fm_claim_results *verdicts, const fm_verdicts_desc *desc, fm_error *err);
void verdicts_free(fm_claim_results *verdicts);

/* claim,paper,figure,text,device,measured,low,high,paper_value,verdict,reason. FM_IO, FM_NO_MEMORY
 */
fm_status verdicts_write(const fm_claim_results *verdicts, const char *path, fm_error *err);

size_t verdicts_count(const fm_claim_results *verdicts, fm_verdict_kind kind);

/* How many required claims fail on the results' own devices. */
size_t verdicts_required_failed(const fm_claim_results *verdicts);

/* "25; its own plot: 8.9" */
void claim_paper_value(char text[256], const fm_claim *claim);

#endif
