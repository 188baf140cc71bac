/* Each claim of the project's figures can hold and can fail: what it is judged by is set on all
 * cases of its figure, by shapes that its form tells apart, until it has done both. */
#include <dirent.h>

#include "claims/match.h"
#include "claims/values.h"
#include "flip_kit.h"
#include "model/figure_file.h"
#include "read/case_metrics.h"
#include "read/workload.h"

/* Numbers of what a claim's value is divided by, and of what is taken away: large, for counts are
 * whole. */
static const double divisor = 1e6, minuend = 1e5, less_divisor = 2e5, own = 4e6;

/* A claim on the cases of its figure. */
typedef struct flipping {
    flip_cases *of;
    const fm_claim *claim;
    fm_result_files *results; /* without numbers: which row is what */
    double *ranks;            /* [results->count]: place along the claim's axis, from 0 */
    size_t rank_count;
    bool has_held, has_failed;
} flipping;

/* How values go over the rows of `of`. */
typedef struct shape {
    double level, other;
    size_t turn;
} shape;

static bool matches(const flipping *at, const fm_claim_selection *selection, size_t row)
{
    const fm_claim_rows rows = { .results = at->results };
    return selection->table == FM_SELECT_SUMMARY && match_row(selection, &rows, row);
}

/* What a shape is at this row: the first selection that it belongs to, its rank. */
static double shaped(const flipping *at, const shape *is, size_t selection, size_t row)
{
    const double rank = at->ranks[row], span = (double)(at->rank_count + 1);
    const double x = at->claim->along[0] != '\0' && !isnan(rank) ? rank : 0.0;
    switch (at->claim->form) {
    case FM_CLAIM_BOUND:
    case FM_CLAIM_ANY:
    case FM_CLAIM_MEAN:
    case FM_CLAIM_IMAGES:
        return is->level;
    case FM_CLAIM_ORDER:
        return is->level + is->other * (double)selection;
    case FM_CLAIM_MONOTONE:
        return 1.0 + (is->other > 0.0 ? x : span - x);
    case FM_CLAIM_CROSSING:
        return at->claim->level * ((x < (double)is->turn) == (is->other > 0.0) ? 2.0 : 0.5);
    case FM_CLAIM_PEAK:
        return is->other > 0.0 ? 1.0 + fabs(x - (double)is->turn)
                               : 1.0 + span - fabs(x - (double)is->turn);
    case FM_CLAIM_SLOPE: {
        const double place = case_place(at->results, &at->results->cases[row], at->claim->along);
        return at->claim->is_linear ? 1.0 + is->level * x / span : pow(place, is->level);
    }
    case FM_CLAIM_SPREAD:
        return at->claim->along[0] == '\0' || x > 0.0 ? is->level : 1.0;
    case FM_CLAIM_FORM_COUNT:
        break;
    }
    return NAN;
}

static double whole(const char *metric, double value)
{
    const fm_metric_info *info = metric_describe(metric);
    const bool is_whole = info != NULL && fm_ranges[info->range].is_whole;
    return is_whole ? floor(fmax(value, 0.0) + 0.5) : value;
}

/* The metrics of a selection come to `value`: what has a number already keeps it, the next takes
 * the rest. */
static void set_sum(flip_numbers *numbers, const fm_claim_selection *selection, size_t row,
                    double value)
{
    double rest = value;
    bool is_given = false;
    for (size_t i = 0; i < selection->metrics.count; i++) {
        const double had = *flip_number(numbers, selection->metrics.items[i], row);
        rest -= isnan(had) ? 0.0 : had;
    }
    for (size_t i = 0; i < selection->metrics.count; i++) {
        const char *metric = selection->metrics.items[i];
        double *number = flip_number(numbers, metric, row);
        if (!isnan(*number))
            continue;
        *number = is_given ? 0.0 : whole(metric, fmax(rest, 0.0));
        is_given = true;
    }
}

/* fps and the like are worked out from times and bytes. */
static void set_value(flip_numbers *numbers, const fm_claim_selection *selection, size_t row,
                      double value)
{
    const char *metric = selection->metrics.items[0];
    const bool is_fps = strcmp(metric, "fps") == 0, is_mib = strcmp(metric, "mib") == 0;
    const bool is_both = strcmp(metric, "fps_per_mib") == 0;
    if (!is_fps && !is_mib && !is_both) {
        set_sum(numbers, selection, row, value);
        return;
    }
    if ((is_fps || is_both) && isnan(*flip_number(numbers, "frame_ms", row)))
        *flip_number(numbers, "frame_ms", row) = 1e3 / fmax(value, 1e-3);
    double *bytes = flip_number(numbers, "bytes_allocated", row);
    if (isnan(*bytes))
        *bytes = is_mib ? value * 1048576.0 : 1048576.0;
}

