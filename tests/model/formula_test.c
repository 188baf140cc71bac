/* What a descriptor asks for, worked out by hand for a workload of 3 x 2 pixels. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "model/formula.h"

static const char *no_option(const fm_workload *workload, const char *name)
{
    (void)workload;
    (void)name;
    return NULL;
}

/* 6 pixels, k = 4, n = 5, F fragments. */
static fm_workload workload_of(uint64_t fragments, const uint64_t totals[FM_MAX_TOTALS])
{
    return (fm_workload){ .width_px = 3,
                          .height_px = 2,
                          .k = 4,
                          .n = 5,
                          .fragments = fragments,
                          .totals = totals,
                          .option = no_option };
}

/* A pool of 3 words a pixel that grows to 3 a fragment, and a head a pixel. */
static const fm_method_desc list = {
    .resources = { { .name = "heads", .extent = { .per_pixel = 1 } },
                   { .name = "nodes",
                     .extent = { .per_pixel = 3 },
                     .sizing = FM_SIZE_GROW,
                     .grown = { .per_fragment = 3 } } },
};

static void a_pool_that_grows_is_booked_as_its_first_size_at_least(void **state)
{
    (void)state;
    const uint64_t totals[FM_MAX_TOTALS] = { 0 };
    const fm_workload few = workload_of(2, totals), many = workload_of(10, totals);
    assert_int_equal(formula_bytes(&list, &few), 4 * (6 + 3 * 6));
    assert_int_equal(formula_bytes(&list, &many), 4 * (6 + 3 * 10));
}

/* What is asked for at first does not follow F, which nobody knows before a frame. */
static void a_pool_that_grows_starts_at_its_extent(void **state)
{
    (void)state;
    const uint64_t totals[FM_MAX_TOTALS] = { 0 };
    const fm_workload many = workload_of(10, totals);
    assert_int_equal(formula_buffer_bytes(&list, &list.resources[1], &many), 4 * 3 * 6);
}

static void a_pool_may_grow_to_a_total(void **state)
{
    (void)state;
    static const fm_method_desc pages = {
        .resources = { { .name = "pages",
                         .extent = { .constant = 9 },
                         .sizing = FM_SIZE_GROW,
                         .grown = { .per_total = 1, .total = "taken" } } },
        .totals = { { .name = "overflow" }, { .name = "taken" } },
    };
    const uint64_t little[FM_MAX_TOTALS] = { 0, 8 }, much[FM_MAX_TOTALS] = { 0, 45 };
    const fm_workload first = workload_of(10, little), second = workload_of(10, much);
    assert_int_equal(formula_bytes(&pages, &first), 4 * 9);
    assert_int_equal(formula_bytes(&pages, &second), 4 * 45);
}

static void a_size_beyond_64_bits_stays_the_largest_number(void **state)
{
    (void)state;
    static const fm_method_desc huge = {
        .resources = { { .name = "nodes",
                         .extent = { .constant = 1 },
                         .sizing = FM_SIZE_GROW,
                         .grown = { .per_fragment = 4096 } },
                       { .name = "heads", .extent = { .per_pixel = 1 }, .ping_pong = true } },
    };
    const uint64_t totals[FM_MAX_TOTALS] = { 0 };
    const fm_workload endless = workload_of(UINT64_MAX / 2, totals);
    assert_true(formula_bytes(&huge, &endless) == UINT64_MAX);
}

/* A copy for what is written and one for what was. */
static void ping_pong_buffers_count_twice(void **state)
{
    (void)state;
    static const fm_method_desc method = {
        .resources = { { .name = "heads", .extent = { .per_pixel = 1 }, .ping_pong = true } },
    };
    const uint64_t totals[FM_MAX_TOTALS] = { 0 };
    const fm_workload workload = workload_of(10, totals);
    assert_int_equal(formula_bytes(&method, &workload), 2 * 4 * 6);
}

static void images_have_layers_and_samples_for_each_k(void **state)
{
    (void)state;
    static const fm_resource image = { .kind = FM_RESOURCE_IMAGE,
                                       .format = FM_FORMAT_RG32F,
                                       .layers = 1,
                                       .layers_per_k = 2,
                                       .samples_per_k = 1 };
    const uint64_t totals[FM_MAX_TOTALS] = { 0 };
    const fm_workload workload = workload_of(10, totals);
    assert_int_equal(formula_layers(&image, &workload), 1 + 2 * 4);
    assert_int_equal(formula_samples(&image, &workload), 4);
    assert_int_equal(formula_image_bytes(&image, &workload), 8 * 6 * (1 + 2 * 4) * 4);
}

