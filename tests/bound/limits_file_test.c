/* The file of what devices can do: read back as written, and refused where it is damaged. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/text.h"
#include "bound/limits.h"

typedef struct place {
    char folder[FM_PATH_MAX_BYTES], path[FM_PATH_MAX_BYTES];
} place;

static int begin(void **state)
{
    place *made = calloc(1, sizeof *made);
    if (made == NULL || path_make_temporary(made->folder, "fm-limits", NULL) != FM_OK ||
        path_join(made->path, made->folder, "devices.json", NULL) != FM_OK)
        return 1;
    *state = made;
    return 0;
}

static int end(void **state)
{
    place *made = *state;
    unlink(made->path);
    rmdir(made->folder);
    free(made);
    return 0;
}

static fm_device_limits device(const char *name, double copy)
{
    fm_device_limits limits = { .key = { .driver = "driver 1", .cpu = "a cpu", .cores = 2 } };
    snprintf(limits.key.device_name, sizeof limits.key.device_name, "%s", name);
    for (int i = 0; i < FM_LIMIT_COUNT; i++)
        limits.values[i] = (fm_interval){ NAN, NAN, NAN };
    limits.values[FM_LIMIT_COPY] = (fm_interval){ copy, copy * 0.9, copy * 1.1 };
    limits.values[FM_LIMIT_TIMER] = (fm_interval){ 12.0, NAN, NAN };
    return limits;
}

static void a_file_is_read_as_it_was_written(void **state)
{
    const place *at = *state;
    fm_limits_list written = { 0 }, read = { 0 };
    const fm_device_limits first = device("one", 1e9), second = device("two", 2e9);
    const fm_device_limits again = device("one", 3e9);
    assert_int_equal(limits_keep(&written, &first, NULL), FM_OK);
    assert_int_equal(limits_keep(&written, &second, NULL), FM_OK);
    assert_int_equal(limits_keep(&written, &again, NULL), FM_OK); /* takes the first's place */
    assert_int_equal(limits_write(at->path, &written, NULL), FM_OK);
    assert_int_equal(limits_read(&read, at->path, NULL), FM_OK);
    assert_int_equal(read.count, 2);
    const fm_device_limits *found = limits_find(&read, &first.key);
    assert_non_null(found);
    assert_true(found->values[FM_LIMIT_COPY].median == 3e9);
    assert_true(found->values[FM_LIMIT_COPY].low == 3e9 * 0.9);
    assert_true(found->values[FM_LIMIT_TIMER].median == 12.0);
    assert_false(interval_is_known(&found->values[FM_LIMIT_TIMER]));
    assert_true(isnan(found->values[FM_LIMIT_RASTER].median));
    limits_free(&written);
    limits_free(&read);
}

static void another_driver_or_machine_is_another_device(void **state)
{
    fm_limits_list list = { 0 };
    const fm_device_limits one = device("one", 1e9);
    (void)state;
    assert_int_equal(limits_keep(&list, &one, NULL), FM_OK);
    fm_limits_key key = one.key;
    assert_non_null(limits_find(&list, &key));
    key.cores = 4;
    assert_null(limits_find(&list, &key));
    key = one.key;
    snprintf(key.driver, sizeof key.driver, "driver 2");
    assert_null(limits_find(&list, &key));
    key = one.key;
    snprintf(key.cpu, sizeof key.cpu, "another cpu");
    assert_null(limits_find(&list, &key));
    limits_free(&list);
}

static void a_file_that_is_not_there_has_no_device(void **state)
{
    const place *at = *state;
    fm_limits_list list = { 0 };
    assert_int_equal(limits_read(&list, at->path, NULL), FM_OK);
    assert_int_equal(list.count, 0);
}

#define ONE "{\"device_name\":\"one\",\"driver\":\"d\",\"cpu\":\"c\",\"cores\":2,\"limits\":"

static void damaged_files_are_refused_with_what_is_wrong(void **state)
{
    static const struct {
        const char *text, *says;
    } files[] = {
        { "", "devices.json:" },
        { "{\"schema\":1,", "devices.json:1:" },
        { "[]", "no limits that this program knows" },
        { "{\"schema\":2,\"devices\":[]}", "no limits that this program knows" },
        { "{\"schema\":1,\"devices\":{}}", "no limits that this program knows" },
        { "{\"schema\":1,\"devices\":[7]}", "device 1" },
        { "{\"schema\":1,\"devices\":[{\"device_name\":\"one\"}]}", "device 1" },
        { "{\"schema\":1,\"devices\":[" ONE "7}]}", "device 1" },
        { "{\"schema\":1,\"devices\":[" ONE "{}}," ONE "{\"copy\":7}}]}", "device 2" },
        { "{\"schema\":1,\"devices\":[" ONE "{\"copy\":[]}}]}", "device 1" },
        { "{\"schema\":1,\"devices\":[" ONE "{\"copy\":[0]}}]}", "device 1" },
        { "{\"schema\":1,\"devices\":[" ONE "{\"copy\":[-1]}}]}", "device 1" },
        { "{\"schema\":1,\"devices\":[" ONE "{\"copy\":[\"1\"]}}]}", "device 1" },
        { "{\"schema\":1,\"devices\":[" ONE "{\"copy\":[1,2]}}]}", "device 1" },
        { "{\"schema\":1,\"devices\":[" ONE "{\"copy\":[1,2,3]}}]}", "device 1" },
    };
    const place *at = *state;
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        fm_limits_list list = { 0 };
        fm_error err = { .message = "" };
        assert_int_equal(text_write_file(at->path, files[i].text, strlen(files[i].text), NULL),
                         FM_OK);
        if (limits_read(&list, at->path, &err) != FM_INVALID || list.count != 0)
            fail_msg("file %zu was read", i);
        if (strstr(err.message, files[i].says) == NULL)
            fail_msg("file %zu: %s", i, err.message);
    }
}

static void a_device_without_values_is_read(void **state)
{
    static const char text[] = "{\"schema\":1,\"devices\":[" ONE "{}}]}";
    const place *at = *state;
    fm_limits_list list = { 0 };
    assert_int_equal(text_write_file(at->path, text, strlen(text), NULL), FM_OK);
    assert_int_equal(limits_read(&list, at->path, NULL), FM_OK);
    assert_int_equal(list.count, 1);
    limits_free(&list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_file_is_read_as_it_was_written, begin, end),
        cmocka_unit_test(another_driver_or_machine_is_another_device),
        cmocka_unit_test_setup_teardown(a_file_that_is_not_there_has_no_device, begin, end),
        cmocka_unit_test_setup_teardown(damaged_files_are_refused_with_what_is_wrong, begin, end),
        cmocka_unit_test_setup_teardown(a_device_without_values_is_read, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