static double divisor_of(const flipping *at, size_t row)
{
    if (!at->claim->has_over)
        return 1.0;
    if (at->claim->over.is_formula)
        return value_by_formula(&at->claim->over, &at->results->cases[row]).median;
    return divisor - (at->claim->has_over_minus ? less_divisor : 0.0);
}

/* What a case is given, not what is measured of it: axes of claims, and terms of formulas. */
static void set_inputs(flip_numbers *numbers, const fm_case_row *result, size_t row)
{
    static const char *const inputs[] = { "fragments_generated", "nonempty_pixels" };
    for (size_t i = 0; i < sizeof inputs / sizeof inputs[0]; i++) {
        double *number = flip_number(numbers, inputs[i], row);
        if (isnan(*number))
            *number = floor(1e3 * result->width_px *
                            (isnan(result->pixel_density) ? 1.0 : result->pixel_density));
    }
}

/* The row of `of` is what is divided by, too: the value is set by what is taken away. */
static bool is_own_divisor(const flipping *at, size_t row)
{
    const fm_claim *claim = at->claim;
    return claim->has_minus && claim->has_over && !claim->over.is_formula &&
           matches(at, &claim->over, row) && claim->over.metrics.count == 1 &&
           strcmp(claim->over.metrics.items[0], claim->of[0].metrics.items[0]) == 0;
}

/* Of a claim on differences of one row from others. */
static double minuend_of(const flipping *at, const shape *is)
{
    for (size_t i = 0; i < at->results->count; i++)
        if (matches(at, &at->claim->of[0], i) && is_own_divisor(at, i))
            return own -
                   shaped(at, is, 0, i) * (own - (at->claim->has_over_minus ? less_divisor : 0.0));
    return minuend;
}

static void set_numbers(flip_numbers *numbers, const flipping *at, const shape *is)
{
    const fm_claim *claim = at->claim;
    for (size_t row = 0; row < at->results->count; row++) {
        const fm_case_row *result = &at->results->cases[row];
        for (size_t s = 0; s < claim->of_count; s++)
            if (claim->form != FM_CLAIM_IMAGES && matches(at, &claim->of[s], row))
                set_value(numbers, &claim->of[s], row,
                          is_own_divisor(at, row) ? own
                                                  : shaped(at, is, s, row) * divisor_of(at, row) +
                                                        (claim->has_minus ? minuend : 0.0));
        if (claim->has_minus && matches(at, &claim->minus, row))
            set_value(numbers, &claim->minus, row, minuend_of(at, is));
        if (claim->has_over_minus && matches(at, &claim->over_minus, row))
            set_value(numbers, &claim->over_minus, row, less_divisor);
        if (claim->has_over && !claim->over.is_formula && matches(at, &claim->over, row))
            set_value(numbers, &claim->over, row, divisor);
        set_inputs(numbers, result, row);
    }
}

/* Two pictures that differ by `apart` everywhere. */
static void write_pictures(const flipping *at, double apart)
{
    for (size_t row = 0; row < at->results->count; row++) {
        char path[256];
        fm_image *image = NULL;
        assert_int_equal(image_create(&image, 16, 16, NULL), FM_OK);
        image->rgba[17] = matches(at, &at->claim->of[0], row) ? (float)apart : 0.0f;
        snprintf(path, sizeof path, "%s/images/%s.rgba32f", at->of->directory,
                 at->results->cases[row].id);
        assert_int_equal(image_write(path, image, NULL), FM_OK);
        image_destroy(image);
    }
}

/* The method is one that the claim's `of` means. */
static bool is_of(const fm_claim *claim, const char *method)
{
    bool is_meant = true;
    for (size_t t = 0; t < claim->of[0].test_count; t++) {
        const fm_yaml *value = claim->of[0].tests[t].value;
        if (strcmp(claim->of[0].tests[t].key, "method") != 0)
            continue;
        is_meant = value->kind == FM_YAML_SCALAR && strcmp(value->text, method) == 0;
        for (size_t i = 0; i < value->count; i++)
            is_meant |= strcmp(value->items[i].text, method) == 0;
    }
    return is_meant;
}

/* What a method takes in memory.csv. Where something is taken away and it is divided too, it is
 * divided by what it is taken from. */
