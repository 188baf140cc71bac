/* How devices are looked up in a list, on devices made up for it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "device/registry.h"

/* A driver with two devices. */
static fm_status list_two(fm_device_entry *entries, size_t *count, fm_error *err)
{
    (void)err;
    assert_true(*count >= 2);
    *count = 2;
    entries[0] = (fm_device_entry){ .selector = "twin:0", .name = "Alder 1" };
    entries[1] = (fm_device_entry){ .selector = "twin:1", .name = "Birch 9" };
    return FM_OK;
}

/* What was asked for comes back in the message. */
static fm_status open_nothing(fm_device **device, const fm_device_desc *desc, fm_error *err)
{
    *device = NULL;
    return fm_fail(err, FM_UNSUPPORTED, "selector %s, validation %d",
                   desc->selector != NULL ? desc->selector : "none", desc->validation);
}

/* One whose devices cannot be told. */
static fm_status list_none(fm_device_entry *entries, size_t *count, fm_error *err)
{
    (void)entries, (void)err;
    *count = 0;
    return FM_OK;
}

static const fm_device_ops twin = { .name = "twin", .list = list_two, .open = open_nothing };
static const fm_device_ops twine = {
    .name = "twine", .feeds = FM_FEED_FRAMES, .list = list_none, .open = open_nothing
};
static const fm_device_ops *const both[] = { &twin, &twine };
static const fm_device_list two = { .devices = both, .count = 2 };

static void registry_finds_by_the_whole_word_before_the_colon(void **state)
{
    (void)state;
    assert_ptr_equal(device_find(&two, "twin"), &twin);
    assert_ptr_equal(device_find(&two, "twin:1"), &twin);
    assert_ptr_equal(device_find(&two, "twine:"), &twine);
    assert_null(device_find(&two, "twi"));
    assert_null(device_find(&two, ""));
    assert_null(device_find(&(fm_device_list){ .count = 0 }, "twin"));
}

static void registry_opens_with_the_selector_of_the_name(void **state)
{
    (void)state;
    fm_device *device = NULL;
    fm_error err = { .message = "" };
    const fm_device_desc desc = { .selector = "not read", .validation = true };
    assert_int_equal(device_open(&device, &two, "twin:bir", &desc, &err), FM_UNSUPPORTED);
    assert_string_equal(err.message, "selector bir, validation 1");
    assert_int_equal(device_open(&device, &two, "twine", &desc, &err), FM_UNSUPPORTED);
    assert_string_equal(err.message, "selector none, validation 1");
    assert_null(device);
}

static void registry_expects_an_index_or_a_part_of_a_name(void **state)
{
    (void)state;
    fm_error err = { .message = "" };
    static const char *const
        there[] = { "twin",  "twin:0", "twin:1", "twin:BIRCH",
                    "twin:", "oak:3",  "twine:5" /* nothing can be said: its list is empty */ };
    for (size_t i = 0; i < sizeof there / sizeof there[0]; i++)
        assert_int_equal(device_expect(&two, there[i], &err), FM_OK);
    assert_int_equal(device_expect(&two, "twin:9", &err), FM_INVALID); /* an index, not "Birch 9" */
    assert_string_equal(err.message, "--device twin:9: no such device; there is twin:0 'Alder 1', "
                                     "twin:1 'Birch 9'");
    assert_int_equal(device_expect(&two, "twin:elm", &err), FM_INVALID);
}

static void registry_knows_the_feeds_of_devices_that_name_none(void **state)
{
    (void)state;
    assert_int_equal(device_feeds(&twin), FM_FEEDS_FRAGMENTS | FM_FEED_TRIANGLES);
    assert_int_equal(device_feeds(&twine), FM_FEED_FRAMES);
}

static void expect_unknown(const fm_device_list *list, const char *name, const char *message)
{
    fm_device *device = NULL;
    fm_error err = { .message = "" };
    assert_int_equal(device_open(&device, list, name, &(fm_device_desc){ .selector = NULL }, &err),
                     FM_INVALID);
    assert_null(device);
    assert_string_equal(err.message, message);
}

static void registry_names_the_nearest_of_those_it_has(void **state)
{
    (void)state;
    assert_string_equal(device_nearest(&two, "twinn"), "twin"); /* as near as twine, and first */
    assert_string_equal(device_nearest(&two, "twined"), "twine");
    assert_null(device_nearest(&two, "xxxxxxxxxx"));
    expect_unknown(&two, "twinn", "no device 'twinn'; the nearest is 'twin'");
    expect_unknown(&two, "xxxxxxxxxx", "no device 'xxxxxxxxxx'; the nearest is 'twin'");
    expect_unknown(&(fm_device_list){ .count = 0 }, "twin",
                   "no device 'twin'; this program has none");
}

/* The lists of programs have no bound. */
static void registry_names_the_last_of_a_hundred(void **state)
{
    enum { COUNT = 100 };
    (void)state;
    char names[COUNT][24];
    fm_device_ops ops[COUNT];
    const fm_device_ops *devices[COUNT];
    for (int i = 0; i < COUNT; i++) {
        snprintf(names[i], sizeof names[i], "device%d", i);
        ops[i] = (fm_device_ops){ .name = names[i], .list = list_none, .open = open_nothing };
        devices[i] = &ops[i];
    }
    const fm_device_list many = { .devices = devices, .count = COUNT };
    assert_ptr_equal(device_find(&many, "device99"), &ops[99]);
    expect_unknown(&many, "devize99", "no device 'devize99'; the nearest is 'device99'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(registry_finds_by_the_whole_word_before_the_colon),
        cmocka_unit_test(registry_opens_with_the_selector_of_the_name),
        cmocka_unit_test(registry_expects_an_index_or_a_part_of_a_name),
        cmocka_unit_test(registry_knows_the_feeds_of_devices_that_name_none),
        cmocka_unit_test(registry_names_the_nearest_of_those_it_has),
        cmocka_unit_test(registry_names_the_last_of_a_hundred),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
