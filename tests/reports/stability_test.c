/* Stability: which errors a trait allows, where and in which size; matrices; the table. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "stability/matrix.h"
#include "stability/stability_csv.h"

enum { WANTED = 100, TIES = 7, AT_ONE = 3 };

typedef struct fake {
    const char *feed;
    bool is_software;
    const char *order;
    uint32_t traits;
    double missing, extra, misordered, lost, lost_ties, lost_at_one, self_beyond, images, tied;
    double missing_max, sets, worst_frame, off_truth; /* of all captured or timed frames */
    const char *options;
    bool is_unknown, is_wrong_image;
    uint32_t wrong, reasons, unexplained; /* what is expected */
} fake;

/* A scene that has TIES and AT_ONE, if the traits say that these are lost. */
static fm_case_row row_of(const fake *one)
{
    fm_case_row row = { .id = "a",
                        .status = "ok",
                        .outcome = FM_CASE_OK,
                        .reason = "",
                        .message = "",
                        .method = "m",
                        .device = "vulkan",
                        .device_name = "a GPU",
                        .feed = one->feed,
                        .scene = "s",
                        .order = one->order,
                        .options = one->options != NULL ? one->options : "",
                        .look = { .title = "M", .traits = one->traits },
                        .is_ok = true,
                        .is_measured = true,
                        .is_software = one->is_software || one->is_unknown,
                        .is_device_known = !one->is_unknown };
    if (one->is_wrong_image)
        row.outcome = FM_CASE_WRONG_IMAGE;
    for (int i = 0; i < FM_METRIC_COUNT; i++)
        row.metric[i] = NAN;
    row.metric[FM_METRIC_N] = 12;
    row.metric[FM_METRIC_FRAGMENTS_WANTED] = WANTED;
    row.metric[FM_METRIC_DECLARED_TIES] =
        (one->traits & (FM_TRAIT_LOSES_TIES | FM_TRAIT_PASSES_LOSE_TIES)) != 0 ? TIES : 0;
    row.metric[FM_METRIC_DECLARED_AT_ONE] =
        (one->traits & FM_TRAIT_LOSES_DEPTH_ONE) != 0 ? AT_ONE : 0;
    row.metric[FM_METRIC_MISSING] = one->missing;
    row.metric[FM_METRIC_EXTRA] = one->extra;
    row.metric[FM_METRIC_MISORDERED] = one->misordered;
    row.metric[FM_METRIC_FRAGMENTS_LOST] = one->lost;
    row.metric[FM_METRIC_LOST_TIES] = one->lost_ties;
    row.metric[FM_METRIC_LOST_AT_ONE] = one->lost_at_one;
    row.metric[FM_METRIC_SELF_MAX_ABS] = row.metric[FM_METRIC_SELF_BEYOND] = one->self_beyond;
    row.metric[FM_METRIC_DISTINCT_IMAGES] = one->images > 0 ? one->images : 1;
    row.metric[FM_METRIC_TIED_PIXELS] = one->tied;
    row.metric[FM_METRIC_RMSE] = 0;
    row.metric[FM_METRIC_MAX_ABS] = one->off_truth;
    row.metric[FM_METRIC_MISSING_MAX] = one->missing_max;
    row.metric[FM_METRIC_DISTINCT_FRAGMENTS] = one->sets > 0 ? one->sets : 1;
    row.metric[FM_METRIC_FRAMES_RMSE_MAX] = one->worst_frame;
    return row;
}

#define RASTER .feed = "raster", .order = "random"
#define TURNS  RASTER, .is_software = true
#define FLIGHT .feed = "compute-adjacent", .order = "random", .is_software = true
#define PIXELS .feed = "compute-pixel", .order = "random"

