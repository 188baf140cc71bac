/* What the report notes of its results. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "page/page.h"

/* Notes on one case of method "kb" with this outcome and message. */
static void notes_of(fm_text *page, fm_case_status outcome, const char *message)
{
    fm_case_row row = { .method = "kb",
                        .message = message,
                        .scene = "layers",
                        .feed = "compute-pixel",
                        .outcome = outcome,
                        .is_ok = outcome == FM_CASE_OK,
                        .look = { .id = "kb", .title = "KB" } };
    const fm_result_files results = { .cases = &row, .count = 1 };
    page_add_notes(page, &results, false);
    assert_false(page->failed);
}

static void pictures_in_which_nothing_was_drawn_are_noted(void **state)
{
    (void)state;
    static const struct {
        fm_case_status outcome;
        const char *message;
        bool is_noted;
    } rows[] = {
        { FM_CASE_OK, FM_NOTHING_DRAWN, true },
        { FM_CASE_OK, FM_NOTHING_DRAWN "; frames over 2 s", true },
        { FM_CASE_OK, "", false },
        { FM_CASE_OK, "frames over 2 s", false },
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        fm_text page = { 0 };
        notes_of(&page, rows[i].outcome, rows[i].message);
        const char *note = strstr(page.bytes, "nothing was drawn");
        assert_int_equal(note != NULL, rows[i].is_noted);
        assert_true(note == NULL || strstr(note, "(KB)</p>") != NULL);
        text_free(&page);
    }
}

/* Two methods drew different pictures: of each the worst case is told, of an older run's what there
 * is. */
static void different_pictures_are_noted_with_the_worst_of_each_method(void **state)
{
    (void)state;
    fm_case_row rows[4] = { { .method = "kb", .look.title = "KB" },
                            { .method = "kb", .look.title = "KB" },
                            { .method = "mlab", .look.title = "MLAB" },
                            { .method = "exact", .look.title = "exact" } };
    const double rmse[4] = { 0.25, 0.5, NAN, 0.0 }, images[4] = { 7, 3, 2, 1 };
    for (int i = 0; i < 4; i++) {
        rows[i].message = rows[i].scene = rows[i].feed = rows[i].noisy = "";
        rows[i].is_measured = true;
        for (int m = 0; m < FM_METRIC_COUNT; m++)
            rows[i].metric[m] = NAN;
        rows[i].metric[FM_METRIC_DISTINCT_IMAGES] = images[i];
        rows[i].metric[FM_METRIC_FRAMES_RMSE_MAX] = rmse[i];
        rows[i].metric[FM_METRIC_FRAMES_DRAWN] = rmse[i] > 0 ? 15 : NAN;
    }
    rows[1].metric[FM_METRIC_DISTINCT_FRAGMENTS] = 2;
    rows[1].metric[FM_METRIC_CAPTURED_FRAMES] = 4;
    const fm_result_files results = { .cases = rows, .count = 4 };
    fm_text page = { 0 };
    page_add_notes(&page, &results, false);
    assert_non_null(strstr(page.bytes,
                           "the case with the worst frame: KB: 3 pictures in 15 frames, "
                           "rmse up to 0.5, 2 sets of fragments in 4 captured frames; "
                           "MLAB: 2 pictures. The ranges"));
    assert_null(strstr(page.bytes, "exact"));
    text_free(&page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(different_pictures_are_noted_with_the_worst_of_each_method),
        cmocka_unit_test(pictures_in_which_nothing_was_drawn_are_noted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
