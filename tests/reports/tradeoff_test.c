/* Speed against error: who stands where, the cheapest for an error, several workloads, the table.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "tradeoff/cheapest.h"
#include "tradeoff/overall.h"
#include "tradeoff/tradeoff_csv.h"

enum { MANY = 400 };

/* A case with a time, its interval (low 0: none) and an error. */
typedef struct fake {
    const char *method;
    double k, ms, low, high, error;
    bool is_control, is_wrong;
} fake;

static fm_case_row row_of(const fake *one, const char *scene)
{
    fm_case_row row = { .id = one->method,
                        .status = one->is_wrong ? "wrong_image" : "ok",
                        .message = "",
                        .method = one->method,
                        .device = "vulkan",
                        .feed = "raster",
                        .scene = scene,
                        .options = "",
                        .k = one->k > 0 ? one->k : NAN,
                        .look = { .title = one->method, .is_control = one->is_control },
                        .is_ok = !one->is_wrong,
                        .is_measured = true };
    for (int i = 0; i < FM_METRIC_COUNT; i++)
        row.metric[i] = row.low[i] = row.high[i] = NAN;
    row.metric[FM_METRIC_FRAME_MS] = one->ms;
    row.metric[FM_METRIC_TOTAL_RMSE] = one->error;
    row.metric[FM_METRIC_TOTAL_SSIM] = 1 - one->error;
    row.metric[FM_METRIC_BYTES_ALLOCATED] = 1000 * one->ms;
    if (one->low > 0) {
        row.low[FM_METRIC_FRAME_MS] = one->low;
        row.high[FM_METRIC_FRAME_MS] = one->high;
    }
    return row;
}

/* Cases that live as long as it. */
typedef struct group_kit {
    fm_case_row rows[MANY];
    const fm_case_row *cases[MANY];
    fm_group group;
} group_kit;

static void fill(group_kit *kit, const fake *fakes, size_t count, const char *scene)
{
    for (size_t i = 0; i < count; i++) {
        kit->rows[i] = row_of(&fakes[i], scene);
        kit->cases[i] = &kit->rows[i];
    }
    kit->group = (fm_group){ .cases = kit->cases, .count = count };
    snprintf(kit->group.name, sizeof kit->group.name, "%s-vulkan-raster", scene);
}

static const fm_error_kind *rmse(void)
{
    return error_kind_find(NULL, NULL);
}

static const fake usual[] = {
    { "exact-slow", 0, 10, 9.5, 10.5, 1e-8, false, false },
    { "exact-fast", 0, 5, 4.8, 5.2, 5e-7, false, false },
    { "exact-near", 0, 5.1, 5.0, 5.4, 0, false, false },
    { "lossy", 8, 2, 1.9, 2.1, 1e-2, false, false },
    { "lossy-slow", 8, 6, 5.8, 6.1, 1e-2, false, false },
    { "lossier-as-fast", 4, 2.05, 1.95, 2.2, 5e-2, false, false },
    { "null", 0, 0.1, 0.1, 0.1, 0, true, false },
    { "wrong", 0, 0.1, 0.1, 0.1, 0, false, true },
    { "one-launch", 0, 0.5, 0, 0, 1e-3, false, false },
};
enum { USUAL = sizeof usual / sizeof usual[0] };

static void intervals_decide_who_is_dominated(void **state)
{
    (void)state;
    static group_kit kit;
    fm_place places[USUAL];
    fill(&kit, usual, USUAL, "layers");
    assert_true(standings_make(places, &kit.group, rmse()));
    static const fm_standing expected[] = {
        FM_STANDING_DOMINATED, FM_STANDING_TIED,      FM_STANDING_TIED,
        FM_STANDING_TIED,      FM_STANDING_DOMINATED, FM_STANDING_TIED,
        FM_STANDING_NONE,      FM_STANDING_NONE,      FM_STANDING_TIED,
    };
    for (int i = 0; i < USUAL; i++)
        if (places[i].standing != expected[i])
            fail_msg("%s is %s", usual[i].method, standing_name(places[i].standing));
    assert_int_equal(places[0].beaten_by, 1); /* whose interval ends before exact-near's */
    assert_int_equal(places[4].beaten_by, 3);
}

static void clearly_faster_than_all_as_exact_is_the_frontier(void **state)
{
    (void)state;
    static group_kit kit;
    fm_place places[USUAL];
    fill(&kit, usual, USUAL - 1, "layers"); /* without the one that nobody can be told from */
    assert_true(standings_make(places, &kit.group, rmse()));
    assert_int_equal(places[3].standing, FM_STANDING_FRONTIER);
    assert_int_equal(places[5].standing, FM_STANDING_TIED); /* with `lossy` */
    assert_int_equal(places[1].standing, FM_STANDING_TIED);
}

static bool beats(const fake *a, const fake *b)
{
    return a != b && a->error <= b->error && a->high < b->low;
}