static const fake fakes[] = {
    { RASTER, .traits = FM_TRAIT_EXACT },
    { RASTER, .traits = FM_TRAIT_EXACT, .images = 2, .tied = 1 }, /* ties allow it */
    { RASTER, .traits = FM_TRAIT_EXACT, .images = 2, .wrong = FM_WRONG_UNSTABLE,
      .unexplained = FM_WRONG_UNSTABLE },
    { RASTER, .traits = FM_TRAIT_EXACT, .missing = 1, .wrong = FM_WRONG_MISSING,
      .unexplained = FM_WRONG_MISSING },
    { RASTER, .traits = FM_TRAIT_EXACT, .extra = 1, .wrong = FM_WRONG_EXTRA,
      .unexplained = FM_WRONG_EXTRA },
    { RASTER, .traits = FM_TRAIT_EXACT, .misordered = 1, .wrong = FM_WRONG_MISORDERED,
      .unexplained = FM_WRONG_MISORDERED },
    { RASTER, .traits = FM_TRAIT_EXACT, .lost = 1, .wrong = FM_WRONG_LOST,
      .unexplained = FM_WRONG_LOST },
    { RASTER, .traits = FM_TRAIT_EXACT, .self_beyond = 2e-6, .wrong = FM_WRONG_IMAGE,
      .unexplained = FM_WRONG_IMAGE },
    /* ties: all of them, no more, no fewer */
    { TURNS, .traits = FM_TRAIT_LOSES_TIES, .missing = TIES, .lost_ties = TIES,
      .wrong = FM_WRONG_MISSING, .reasons = FM_TRAIT_LOSES_TIES },
    { TURNS, .traits = FM_TRAIT_LOSES_TIES, .missing = TIES + 1, .lost_ties = TIES,
      .wrong = FM_WRONG_MISSING, .reasons = FM_TRAIT_LOSES_TIES, .unexplained = FM_WRONG_MISSING },
    { TURNS, .traits = FM_TRAIT_LOSES_TIES, .missing = TIES - 1, .lost_ties = TIES - 1,
      .wrong = FM_WRONG_MISSING, .reasons = FM_TRAIT_LOSES_TIES, .unexplained = FM_WRONG_MISSING },
    { TURNS, .traits = FM_TRAIT_LOSES_TIES, .wrong = FM_WRONG_MISSING,
      .unexplained = FM_WRONG_MISSING },
    { TURNS, .traits = FM_TRAIT_LOSES_TIES, .missing = TIES, .lost_ties = TIES, .extra = 1,
      .wrong = FM_WRONG_MISSING | FM_WRONG_EXTRA, .reasons = FM_TRAIT_LOSES_TIES,
      .unexplained = FM_WRONG_EXTRA },
    { TURNS, .traits = FM_TRAIT_LOSES_TIES | FM_TRAIT_EMITS_BACK, .missing = TIES,
      .lost_ties = TIES, .extra = TIES, .wrong = FM_WRONG_MISSING | FM_WRONG_EXTRA,
      .reasons = FM_TRAIT_LOSES_TIES },
    { TURNS, .traits = FM_TRAIT_LOSES_TIES | FM_TRAIT_EMITS_BACK, .missing = TIES,
      .lost_ties = TIES, .extra = TIES + 1, .wrong = FM_WRONG_MISSING | FM_WRONG_EXTRA,
      .reasons = FM_TRAIT_LOSES_TIES, .unexplained = FM_WRONG_EXTRA },
    { TURNS, .traits = FM_TRAIT_PASSES_LOSE_TIES },
    { TURNS, .traits = FM_TRAIT_PASSES_LOSE_TIES, .missing = TIES - 1, .lost_ties = TIES - 1,
      .wrong = FM_WRONG_MISSING, .reasons = FM_TRAIT_PASSES_LOSE_TIES },
    { TURNS, .traits = FM_TRAIT_PASSES_LOSE_TIES, .missing = TIES + 1, .lost_ties = TIES,
      .wrong = FM_WRONG_MISSING, .reasons = FM_TRAIT_PASSES_LOSE_TIES,
      .unexplained = FM_WRONG_MISSING },
    /* which one of a tie survives may change from frame to frame, but not where they come in turn
     */
    { FLIGHT, .traits = FM_TRAIT_LOSES_TIES, .missing = TIES, .lost_ties = TIES, .self_beyond = 0.1,
      .tied = 1, .wrong = FM_WRONG_MISSING | FM_WRONG_IMAGE, .reasons = FM_TRAIT_LOSES_TIES },
    { TURNS, .traits = FM_TRAIT_LOSES_TIES, .missing = TIES, .lost_ties = TIES, .self_beyond = 0.1,
      .wrong = FM_WRONG_MISSING | FM_WRONG_IMAGE, .reasons = FM_TRAIT_LOSES_TIES,
      .unexplained = FM_WRONG_IMAGE },
    /* depth 1 */
    { TURNS, .traits = FM_TRAIT_LOSES_DEPTH_ONE | FM_TRAIT_EXACT, .missing = AT_ONE,
      .lost_at_one = AT_ONE, .wrong = FM_WRONG_MISSING, .reasons = FM_TRAIT_LOSES_DEPTH_ONE },
    { TURNS, .traits = FM_TRAIT_LOSES_DEPTH_ONE | FM_TRAIT_EXACT, .missing = AT_ONE - 1,
      .lost_at_one = AT_ONE - 1, .wrong = FM_WRONG_MISSING, .reasons = FM_TRAIT_LOSES_DEPTH_ONE,
      .unexplained = FM_WRONG_MISSING },
    /* races need company */
    { RASTER, .traits = FM_TRAIT_RACY, .missing = 50, .extra = 2, .misordered = 1, .images = 4,
      .wrong = FM_WRONG_MISSING | FM_WRONG_EXTRA | FM_WRONG_MISORDERED | FM_WRONG_UNSTABLE,
      .reasons = FM_TRAIT_RACY },
    { FLIGHT, .traits = FM_TRAIT_RACY, .missing = 50, .wrong = FM_WRONG_MISSING,
      .reasons = FM_TRAIT_RACY },
    { TURNS, .traits = FM_TRAIT_RACY, .missing = 50, .wrong = FM_WRONG_MISSING,
      .unexplained = FM_WRONG_MISSING },
    { PIXELS, .traits = FM_TRAIT_RACY, .missing = 50, .wrong = FM_WRONG_MISSING,
      .unexplained = FM_WRONG_MISSING },
    { FLIGHT, .traits = FM_TRAIT_RACY | FM_TRAIT_LOSES_TIES, .missing = 2, .lost_ties = 2,
      .wrong = FM_WRONG_MISSING, .reasons = FM_TRAIT_LOSES_TIES }, /* a race may keep some */
    { TURNS, .traits = FM_TRAIT_RACY | FM_TRAIT_LOSES_TIES, .missing = 2, .lost_ties = 2,
      .wrong = FM_WRONG_MISSING, .reasons = FM_TRAIT_LOSES_TIES, .unexplained = FM_WRONG_MISSING },
    /* order of arrival */
    { TURNS, .traits = FM_TRAIT_SORTED_INPUT, .missing = 50, .wrong = FM_WRONG_MISSING,
      .reasons = FM_TRAIT_SORTED_INPUT },
    { .feed = "raster",
      .order = "ascending",
      .is_software = true,
      .traits = FM_TRAIT_SORTED_INPUT,
      .missing = 50,
      .wrong = FM_WRONG_MISSING,
      .unexplained = FM_WRONG_MISSING },
    { .feed = "compute-adjacent",
      .order = "ascending",
      .traits = FM_TRAIT_SORTED_INPUT,
      .missing = 50,
      .images = 2,
      .wrong = FM_WRONG_MISSING | FM_WRONG_UNSTABLE,
      .reasons = FM_TRAIT_SORTED_INPUT },
    { TURNS, .traits = FM_TRAIT_SORTED_INPUT, .extra = 1, .wrong = FM_WRONG_EXTRA,
      .unexplained = FM_WRONG_EXTRA },
    { TURNS, .traits = FM_TRAIT_SORTED_INPUT, .missing = 1, .images = 2,
      .wrong = FM_WRONG_MISSING | FM_WRONG_UNSTABLE, .reasons = FM_TRAIT_SORTED_INPUT,
      .unexplained = FM_WRONG_UNSTABLE },
    /* approximations are judged by their image */
    { TURNS, .traits = FM_TRAIT_APPROXIMATE, .missing = WANTED, .extra = 3, .self_beyond = 0.9 },
    { TURNS, .traits = FM_TRAIT_APPROXIMATE, .missing = WANTED, .off_truth = 0.1,
      .wrong = FM_WRONG_IMAGE, .reasons = FM_TRAIT_APPROXIMATE },
    { TURNS, .traits = FM_TRAIT_APPROXIMATE, .lost = 1, .wrong = FM_WRONG_LOST,
      .unexplained = FM_WRONG_LOST },
    /* other frames */
    { TURNS, .traits = FM_TRAIT_EXACT, .is_wrong_image = true, .tied = 5, .wrong = FM_WRONG_IMAGE,
      .unexplained = FM_WRONG_IMAGE },
    { TURNS, .traits = FM_TRAIT_EXACT, .tied = 5, .worst_frame = 0.1, .wrong = FM_WRONG_UNSTABLE,
      .unexplained = FM_WRONG_UNSTABLE },
    { TURNS, .traits = FM_TRAIT_EXACT, .tied = 5,
      .sets = 2 }, /* another one of a tie at the k-th */
    { TURNS, .traits = FM_TRAIT_EXACT, .missing_max = 9,
      .wrong = FM_WRONG_MISSING | FM_WRONG_UNSTABLE,
      .unexplained = FM_WRONG_MISSING | FM_WRONG_UNSTABLE },
    { FLIGHT, .traits = FM_TRAIT_RACY, .missing_max = 9, .sets = 3,
      .wrong = FM_WRONG_MISSING | FM_WRONG_UNSTABLE, .reasons = FM_TRAIT_RACY },
    { TURNS, .traits = FM_TRAIT_RACY, .sets = 3, .wrong = FM_WRONG_UNSTABLE,
      .unexplained = FM_WRONG_UNSTABLE },
    /* a device that the manifest does not list yet may be a GPU */
    { RASTER, .is_unknown = true, .traits = FM_TRAIT_RACY, .missing = 9, .wrong = FM_WRONG_MISSING,
      .reasons = FM_TRAIT_RACY },
    /* planes that cross arrive in no order; samples of flat layers are those of the centre */
    { .feed = "raster",
      .order = "ascending",
      .options = "depths=sloped",
      .is_software = true,
      .traits = FM_TRAIT_SORTED_INPUT,
      .missing = 9,
      .wrong = FM_WRONG_MISSING,
      .reasons = FM_TRAIT_SORTED_INPUT },
    { .feed = "raster",
      .order = "",
      .is_software = true,
      .traits = FM_TRAIT_MULTISAMPLED,
      .extra = 9,
      .wrong = FM_WRONG_EXTRA,
      .reasons = FM_TRAIT_MULTISAMPLED },
    { TURNS, .traits = FM_TRAIT_MULTISAMPLED, .missing = 9, .extra = 9,
      .wrong = FM_WRONG_MISSING | FM_WRONG_EXTRA,
      .unexplained = FM_WRONG_MISSING | FM_WRONG_EXTRA },
    /* what the file says is lost has to be declared */
    { TURNS, .traits = FM_TRAIT_EXACT, .missing = 5, .lost_ties = 5, .wrong = FM_WRONG_MISSING,
      .unexplained = FM_WRONG_MISSING },
    { FLIGHT, .traits = FM_TRAIT_LOSES_TIES, .missing = TIES, .lost_ties = TIES, .self_beyond = 0.1,
      .wrong = FM_WRONG_MISSING | FM_WRONG_IMAGE, .reasons = FM_TRAIT_LOSES_TIES,
      .unexplained = FM_WRONG_IMAGE }, /* ties of one colour */
    { TURNS, .traits = 0, .missing = 1, .wrong = FM_WRONG_MISSING,
      .unexplained = FM_WRONG_MISSING },
};

