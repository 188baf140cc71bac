#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "base/text_index.h"

static void text_index_finds_what_was_added(void **state)
{
    (void)state;
    fm_text_index index = { 0 };
    assert_int_equal(text_index_find(&index, "a"), FM_TEXT_INDEX_NONE);
    assert_int_equal(text_index_add(&index, "a", 7), 7);
    assert_int_equal(text_index_add(&index, "", 8), 8);
    assert_int_equal(text_index_find(&index, "a"), 7);
    assert_int_equal(text_index_find(&index, ""), 8);
    assert_int_equal(text_index_find(&index, "aa"), FM_TEXT_INDEX_NONE);
    text_index_free(&index);
}

static void text_index_keeps_the_first_number_of_a_text(void **state)
{
    (void)state;
    fm_text_index index = { 0 };
    assert_int_equal(text_index_add(&index, "a", 1), 1);
    assert_int_equal(text_index_add(&index, "a", 2), 1);
    assert_int_equal(text_index_find(&index, "a"), 1);
    text_index_free(&index);
}

static void text_index_copies_its_texts(void **state)
{
    (void)state;
    fm_text_index index = { 0 };
    char text[16];
    for (size_t i = 0; i < 1000; i++) {
        snprintf(text, sizeof text, "%zu", i);
        assert_int_equal(text_index_add(&index, text, i), i);
    }
    assert_int_equal(text_index_find(&index, "0"), 0);
    assert_int_equal(text_index_find(&index, "999"), 999);
    assert_int_equal(text_index_find(&index, "1000"), FM_TEXT_INDEX_NONE);
    text_index_free(&index);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_index_finds_what_was_added),
        cmocka_unit_test(text_index_keeps_the_first_number_of_a_text),
        cmocka_unit_test(text_index_copies_its_texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