static bool is_clear_of(const fake *a, const fake *all, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (&all[i] != a && all[i].error <= a->error && !(a->high < all[i].low))
            return false;
    return true;
}

static void standings_follow_their_definition_for_random_cases(void **state)
{
    (void)state;
    static group_kit kit;
    fake fakes[MANY];
    fm_place places[MANY];
    uint64_t seed = 5;
    for (int i = 0; i < MANY; i++) {
        const double low = 1 + random_below(&seed, 1000) * 0.01;
        fakes[i] = (fake){ "m",   0,    low + 0.05, low, low + 0.1, random_below(&seed, 40) * 0.001,
                           false, false };
    }
    for (int i = 0; i < MANY; i++) /* as they are compared */
        fakes[i].error = fakes[i].error <= 1e-6 ? 0 : fakes[i].error;
    fill(&kit, fakes, MANY, "layers");
    assert_true(standings_make(places, &kit.group, rmse()));
    for (int i = 0; i < MANY; i++) {
        bool is_beaten = false;
        for (int j = 0; j < MANY; j++)
            is_beaten = is_beaten || beats(&fakes[j], &fakes[i]);
        const fm_standing expected = is_beaten                             ? FM_STANDING_DOMINATED
                                     : is_clear_of(&fakes[i], fakes, MANY) ? FM_STANDING_FRONTIER
                                                                           : FM_STANDING_TIED;
        assert_int_equal(places[i].standing, expected);
        if (is_beaten)
            assert_true(beats(&fakes[places[i].beaten_by], &fakes[i]));
    }
}

static void cheapest_for_each_error(void **state)
{
    (void)state;
    static group_kit kit;
    fm_cheapest cheapest[CHEAPEST_BOUNDS];
    fill(&kit, usual, USUAL - 1, "layers");
    assert_true(cheapest_make(cheapest, &kit.group, rmse()));
    assert_string_equal(cheapest[0].row->method, "exact-fast");
    assert_int_equal(cheapest[0].tied_count, 1);
    assert_true(cheapest[0].ratio.value == 1 && cheapest[0].ratio.low == 1);
    assert_string_equal(cheapest[2].row->method, "exact-fast"); /* up to 1e-3 */
    assert_string_equal(cheapest[3].row->method, "lossy");      /* up to 1e-2 */
    assert_true(fabs(cheapest[3].ratio.value - 0.4) < 1e-12);
    assert_true(fabs(cheapest[3].ratio.low - 1.9 / 5.2) < 1e-12);
    assert_true(fabs(cheapest[3].ratio.high - 2.1 / 4.8) < 1e-12);
    assert_int_equal(cheapest[3].tied_count, 0);
    assert_int_equal(cheapest[4].tied_count, 1);

    fill(&kit, usual + 3, 3, "layers"); /* none of them exact */
    assert_true(cheapest_make(cheapest, &kit.group, rmse()));
    assert_null(cheapest[0].row);
    assert_string_equal(cheapest[3].row->method, "lossy");
    assert_true(isnan(cheapest[3].ratio.value));
}

/* The same method with twice the layers is slower, and not dominated for that. */
static void cases_of_another_n_are_no_rivals(void **state)
{
    (void)state;
    static group_kit kit;
    fm_place places[2];
    fm_cheapest cheapest[CHEAPEST_BOUNDS];
    static const fake fakes[] = { { "array", 8, 1, 1, 1, 0, false, false },
                                  { "array", 16, 2, 2, 2, 0, false, false } };
    fill(&kit, fakes, 2, "layers");
    assert_true(standings_make(places, &kit.group, rmse()));
    assert_int_equal(places[1].standing, FM_STANDING_DOMINATED);
    kit.rows[0].metric[FM_METRIC_N] = 8;
    kit.rows[1].metric[FM_METRIC_N] = 16;
    assert_true(standings_make(places, &kit.group, rmse()));
    assert_int_equal(places[1].standing, FM_STANDING_FRONTIER);
    assert_true(cheapest_make(cheapest, &kit.group, rmse()));
    assert_null(cheapest[0].row);
}