static void each_error_needs_a_trait_that_allows_it_there(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof fakes / sizeof fakes[0]; i++) {
        const fm_case_row row = row_of(&fakes[i]);
        const fm_blame blame = blame_case(&row);
        if (blame.wrong != fakes[i].wrong || blame.traits != fakes[i].reasons ||
            blame.unexplained != fakes[i].unexplained)
            fail_msg("case %zu: wrong 0x%x, traits 0x%x, unexplained 0x%x", i, blame.wrong,
                     blame.traits, blame.unexplained);
        assert_int_equal(blame_is_open(&blame), fakes[i].unexplained != 0);
        assert_int_equal(blame.verdict,
                         fakes[i].wrong != 0 ? FM_STABILITY_WRONG : FM_STABILITY_EXACT);
    }
}

static fm_stability verdict_of(fm_case_status outcome, uint32_t traits, double off)
{
    const fake one = { RASTER, .traits = traits, .self_beyond = off };
    fm_case_row row = row_of(&one);
    row.outcome = outcome;
    return blame_case(&row).verdict;
}

static void what_is_right_is_exact_or_within_tolerance(void **state)
{
    (void)state;
    assert_int_equal(verdict_of(FM_CASE_OK, FM_TRAIT_EXACT, 0x1p-23), FM_STABILITY_EXACT);
    assert_int_equal(verdict_of(FM_CASE_OK, FM_TRAIT_EXACT, 0x1.8p-23), FM_STABILITY_TOLERATED);
    assert_int_equal(verdict_of(FM_CASE_OK, FM_TRAIT_EXACT, 9e-7), FM_STABILITY_TOLERATED);
    assert_int_equal(verdict_of(FM_CASE_WRONG_IMAGE, FM_TRAIT_EXACT, 2e-6), FM_STABILITY_WRONG);
    assert_int_equal(verdict_of(FM_CASE_WRONG_IMAGE, FM_TRAIT_EXACT, 0), FM_STABILITY_WRONG);
    assert_int_equal(verdict_of(FM_CASE_NOT_SUPPORTED, 0, 0), FM_STABILITY_NOT_SUPPORTED);
    assert_int_equal(verdict_of(FM_CASE_SKIPPED, 0, 0), FM_STABILITY_NONE);
    assert_int_equal(verdict_of(FM_CASE_OK, FM_TRAIT_FLOOR, 0), FM_STABILITY_NONE);
    for (int outcome = FM_CASE_PLUGIN_ERROR; outcome < FM_CASE_STATUS_COUNT; outcome++)
        assert_int_equal(verdict_of((fm_case_status)outcome, 0, 0), FM_STABILITY_FAILED);
}

