/* Claims: quantified sentences of a paper as data, in the `claims` of a figure's file.
 *
 *   claims:
 *     - id: KP-3                      unique; parts of one sentence are KP-3a, KP-3b, ...
 *       text: Heap overtakes Array between k = 16 and 32
 *       source: Fig. 5                where the paper says so
 *       where: any                    or gpu: rows of software devices do not count; or hazards:
 *                                     on a software device only rows of feed compute-adjacent do;
 *                                     or software: only its rows do, for there fragments come one
 *                                     after the other
 *       why: ...                      why the other devices cannot say
 *       basis: stated                 what it rests on: a sentence of the paper; plot: read off a
 *                                     plot, of which no sentence speaks; ours: our question or
 *                                     bound. Of a model's numbers: predicted; tuned: a parameter
 *                                     was chosen so; calibrated: inputs were made so. Verdicts are
 *                                     counted apart by it
 *       required: true                if it fails, the exit code is 1
 *       paper: 24                     the paper's value, a number or a sentence
 *       plot: 8.9                     what the paper's own plot has, where that differs
 *       form: crossing                how points are judged; below
 *       of: { method: kplus-heap, metric: frame_ms }
 *       over: { method: kplus-array }
 *       along: k
 *       between: [16, 32]
 *
 * A selection (`of`, `minus`, `over`) says which rows and which number of each:
 *   metric   column of summary.csv or metric of samples.csv; a list is summed. Default frame_ms
 *   take     each (default), least or greatest: of the rows that differ in method and options only
 *            (of `minus` and `over` there is one: the greatest if so, else the least)
 *   formula  { constant, per_pixel, per_pixel_k, per_pixel_n, per_fragment }: no row, but bytes
 *            worked out for the row of `of`
 *   table    summary (default) or memory: memory.csv, with its columns
 *   others   tests on an option, else on a column of that name: a value ("": empty, or no such
 *            option), a list of values, or ">= 16", "< 16", "not 16"
 *
 * `minus`, `over` and `over_minus` take over from `of` what they do not name, and each row of `of`
 * is paired with the row of the same workload; columns that they name themselves may differ. A
 * point is (of - minus) / (over - over_minus), with an interval. Only rows of the figure's own
 * cases count.
 *
 * Forms, and what they need (bounds: at_least, at_most, equals; tolerance, a share of the bound,
 * widens each of them; the default is 0):
 *   bound     every point is within the bounds
 *   any       at least one point is
 *   mean      the arithmetic mean of all points is
 *   order     of: a list of selections; at each workload each is not above the next, but by the
 *             tolerance
 *   monotone  along, goes (rises or falls): no step goes back by more than the tolerance, and the
 *             last point lies beyond the first
 *   crossing  along, between, level (1), goes (falls): where the points cross the level
 *   peak      along, between, extreme (least or greatest): where the best point is
 *   slope     along, scale: log (the exponent of a power law; default) or linear (the slope times
 *             the middle of `along`, over the middle value): least squares, within the bounds
 *   spread    greatest over least point, within the bounds
 *   images    of, over: the greatest difference of the two images' pixels, within the bounds
 * With several seeds a point is their mean, and its interval has the spread between them; but each
 * seed is a point of its own where `equals` stands without a tolerance, or the claim is required.
 * Points that differ in more than `along` (and `across`, columns that change with it) are judged
 * apart; the worst of them decides.
 *
 * A verdict is `holds` or `fails` only if the whole 95 % interval agrees, else `unclear`; `not
 * testable here` when there is no point. Where rows gave no result, a curve had too few points, or
 * a method that the claim lists was not run, it `holds for 3 of 10 points`; what fails, fails. Of
 * form any it is the other way round: one point is enough to hold, and not all failing is unclear.
 * Where each point lacks a seed or a method to compare with, it is unclear.
 * On a scene that no block of the figure's `run` and `large` has (--smoke and --scene put it there)
 * it `holds on another scene`; if it fails, the points of the figure's own scenes decide alone, and
 * where there are none it is `not testable here`, unless it is required.
 *
 * Intervals are by launches (base/stats.h). A time, or a ratio or rate of times, has none if there
 * was one launch, and a claim that hangs on it is unclear. Bytes, counts, errors and modelled
 * numbers are exact, and need one launch only; which numbers are times says `is_timed` in
 * model/metrics.c. */