static double memory_of(const fm_claim *claim, const char *method, double level)
{
    const bool is_meant = is_of(claim, method);
    if (claim->has_over && claim->has_minus)
        return is_meant ? own : own - level * own;
    if (claim->has_minus)
        return is_meant ? level + minuend : minuend;
    return is_meant ? level * (claim->has_over ? divisor : 1.0) : divisor;
}

/* memory.csv: a row for each row and column of the figure's table. */
static void write_memory(fm_text *csv, const flipping *at, const shape *is)
{
    const fm_yaml *table = at->of->figure->file.table;
    const fm_yaml *rows = yaml_tree_find(table, "rows"),
                  *columns = yaml_tree_find(table, "columns");
    text_add(csv, "figure,workload,method,title,bytes,mib,printed,difference_mib,verdict,why\n");
    for (size_t i = 0; i < rows->count; i++)
        for (size_t j = 0; j < columns->count; j++) {
            const char *method = yaml_tree_find(&rows->items[i], "method")->text;
            const double value = memory_of(at->claim, method, is->level);
            text_add(csv, "%s,\"%s\",%s,t,%.17g,%.17g,%.17g,,exact,\n", at->of->figure->id,
                     yaml_tree_find(&columns->items[j], "title")->text, method, value, value,
                     divisor);
        }
}

static void try_shape(flipping *at, const shape *is)
{
    flip_numbers numbers;
    fm_error err = { 0 };
    fm_result_files *results = NULL;
    fm_claim_results verdicts;
    fm_paper_figure alone = *at->of->figure;
    fm_text memory = { 0 };
    flip_numbers_open(&numbers, at->results->count);
    numbers.is_software = at->claim->where == FM_CLAIM_SOFTWARE;
    set_numbers(&numbers, at, is);
    if (alone.file.table != NULL)
        write_memory(&memory, at, is);
    flip_write(at->of, &numbers, memory.bytes);
    if (at->claim->form == FM_CLAIM_IMAGES)
        write_pictures(at, is->level);
    if (result_files_read(&results, at->of->directory, &err) != FM_OK)
        fail_msg("%s: %s", at->claim->id, err.message);
    alone.claims = (fm_claim *)(uintptr_t)at->claim;
    alone.claim_count = 1;
    const fm_paper_figure *const figures[] = { &alone };
    const fm_verdicts_desc desc = { results, NULL, figures, 1 };
    if (verdicts_make(&verdicts, &desc, &err) != FM_OK)
        fail_msg("%s: %s", at->claim->id, err.message);
    const fm_verdict *made = &verdicts.items[0].verdict;
    at->has_held |= made->kind == FM_VERDICT_HOLDS ||
                    (made->kind == FM_VERDICT_IN_PART && made->judged > 0 && !made->is_elsewhere);
    at->has_failed |= made->kind == FM_VERDICT_FAILS;
    verdicts_free(&verdicts);
    result_files_close(results);
    text_free(&memory);
    flip_numbers_close(&numbers);
}

/* Levels about the bounds; what else a shape has goes both ways. */
static void try_all(flipping *at)
{
    const double low = at->claim->low, high = at->claim->high;
    const double a = isinf(low) ? high - 1.0 : low, b = isinf(high) ? low + 1.0 : high;
    const double levels[] = { isinf(low) || isinf(high) ? (isinf(low) ? b : a) : (a + b) / 2.0,
                              2.0 * b + 1.0,
                              a / 2.0 - 0.1,
                              a - 1.0,
                              b + 2.0,
                              0.0,
                              1.0 };
    const bool has_levels = !isinf(low) || !isinf(high);
    const bool has_ways = at->claim->form == FM_CLAIM_ORDER ||
                          at->claim->form == FM_CLAIM_MONOTONE ||
                          at->claim->form == FM_CLAIM_CROSSING || at->claim->form == FM_CLAIM_PEAK;
    const size_t turns = at->claim->form == FM_CLAIM_CROSSING || at->claim->form == FM_CLAIM_PEAK
                             ? at->rank_count + 1
                             : 1;
    for (size_t i = 0; i < (has_levels ? sizeof levels / sizeof levels[0] : 1); i++)
        for (int way = 1; way >= (has_ways ? -1 : 1); way -= 2)
            for (size_t turn = 0; turn < turns && !(at->has_held && at->has_failed); turn++) {
                const shape is = { has_levels ? levels[i] : 1e3, (has_levels ? 1.0 : 10.0) * way,
                                   turn };
                try_shape(at, &is);
            }
}