static void reasons_are_words(void **state)
{
    (void)state;
    char words[BLAME_WORDS_BYTES];
    const fake one = { FLIGHT, .traits = FM_TRAIT_RACY | FM_TRAIT_LOSES_TIES, .missing = 9,
                       .lost_ties = TIES };
    fm_case_row row = row_of(&one);
    fm_blame blame = blame_case(&row);
    blame_words(words, &blame, &row);
    assert_string_equal(words, "loses ties, fragments race");
    row.outcome = FM_CASE_NOT_SUPPORTED;
    row.reason = "depth-test";
    blame = blame_case(&row);
    blame_words(words, &blame, &row);
    assert_string_equal(words, "depth-test");
    row.outcome = FM_CASE_TIMEOUT;
    row.status = "timeout";
    blame = blame_case(&row);
    blame_words(words, &blame, &row);
    assert_string_equal(words, "timeout");
    assert_true(blame_is_open(&blame));
}

/* Tiles of sequences: only of exact techniques they are a fault. */
static void wrong_tiles_need_a_technique_that_is_not_exact(void **state)
{
    (void)state;
    const fake one = { .feed = "frames", .order = "", .traits = FM_TRAIT_EXACT };
    fm_case_row row = row_of(&one);
    row.is_simulated = true;
    row.metric[FM_METRIC_WRONG_TILES] = 2;
    assert_int_equal(blame_case(&row).unexplained, FM_WRONG_TILES);
    row.look.traits = 0;
    const fm_blame blame = blame_case(&row);
    assert_int_equal(blame.wrong, FM_WRONG_TILES);
    assert_int_equal(blame.unexplained, 0);
    char words[BLAME_WORDS_BYTES];
    blame_words(words, &blame, &row);
    assert_string_equal(words, "not declared exact");
}

