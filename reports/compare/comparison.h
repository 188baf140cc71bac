/* Two runs compared, case by case.
 *
 * The room reports/compare joins two folders of results (join.h), says where they were made and
 * what else differs (machines.h), compares a time or a ratio of times with its interval
 * (quantity.h), and what needs none (exact.h). comparison_lines, comparison_csv and comparison_json
 * write it down. It advises: a verdict is about one case alone, at 95 %, so that of a hundred equal
 * cases up to five may come out as faster or slower. */
#ifndef FM_COMPARISON_H
#define FM_COMPARISON_H

#include "exact.h"
#include "images.h"
#include "quantity.h"

/* In rising order of merit. */
typedef enum fm_compared_verdict {
    FM_COMPARED_SLOWER,  /* the interval lies above 1, the ratio above the band */
    FM_COMPARED_UNCLEAR, /* the interval allows more than one of the others, or there is none, or a
                            row is noisy. Two launches have a very wide one, which counts */
    FM_COMPARED_SAME,    /* the whole interval lies in the band */
    FM_COMPARED_FASTER,  /* the interval lies below 1, the ratio below the band */
    FM_COMPARED_UNTIMED, /* no time in one of them or both: see their status */
    FM_COMPARED_COUNT
} fm_compared_verdict;

const char *compared_verdict_name(fm_compared_verdict verdict); /* "slower" */

/* One case in both runs. */
typedef struct fm_compared {
    fm_pair pair;
    fm_interval base, now; /* of the quantity; NAN: none */
    fm_interval ratio;     /* now over base (read/interval.h) */
    fm_compared_verdict verdict;
    const char *why;               /* unclear, untimed: the reason; else "" */
    fm_changes changes;            /* of what is exact; none: equal */
    char code[FM_CODE_TEXT_BYTES]; /* which hashes differ */
} fm_compared;

typedef struct fm_comparison_desc {
    const fm_result_files *base, *now; /* borrowed; they outlive the comparison */
    fm_quantity_desc quantity;
    double band; /* share of a time that does not count: 0.02; 0: any counts */
} fm_comparison_desc;

typedef struct fm_comparison {
    const fm_result_files *base_run, *now_run;
    fm_images base_images, now_images;
    fm_machines machines;
    fm_quantity quantity;
    double band;
    fm_compared *cases; /* [count], the worst first: another status, slower, another exact number,
                           unclear, same, faster; in each the largest ratio first; owned */
    size_t count;
    fm_pairs pairs;             /* all of them; base or now is NULL where it is in one run alone */
    size_t only_base, only_now; /* how many of those */
} fm_comparison;

/* FM_INVALID: a metric or reference that is not there; FM_UNSUPPORTED: not comparable: milliseconds
 * of two machines, or no case in both; FM_IO: a journal cannot be read; FM_NO_MEMORY. The caller
 * frees, after a failure too. */
fm_status comparison_make(fm_comparison *comparison, const fm_comparison_desc *desc, fm_error *err);
void comparison_free(fm_comparison *comparison);

size_t comparison_verdicts(const fm_comparison *comparison, fm_compared_verdict verdict);
/* Cases in which something that is exact differs. */
size_t comparison_changed(const fm_comparison *comparison);

/* "K+B-Array, k 8, n 128, layers, vulkan, raster, 854 x 480": what a reader calls a case. */
enum { FM_COMPARED_NAME_BYTES = 320 };
void compared_name(char name[FM_COMPARED_NAME_BYTES], const fm_case_row *row);
/* Adds "bytes_allocated 8 -> 12; status ok -> crash"; nothing: equal. */
void compared_add_changes(fm_text *text, const fm_compared *compared);

/* What is printed: what differs between the runs, a line a case, cases in one run alone, a summary.
 */
void comparison_add_lines(fm_text *text, const fm_comparison *comparison);
/* The last of these lines alone, without its end. */
void comparison_add_summary(fm_text *text, const fm_comparison *comparison);
/* A row a case, also of those in one run alone; reports/README.md has the columns. */
void comparison_add_csv(fm_text *csv, const fm_comparison *comparison);
/* The same as JSON, with what differs between the runs. FM_NO_MEMORY. */
fm_status comparison_add_json(fm_text *json, const fm_comparison *comparison, fm_error *err);

/* Both without times: what is exact, with verdicts of it alone (exact_verdict). */
void comparison_add_exact_csv(fm_text *csv, const fm_comparison *comparison);
fm_status comparison_add_exact_json(fm_text *json, const fm_comparison *comparison, fm_error *err);
/* How many cases have this one. */
size_t comparison_exact(const fm_comparison *comparison, fm_exact_verdict verdict);

#endif
