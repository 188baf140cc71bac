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
    page_add_notes(page, &results);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_in_which_nothing_was_drawn_are_noted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