/* The lossy one takes 0.4 and 0.1 times as long as the exact one: 0.2 in the mean. */
static void methods_over_two_scenes(void **state)
{
    (void)state;
    static const fake first[] = { { "exact", 0, 10, 9, 11, 0, false, false },
                                  { "lossy", 8, 4, 3.6, 4.4, 1e-3, false, false },
                                  { "only-here", 8, 1, 1, 1, 1e-3, false, false } };
    static const fake second[] = { { "exact", 0, 100, 100, 100, 0, false, false },
                                   { "lossy", 8, 10, 9, 11, 5e-3, false, false } };
    static group_kit kits[2];
    fm_group both[2];
    const fm_groups groups = { both, 2 };
    fm_overalls overalls;
    fill(&kits[0], first, 3, "layers");
    fill(&kits[1], second, 2, "bunny");
    both[0] = kits[0].group;
    both[1] = kits[1].group;
    assert_int_equal(overalls_make(&overalls, &groups, rmse(), NULL), FM_OK);
    assert_int_equal(overalls.count, 1);
    const fm_overall *all = overalls.items;
    assert_int_equal(all->workload_count, 2);
    assert_int_equal(all->scene_count, 2);
    assert_int_equal(all->point_count, 2);
    assert_string_equal(all->points[1].row->method, "lossy");
    assert_true(fabs(all->points[1].ratio.value - 0.2) < 1e-12);
    assert_true(all->points[0].ratio.low == 1 && all->points[0].ratio.high == 1);
    assert_true(fabs(all->points[1].ratio.low - sqrt(3.6 / 11 * 0.09)) < 1e-12);
    assert_true(all->points[1].error == 5e-3);
    overalls_free(&overalls);
    both[1] = kits[0].group; /* the same scene again */
    assert_int_equal(overalls_make(&overalls, &groups, rmse(), NULL), FM_OK);
    assert_int_equal(overalls.count, 0);
    overalls_free(&overalls);
}

static void other_errors_may_be_chosen(void **state)
{
    (void)state;
    const char *nearest = NULL;
    const fake half = { "half", 0, 1, 1, 1, 0.5, false, false };
    const fm_case_row row = row_of(&half, "layers");
    const fm_error_kind *ssim = error_kind_find("total_ssim", &nearest);
    assert_non_null(ssim);
    assert_true(error_kind_of(ssim, &row) == 0.5);
    assert_true(isnan(error_kind_of(error_kind_find("total_flip", &nearest), &row)));
    assert_null(error_kind_find("total_flop", &nearest));
    assert_string_equal(nearest, "total_flip");
}

/* exposure=3 magnifies rounding by 8. */
static void exact_is_as_bright_as_the_picture(void **state)
{
    (void)state;
    const char *nearest = NULL;
    const fake rounded = { "rounded", 0, 1, 1, 1, 5e-6, false, false };
    fm_case_row row = row_of(&rounded, "layers");
    assert_true(error_kind_of(rmse(), &row) > 0);
    row.options = "layout=pixel exposure=3";
    assert_true(error_kind_of(rmse(), &row) == 0);
    row.metric[FM_METRIC_TOTAL_RMSE] = 1e-5;
    assert_true(error_kind_of(rmse(), &row) > 0);
    assert_true(error_kind_of(error_kind_find("total_ssim", &nearest), &row) > 0);
    row.options = "exposure=-3";
    row.metric[FM_METRIC_TOTAL_RMSE] = 9e-7;
    assert_true(error_kind_of(rmse(), &row) == 0);
}

/* A frame that was right does not make a method exact. */
static void the_worst_frame_counts(void **state)
{
    (void)state;
    const fake racy = { "racy", 0, 1, 1, 1, 0, false, false };
    fm_case_row row = row_of(&racy, "layers");
    assert_true(error_kind_of(rmse(), &row) == 0);
    row.metric[FM_METRIC_FRAMES_TOTAL_RMSE_MAX] = 0.007;
    assert_true(error_kind_of(rmse(), &row) == 0.007);
    row.metric[FM_METRIC_TOTAL_RMSE] = 0.01;
    assert_true(error_kind_of(rmse(), &row) == 0.01);
}

static void table_has_what_is_charted(void **state)
{
    (void)state;
    static group_kit kit;
    fm_text csv = { 0 };
    fill(&kit, usual, USUAL, "layers");
    fm_group one = kit.group;
    const fm_groups groups = { &one, 1 };
    assert_int_equal(tradeoff_csv_add(&csv, &groups, rmse(), NULL), FM_OK);
    assert_non_null(strstr(csv.bytes, "layers-vulkan-raster,layers,vulkan,raster,lossy-slow,,8,,"
                                      "lossy-slow,ok,total_rmse,0.01,,,6,5.8,6.1,6000,dominated,"
                                      "lossy\n"));
    assert_non_null(strstr(csv.bytes, "wrong,,,,wrong,wrong_image,total_rmse,0,,,0.1,"));
    text_free(&csv);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_decide_who_is_dominated),
        cmocka_unit_test(clearly_faster_than_all_as_exact_is_the_frontier),
        cmocka_unit_test(standings_follow_their_definition_for_random_cases),
        cmocka_unit_test(cheapest_for_each_error),
        cmocka_unit_test(cases_of_another_n_are_no_rivals),
        cmocka_unit_test(methods_over_two_scenes),
        cmocka_unit_test(other_errors_may_be_chosen),
        cmocka_unit_test(exact_is_as_bright_as_the_picture),
        cmocka_unit_test(the_worst_frame_counts),
        cmocka_unit_test(table_has_what_is_charted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
