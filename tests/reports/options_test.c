/* The text of a case's options. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "read/options.h"

static void value_is_found_by_its_whole_key(void **state)
{
    (void)state;
    char value[FM_OPTION_VALUE_BYTES];
    options_value(value, "unlock=a lock=spin", "lock");
    assert_string_equal(value, "spin");
    options_value(value, "unlock=a lock=spin", "loc");
    assert_string_equal(value, "");
}

static void keys_of_the_scene_are_apart_from_the_methods_own(void **state)
{
    (void)state;
    char chosen[FM_OPTIONS_TEXT_BYTES];
    const char *options = "depths=clustered lock=spin layout=image";
    options_select(chosen, options, FM_OPTIONS_OF_SCENE, NULL);
    assert_string_equal(chosen, "depths=clustered");
    options_select(chosen, options, FM_OPTIONS_OWN, NULL);
    assert_string_equal(chosen, "lock=spin layout=image");
    assert_true(
        options_are_same(options, "lock=spin layout=image depths=ulp", FM_OPTIONS_OWN, NULL));
    assert_false(options_are_same(options, "depths=ulp", FM_OPTIONS_OF_SCENE, NULL));
    fm_text_list without = { 0 };
    assert_true(text_list_add(&without, "layout"));
    assert_true(options_are_same(options, "lock=spin", FM_OPTIONS_OWN, &without));
    text_list_free(&without);
}

static void defaults_are_dropped_as_whole_pairs(void **state)
{
    (void)state;
    char kept[FM_OPTIONS_TEXT_BYTES];
    options_drop(kept, "layout=pixel counters=2 count=flat", "counters=20 count=flat layout=pixel");
    assert_string_equal(kept, "counters=2");
    options_drop(kept, "layout=pixel timers=frame", NULL);
    assert_string_equal(kept, "layout=pixel timers=frame");
}

/* Texts of 256 bytes were compared once, and longer ones taken for the same. */
static void long_options_are_compared_to_their_end(void **state)
{
    (void)state;
    char a[512], b[512];
    snprintf(a, sizeof a, "%0300d=1 last=1", 0);
    snprintf(b, sizeof b, "%0300d=1 last=2", 0);
    assert_false(options_are_same(a, b, FM_OPTIONS_OWN, NULL));
    assert_true(options_are_same(a, a, FM_OPTIONS_OWN, NULL));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(value_is_found_by_its_whole_key),
        cmocka_unit_test(keys_of_the_scene_are_apart_from_the_methods_own),
        cmocka_unit_test(defaults_are_dropped_as_whole_pairs),
        cmocka_unit_test(long_options_are_compared_to_their_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
