/* Two names of one method: claims that tell them apart are wrong. Their launches are drawn from
 * launches that were measured, and judged as any claims are. */
#include "claims_kit.h"

#include "base/csv.h"
#include "base/launch_noise.h"
#include "model/columns.h"

enum { PAIRS = 60, ROUNDS = 8, LAUNCHES_MOST = 10 };

/* What a row says; other columns are empty. */
typedef struct aa_row {
    const char *method;
    int k, launches;
    double scale; /* of its times */
    fm_interval frame_ms, times_floor;
} aa_row;

static double number_of(const aa_row *row, const fm_column *column)
{
    const fm_interval none = { NAN, NAN, NAN };
    const fm_interval *value = column->metric == FM_METRIC_FRAME_MS      ? &row->frame_ms
                               : column->metric == FM_METRIC_TIMES_FLOOR ? &row->times_floor
                                                                         : &none;
    if (column->metric == FM_METRIC_LAUNCHES)
        return row->launches;
    return column->kind == FM_COLUMN_LOW    ? value->low
           : column->kind == FM_COLUMN_HIGH ? value->high
                                            : value->median;
}

static void add_cell(fm_text *csv, const aa_row *row, const fm_column *column)
{
    const char *name = column_name(column);
    if (strcmp(name, "case_id") == 0)
        text_add(csv, "%s%d", row->method, row->k);
    else if (strcmp(name, "status") == 0)
        text_add(csv, "ok");
    else if (strcmp(name, "method") == 0)
        text_add(csv, "%s", row->method);
    else if (strcmp(name, "schema") == 0)
        text_add(csv, "1");
    else if (strcmp(name, "case_id") == 0)
        text_add(csv, "%s%d", row->method, row->k);
    else if (strcmp(name, "k") == 0)
        text_add(csv, "%d", row->k);
    else if (column->kind >= FM_COLUMN_METRIC)
        csv_add_real(csv, number_of(row, column));
}

static void add_row(fm_text *csv, const aa_row *row)
{
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++) {
        add_cell(csv, row, &fm_columns[i]);
        text_add(csv, i + 1 < FM_COLUMN_COUNT ? "," : "\n");
    }
}

/* What is drawn: pairs of names, of which the second takes `slower` times as long. */
typedef struct aa_run {
    const launch_noise *noise;
    int launches;
    const char *metric;
    double slower;
} aa_run;

/* Launches of one case, and of a floor that is as noisy. */
static void draw_row(aa_row *row, const aa_run *run, size_t index, uint64_t *state)
{
    const launch_noise *noise = run->noise;
    double times[LAUNCHES_MOST], ratios[LAUNCHES_MOST];
    for (int i = 0; i < row->launches; i++) {
        times[i] = row->scale * launch_noise_draw(noise, index, state);
        ratios[i] = times[i] / launch_noise_draw(noise, index, state);
    }
    row->frame_ms = stats_interval(times, (size_t)row->launches);
    row->times_floor = stats_interval(ratios, (size_t)row->launches);
}

static void write_results(const char *directory, const aa_run *run, uint64_t state)
{
    fm_text csv = { 0 };
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++)
        text_add(&csv, "%s%s", column_name(&fm_columns[i]), i + 1 < FM_COLUMN_COUNT ? "," : "\n");
    for (int k = 1; k <= PAIRS; k++)
        for (int name = 0; name < 2; name++) {
            aa_row row = { .method = name == 0 ? "a" : "b",
                           .k = k,
                           .launches = run->launches,
                           .scale = name == 0 ? 1.0 : run->slower };
            draw_row(&row, run, (size_t)k % NOISE_CASES, &state);
            add_row(&csv, &row);
        }
    kit_write_file(directory, "summary.csv", csv.bytes);
    kit_write_file(directory, "samples.csv",
                   "schema,run_id,case_id,launch,frame,metric,value,unit\n");
    kit_write_file(directory, "manifest.json", "{}");
    text_free(&csv);
}