#ifndef FM_CLAIM_H
#define FM_CLAIM_H

#include <stdbool.h>
#include <stddef.h>

#include "base/yaml_fields.h"

enum { FM_CLAIM_TESTS = 16, FM_CLAIM_SELECTIONS = 12, FM_CLAIMS = 64 };

typedef enum fm_claim_form {
    FM_CLAIM_BOUND,
    FM_CLAIM_ANY,
    FM_CLAIM_MEAN,
    FM_CLAIM_ORDER,
    FM_CLAIM_MONOTONE,
    FM_CLAIM_CROSSING,
    FM_CLAIM_PEAK,
    FM_CLAIM_SLOPE,
    FM_CLAIM_SPREAD,
    FM_CLAIM_IMAGES,
    FM_CLAIM_FORM_COUNT
} fm_claim_form;

typedef enum fm_claim_where {
    FM_CLAIM_ANY_DEVICE,
    FM_CLAIM_GPU,
    FM_CLAIM_HAZARDS,
    FM_CLAIM_SOFTWARE
} fm_claim_where;
typedef enum fm_claim_basis {
    FM_BASIS_STATED,
    FM_BASIS_PLOT,
    FM_BASIS_OURS,
    FM_BASIS_PREDICTED,
    FM_BASIS_TUNED,
    FM_BASIS_CALIBRATED,
    FM_BASIS_COUNT
} fm_claim_basis;

typedef enum fm_claim_take { FM_TAKE_EACH, FM_TAKE_LEAST, FM_TAKE_GREATEST } fm_claim_take;
typedef enum fm_claim_table { FM_SELECT_SUMMARY, FM_SELECT_MEMORY } fm_claim_table;

typedef struct fm_claim_test {
    const char *key;
    const fm_yaml *value;
} fm_claim_test;

enum { FM_FORMULA_TERMS = 5 };

typedef struct fm_claim_selection {
    fm_claim_test tests[FM_CLAIM_TESTS];
    size_t test_count;
    fm_text_list own_columns; /* keys of the tests that are not taken over from `of` */
    fm_text_list metrics;     /* summed */
    fm_claim_take take;
    fm_claim_table table;
    bool is_formula;
    double formula[FM_FORMULA_TERMS]; /* constant, per pixel, pixel k, pixel n, fragment */
} fm_claim_selection;

typedef struct fm_claim {
    const char *id, *text, *source, *why, *paper, *plot;
    fm_claim_where where;
    fm_claim_basis basis;
    bool is_required;
    fm_claim_form form;
    fm_claim_selection of[FM_CLAIM_SELECTIONS]; /* one, but for `order` */
    size_t of_count;
    fm_claim_selection minus, over, over_minus;
    bool has_minus, has_over, has_over_minus;
    const char *along;           /* "": none */
    fm_text_list free_columns;   /* in which points of a curve differ: `across`, and along */
    double low, high, tolerance; /* bounds before tolerance; infinite: none */
    double level, between[2];
    bool rises, is_linear, wants_greatest;
} fm_claim;

/* "stated", as in figure files. */
const char *claim_basis_name(fm_claim_basis basis);

/* Reads the list `claims` of a figure's file; NULL: there are none. Texts point into the tree. The
 * caller frees the claims. FM_NO_MEMORY; FM_INVALID: naming file and line. */
fm_status claims_read(fm_claim **claims, size_t *count, const fm_yaml *list,
                      const fm_yaml_place *at);
void claims_free(fm_claim *claims, size_t count);

#endif
