/* What needs no statistics. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ab/outputs.h"

/* Both sides of a case, alike at first. */
typedef struct both {
    fm_case_result base, now;
    uint64_t base_image, now_image;
    bool is_racy;
} both;

static json_t *metrics(void)
{
    return json_pack("{s:i, s:i, s:i, s:f, s:f}", "bytes_allocated", 4096, "missing", 0,
                     "fragments_stored", 100, "rmse", 0.001, "psnr_db", 60.0);
}

static void begin(both *of)
{
    *of = (both){ .base_image = 1, .now_image = 1 };
    of->base = (fm_case_result){ .status = FM_CASE_OK, .metrics = metrics(), .image_count = 1 };
    of->now = (fm_case_result){ .status = FM_CASE_OK, .metrics = metrics(), .image_count = 1 };
    of->base.images = &of->base_image;
    of->now.images = &of->now_image;
}

/* Compares, and lets go of what was made. changes is NULL: nothing is to be told. */
static void expect(both *of, ab_outputs outputs, const char *changes)
{
    fm_text text = { 0 };
    const ab_output_side base = { &of->base, of->is_racy }, now = { &of->now, of->is_racy };
    assert_int_equal(outputs_compare(&text, &base, &now), outputs);
    if (changes == NULL)
        assert_int_equal(text.length, 0);
    else
        assert_string_equal(text.bytes, changes);
    text_free(&text);
    json_decref(of->base.metrics);
    json_decref(of->now.metrics);
}

static void equal_outputs_are_equal(void **state)
{
    (void)state;
    both of;
    begin(&of);
    expect(&of, AB_OUTPUTS_EQUAL, NULL);
}

static void more_bytes_are_worse(void **state)
{
    (void)state;
    both of;
    begin(&of);
    json_object_set_new(of.now.metrics, "bytes_allocated", json_integer(4100));
    expect(&of, AB_OUTPUTS_WORSE, "bytes_allocated 4096 -> 4100");
}

static void fewer_bytes_are_better(void **state)
{
    (void)state;
    both of;
    begin(&of);
    json_object_set_new(of.now.metrics, "bytes_allocated", json_integer(4092));
    expect(&of, AB_OUTPUTS_BETTER, "bytes_allocated 4096 -> 4092");
}

static void worse_wins_over_better(void **state)
{
    (void)state;
    both of;
    begin(&of);
    json_object_set_new(of.now.metrics, "bytes_allocated", json_integer(4092));
    json_object_set_new(of.now.metrics, "missing", json_integer(1));
    expect(&of, AB_OUTPUTS_WORSE, "bytes_allocated 4096 -> 4092; missing 0 -> 1");
}

static void other_counts_differ_and_are_not_worse(void **state)
{
    (void)state;
    both of;
    begin(&of);
    json_object_set_new(of.now.metrics, "fragments_stored", json_integer(99));
    expect(&of, AB_OUTPUTS_DIFFER, "fragments_stored 100 -> 99");
}

static void rounding_of_an_error_is_equal_and_more_is_worse(void **state)
{
    (void)state;
    both of;
    begin(&of);
    json_object_set_new(of.now.metrics, "rmse", json_real(0.001 + 5e-7));
    json_object_set_new(of.now.metrics, "psnr_db", json_real(59.0)); /* it follows from rmse */
    expect(&of, AB_OUTPUTS_EQUAL, NULL);
    begin(&of);
    json_object_set_new(of.now.metrics, "rmse", json_real(0.0011));
    expect(&of, AB_OUTPUTS_WORSE, "rmse 0.001 -> 0.0011");
}

static void status_of_more_harm_is_worse(void **state)
{
    (void)state;
    both of;
    begin(&of);
    of.now.status = FM_CASE_CRASH;
    json_decref(of.now.metrics);
    of.now.metrics = NULL; /* it left none: what one side lacks is not compared */
    of.now.image_count = 0;
    expect(&of, AB_OUTPUTS_WORSE, "status ok -> crash");
    begin(&of);
    of.base.status = FM_CASE_WRONG_IMAGE;
    expect(&of, AB_OUTPUTS_BETTER, "status wrong_image -> ok");
}

static void another_picture_differs(void **state)
{
    (void)state;
    both of;
    begin(&of);
    of.now_image = 2;
    expect(&of, AB_OUTPUTS_DIFFER, "image 0000000000000001 -> 0000000000000002");
}

static void racy_method_is_judged_by_memory_alone(void **state)
{
    (void)state;
    both of;
    begin(&of);
    of.is_racy = true;
    of.now_image = 2;
    json_object_set_new(of.now.metrics, "missing", json_integer(7));
    expect(&of, AB_OUTPUTS_EQUAL, NULL);
    begin(&of);
    of.is_racy = true;
    json_object_set_new(of.now.metrics, "bytes_allocated", json_integer(4100));
    expect(&of, AB_OUTPUTS_WORSE, "bytes_allocated 4096 -> 4100");
}

static void picture_that_changes_within_a_side_is_not_compared(void **state)
{
    (void)state;
    both of;
    uint64_t images[2] = { 1, 3 };
    begin(&of);
    of.now.images = images;
    of.now.image_count = 2;
    json_object_set_new(of.now.metrics, "missing", json_integer(7));
    expect(&of, AB_OUTPUTS_EQUAL, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_outputs_are_equal),
        cmocka_unit_test(more_bytes_are_worse),
        cmocka_unit_test(fewer_bytes_are_better),
        cmocka_unit_test(worse_wins_over_better),
        cmocka_unit_test(other_counts_differ_and_are_not_worse),
        cmocka_unit_test(rounding_of_an_error_is_equal_and_more_is_worse),
        cmocka_unit_test(status_of_more_harm_is_worse),
        cmocka_unit_test(another_picture_differs),
        cmocka_unit_test(racy_method_is_judged_by_memory_alone),
        cmocka_unit_test(picture_that_changes_within_a_side_is_not_compared),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