/* A claim for each pair: one name takes no longer than the other. */
static void write_claims(const char *directory, const char *metric)
{
    fm_text figure = { 0 };
    text_add(&figure, "id: f-1\npaper: f\ntitle: t\ncharts:\n"
                      "  - { id: c, title: c, x: k, y: frame_ms }\nclaims:\n");
    for (int k = 1; k <= PAIRS; k++)
        text_add(&figure,
                 "  - { id: F-%d, text: t, at_most: 1, of: { method: a, k: %d, metric: %s }, "
                 "over: { method: b } }\n",
                 k, k, metric);
    kit_write_file(directory, "f-1.yml", figure.bytes);
    text_free(&figure);
}

/* How many claims on one draw of all pairs are decided. */
static size_t count_decided(const aa_run *run, uint64_t seed)
{
    char directory[64] = "/tmp/fragmark-aa-XXXXXX", path[96];
    fm_error err = { 0 };
    fm_result_files *results = NULL;
    fm_paper_figure *figure = NULL;
    fm_claim_results verdicts;
    assert_non_null(mkdtemp(directory));
    write_results(directory, run, seed);
    write_claims(directory, run->metric);
    snprintf(path, sizeof path, "%s/f-1.yml", directory);
    if (paper_figure_read(&figure, path, &err) != FM_OK ||
        result_files_read(&results, directory, &err) != FM_OK)
        fail_msg("%s", err.message);
    const fm_paper_figure *const figures[] = { figure };
    const fm_verdicts_desc desc = { results, NULL, figures, 1 };
    assert_int_equal(verdicts_make(&verdicts, &desc, &err), FM_OK);
    assert_int_equal(verdicts.count, PAIRS);
    const fm_verdict_counts counts = verdicts_count(&verdicts, NULL);
    const size_t open = counts.counts[FM_BASIS_STATED][FM_VERDICT_UNCLEAR];
    verdicts_free(&verdicts);
    paper_figure_close(figure);
    result_files_close(results);
    kit_remove_directory(directory);
    return PAIRS - open;
}

static double decided(const aa_run *run)
{
    size_t count = 0;
    for (uint64_t seed = 1; seed <= ROUNDS; seed++)
        count += count_decided(run, seed);
    return (double)count / (PAIRS * ROUNDS);
}

/* One in twenty is what 95 % intervals allow. Those of a ratio are wider than they must be with few
 * launches, and decide less often. */
static void two_names_of_one_method_are_told_apart_seldom(void **state)
{
    static const int launches[] = { 2, 3, 5, 10 };
    static const char *const metrics[] = { "frame_ms", "times_floor", "fps" };
    launch_noise noise;
    (void)state;
    launch_noise_read(&noise);
    for (size_t i = 0; i < sizeof launches / sizeof launches[0]; i++)
        for (size_t j = 0; j < sizeof metrics / sizeof metrics[0]; j++) {
            const double share = decided(&(aa_run){ &noise, launches[i], metrics[j], 1.0 });
            print_message("%d launches, %s: %.1f %% decided\n", launches[i], metrics[j],
                          100.0 * share);
            assert_true(share <= 0.07);
        }
}

static void one_launch_tells_nothing_apart(void **state)
{
    launch_noise noise;
    (void)state;
    launch_noise_read(&noise);
    assert_true(decided(&(aa_run){ &noise, 1, "frame_ms", 1.0 }) == 0.0);
    assert_true(decided(&(aa_run){ &noise, 1, "times_floor", 1.0 }) == 0.0);
}

/* A judge that never decides would pass the tests above. */
static void a_method_that_takes_ten_times_as_long_is_told(void **state)
{
    launch_noise noise;
    (void)state;
    launch_noise_read(&noise);
    assert_true(decided(&(aa_run){ &noise, 3, "frame_ms", 10.0 }) >= 0.95);
    assert_true(decided(&(aa_run){ &noise, 5, "frame_ms", 10.0 }) >= 0.95);
    assert_true(decided(&(aa_run){ &noise, 10, "frame_ms", 3.0 }) >= 0.95);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_names_of_one_method_are_told_apart_seldom),
        cmocka_unit_test(one_launch_tells_nothing_apart),
        cmocka_unit_test(a_method_that_takes_ten_times_as_long_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