/* Ranks of the values of the claim's axis among all rows. */
static void rank_rows(flipping *at)
{
    const size_t count = at->results->count;
    at->ranks = calloc(count + 1, sizeof *at->ranks);
    at->rank_count = 0;
    assert_non_null(at->ranks);
    for (size_t i = 0; i < count && at->claim->along[0] != '\0'; i++) {
        const double x = case_place(at->results, &at->results->cases[i], at->claim->along);
        for (size_t j = 0; j < count; j++) {
            const double y = case_place(at->results, &at->results->cases[j], at->claim->along);
            bool is_first = y < x;
            for (size_t k = 0; k < j && is_first; k++)
                is_first = case_place(at->results, &at->results->cases[k], at->claim->along) != y;
            at->ranks[i] += is_first;
        }
        at->ranks[i] = isnan(x) ? NAN : at->ranks[i];
        at->rank_count = isnan(x) || at->ranks[i] < (double)at->rank_count ? at->rank_count
                                                                           : (size_t)at->ranks[i];
    }
}

/* Returns whether the claim held once and failed once. */
static bool flips(flip_cases *of, const fm_claim *claim)
{
    flipping at = { .of = of, .claim = claim };
    flip_numbers none;
    fm_error err = { 0 };
    flip_numbers_open(&none, json_array_size(of->cases));
    flip_write(of, &none, NULL);
    if (result_files_read(&at.results, of->directory, &err) != FM_OK)
        fail_msg("%s", err.message);
    for (size_t i = 0; i < at.results->count; i++)
        set_inputs(&none, &at.results->cases[i], i);
    result_files_close(at.results);
    flip_write(of, &none, NULL);
    flip_numbers_close(&none);
    if (result_files_read(&at.results, of->directory, &err) != FM_OK)
        fail_msg("%s", err.message);
    rank_rows(&at);
    try_all(&at);
    result_files_close(at.results);
    free(at.ranks);
    return at.has_held && at.has_failed;
}

static void each_claim_can_hold_and_can_fail(void **state)
{
    size_t count = 0, stuck = 0;
    DIR *folder = opendir(FM_FIGURES_SOURCE_DIR);
    const struct dirent *entry;
    const char *only = getenv("FLIP_FIGURE");
    (void)state;
    assert_non_null(folder);
    while ((entry = readdir(folder)) != NULL) {
        char path[1024];
        flip_cases of;
        snprintf(path, sizeof path, FM_FIGURES_SOURCE_DIR "/%s", entry->d_name);
        if (entry->d_name[0] == '.' || (only != NULL && strstr(entry->d_name, only) == NULL) ||
            !flip_open(&of, path, FM_PROGRAM))
            continue;
        for (size_t i = 0; i < of.figure->claim_count; i++, count++)
            if (!flips(&of, &of.figure->claims[i])) {
                print_error("%s: claim %s does not hold, or not fail, whatever is measured\n",
                            of.figure->id, of.figure->claims[i].id);
                stuck++;
            }
        flip_close(&of);
    }
    closedir(folder);
    print_message("%zu claims\n", count);
    assert_true(only != NULL || count > 200);
    assert_int_equal(stuck, 0);
}

/* The first holds whatever is measured, the second is of no case, the third hangs on its numbers;
 * the fourth is compared with a method that the figure does not run. */
static void a_claim_that_cannot_fail_is_found(void **state)
{
    char directory[] = "/tmp/fragmark-flip-XXXXXX", path[96];
    flip_cases of;
    (void)state;
    assert_non_null(mkdtemp(directory));
    kit_write_file(
        directory, "f-1.yml",
        "id: f-1\npaper: f\ntitle: t\n"
        "run: { methods: [kplus-array, kb], scenes: [layers], n: 16, k: 8 }\nclaims:\n"
        "  - { id: F-1, text: t, at_most: 1, of: { method: kb }, over: { method: kb } }\n"
        "  - { id: F-2, text: t, at_most: 1, of: { method: kb, culling: occupancy } }\n"
        "  - { id: F-3, text: t, at_most: 1, of: { method: kb }, "
        "over: { method: kplus-array } }\n"
        "  - { id: F-4, text: t, at_most: 1, of: { method: kb }, "
        "over: { method: [kplus-array, exact], take: least } }\n");
    snprintf(path, sizeof path, "%s/f-1.yml", directory);
    assert_true(flip_open(&of, path, FM_PROGRAM));
    assert_false(flips(&of, &of.figure->claims[0]));
    assert_false(flips(&of, &of.figure->claims[1]));
    assert_true(flips(&of, &of.figure->claims[2]));
    assert_false(flips(&of, &of.figure->claims[3]));
    flip_close(&of);
    kit_remove_directory(directory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_claim_that_cannot_fail_is_found),
        cmocka_unit_test(each_claim_can_hold_and_can_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