/* Files of before the columns, and numbers that no case can have. */
static void what_is_not_recorded_is_unknown(void **state)
{
    (void)state;
    const fake one = { TURNS, .traits = FM_TRAIT_LOSES_TIES, .missing = 7 };
    fm_case_row row = row_of(&one);
    row.metric[FM_METRIC_N] = 0x1p53;
    assert_int_equal(blame_case(&row).verdict, FM_STABILITY_WRONG);
    row.metric[FM_METRIC_FRAGMENTS_WANTED] = NAN;
    const fm_blame blame = blame_case(&row);
    assert_int_equal(blame.verdict, FM_STABILITY_UNKNOWN);
    assert_false(blame_is_open(&blame));
}

/* Two methods on two scenes; one has two cases there, and a floor none. */
static void a_cell_shows_its_worst_case(void **state)
{
    (void)state;
    static const fake right = { RASTER, .traits = FM_TRAIT_EXACT };
    static const fake lossy = { RASTER, .traits = FM_TRAIT_RACY, .missing = 40 };
    static const fake fault = { RASTER, .traits = FM_TRAIT_EXACT, .missing = 1 };
    fm_case_row rows[] = { row_of(&right), row_of(&fault), row_of(&right),
                           row_of(&lossy), row_of(&lossy), row_of(&right) };
    rows[3].method = rows[4].method = "kb";
    rows[2].scene = rows[4].scene = "t";
    rows[4].metric[FM_METRIC_MISSING] = 60;
    rows[5].look.traits = FM_TRAIT_FLOOR;
    const fm_result_files results = { .cases = rows, .count = sizeof rows / sizeof rows[0] };
    fm_stability_matrices matrices;
    assert_int_equal(matrices_make(&matrices, &results, NULL), FM_OK);
    assert_int_equal(matrices.count, 1);
    assert_int_equal(matrices.cases, 5);
    assert_int_equal(matrices.open, 1);
    const fm_stability_matrix *matrix = &matrices.items[0];
    assert_int_equal(matrix->method_count, 2);
    assert_int_equal(matrix->scene_count, 2);
    const fm_stability_cell *worst = matrix_cell(matrix, 0, 0);
    assert_int_equal(worst->cases, 2);
    assert_int_equal(worst->open, 1);
    assert_ptr_equal(worst->row, &rows[1]);
    assert_int_equal(matrix_cell(matrix, 0, 1)->blame.verdict, FM_STABILITY_EXACT);
    assert_true(matrix_cell(matrix, 1, 1)->blame.missing_share > 0.59);
    matrices_free(&matrices);
}