/* k = 4 and n = 5: as a buffer of that extent has elements of a pixel. */
static void an_extent_of_an_image_is_its_layers(void **state)
{
    (void)state;
    fm_resource image = { .kind = FM_RESOURCE_IMAGE,
                          .format = FM_FORMAT_RG32UI,
                          .extent = { .per_pixel = 1, .per_pixel_k = 2, .per_pixel_n = 3 } };
    const uint64_t totals[FM_MAX_TOTALS] = { 0 };
    const fm_workload workload = workload_of(10, totals);
    assert_int_equal(formula_layers(&image, &workload), 1 + 2 * 4 + 3 * 5);
    assert_int_equal(formula_image_bytes(&image, &workload), 8 * 6 * (1 + 2 * 4 + 3 * 5));
    image.extent = (fm_extent){ .per_pixel_k = 1, .k_step = 3 };
    assert_int_equal(formula_layers(&image, &workload), 2);
    image.extent = (fm_extent){ .per_pixel_n = 4096 };
    fm_workload endless = workload;
    endless.n = UINT32_MAX;
    assert_int_equal(formula_layers(&image, &endless), UINT32_MAX);
}

/* Whatever k is, shaders call it alike. */
static void an_image_of_layers_is_an_array_where_it_has_one(void **state)
{
    (void)state;
    const fm_resource single = { .kind = FM_RESOURCE_IMAGE, .layers = 1 };
    const fm_resource two = { .kind = FM_RESOURCE_IMAGE, .layers = 2 };
    const fm_resource by_k = { .kind = FM_RESOURCE_IMAGE, .layers_per_k = 1 };
    const fm_resource by_extent = { .kind = FM_RESOURCE_IMAGE, .extent = { .per_pixel_n = 1 } };
    assert_false(image_is_array(&single));
    assert_true(image_is_array(&two) && image_is_array(&by_k) && image_is_array(&by_extent));
}

/* 10 fragments, of which 7 are kept, in 4 layers of 6 texels. */
static void an_image_may_say_what_of_it_is_used(void **state)
{
    (void)state;
    fm_resource image = { .kind = FM_RESOURCE_IMAGE,
                          .format = FM_FORMAT_RG32UI,
                          .extent = { .per_pixel_k = 1 } };
    const uint64_t totals[FM_MAX_TOTALS] = { 0 };
    fm_workload workload = workload_of(10, totals);
    workload.fragments_kept = 7;
    assert_int_equal(formula_used_bytes(&image, &workload), 8 * 6 * 4);
    image.used.per_kept = 1;
    assert_int_equal(formula_used_bytes(&image, &workload), 8 * 7);
    image.used.per_kept = 100;
    assert_int_equal(formula_used_bytes(&image, &workload), 8 * 6 * 4);
}

/* 16-bit formats take 2 bytes a channel; R8 takes one. */
static void small_formats_take_few_bytes(void **state)
{
    (void)state;
    static const fm_resource half = { .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_RGBA16F };
    static const fm_resource byte = { .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_R8 };
    const uint64_t totals[FM_MAX_TOTALS] = { 0 };
    const fm_workload workload = workload_of(10, totals);
    assert_int_equal(formula_image_bytes(&half, &workload), 8 * 6);
    assert_int_equal(formula_image_bytes(&byte, &workload), 6);
}

static void loops_may_count_by_k_and_by_n(void **state)
{
    (void)state;
    static const fm_loop loop = { .count = 1, .count_per_k = 2, .count_per_n = 3 };
    const uint64_t totals[FM_MAX_TOTALS] = { 0 };
    const fm_workload workload = workload_of(10, totals);
    assert_true(loop_is_counted(&loop));
    assert_int_equal(formula_count(&loop, &workload), 1 + 2 * 4 + 3 * 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pool_that_grows_is_booked_as_its_first_size_at_least),
        cmocka_unit_test(a_pool_that_grows_starts_at_its_extent),
        cmocka_unit_test(a_pool_may_grow_to_a_total),
        cmocka_unit_test(a_size_beyond_64_bits_stays_the_largest_number),
        cmocka_unit_test(ping_pong_buffers_count_twice),
        cmocka_unit_test(images_have_layers_and_samples_for_each_k),
        cmocka_unit_test(an_extent_of_an_image_is_its_layers),
        cmocka_unit_test(an_image_of_layers_is_an_array_where_it_has_one),
        cmocka_unit_test(an_image_may_say_what_of_it_is_used),
        cmocka_unit_test(small_formats_take_few_bytes),
        cmocka_unit_test(loops_may_count_by_k_and_by_n),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