static void feeds_and_devices_have_matrices_of_their_own(void **state)
{
    (void)state;
    static const fake raster = { RASTER, .traits = FM_TRAIT_EXACT };
    static const fake flight = { FLIGHT, .traits = FM_TRAIT_EXACT };
    fm_case_row rows[] = { row_of(&raster), row_of(&flight), row_of(&raster) };
    rows[2].device = "osmesa";
    const fm_result_files results = { .cases = rows, .count = 3 };
    fm_stability_matrices matrices;
    assert_int_equal(matrices_make(&matrices, &results, NULL), FM_OK);
    assert_int_equal(matrices.count, 3);
    assert_string_equal(matrices.items[1].feed, "compute-adjacent");
    assert_string_equal(matrices.items[2].device, "osmesa");
    matrices_free(&matrices);
}

static void the_table_has_a_row_a_case(void **state)
{
    (void)state;
    static const fake lossy = { RASTER, .traits = FM_TRAIT_RACY | FM_TRAIT_BOUNDED, .missing = 40 };
    fm_case_row rows[] = { row_of(&lossy), row_of(&lossy) };
    rows[1].look.traits = FM_TRAIT_FLOOR;
    const fm_result_files results = { .cases = rows, .count = 2 };
    fm_text csv = { 0 };
    assert_int_equal(stability_csv_add(&csv, &results, NULL), FM_OK);
    const char *row = strchr(csv.bytes, '\n') + 1;
    assert_string_equal(row,
                        "a,vulkan,a GPU,0,raster,s,random,m,bounded racy,,0,12,ok,wrong,missing,"
                        "fragments race,,100,40,0,0,0,0,0,0,0,0,0,0,1,0,1,0,,0,0\n");
    text_free(&csv);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_error_needs_a_trait_that_allows_it_there),
        cmocka_unit_test(what_is_right_is_exact_or_within_tolerance),
        cmocka_unit_test(reasons_are_words),
        cmocka_unit_test(wrong_tiles_need_a_technique_that_is_not_exact),
        cmocka_unit_test(what_is_not_recorded_is_unknown),
        cmocka_unit_test(a_cell_shows_its_worst_case),
        cmocka_unit_test(feeds_and_devices_have_matrices_of_their_own),
        cmocka_unit_test(the_table_has_a_row_a_case),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
