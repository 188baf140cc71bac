/* What a calibration says, and where it lies. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "ab/noise.h"
#include "base/text.h"

static const fm_machine here = { .cpu = "a processor", .cores = 2, .memory_bytes = 8 };

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.17g is not %.17g", value, expected);
}

/* 60 differences of -1 % to 1 %, of which no 20 in a row lean to a side. */
static void fill(double differences[60])
{
    for (int i = 0; i < 60; i++)
        differences[i] = (i % 2 == 0 ? 0.01 : -0.01) * (double)(i / 2 % 10 + 1) / 10.0;
}

static fm_status calibrate(ab_noise *noise, const double *cpu, size_t count, fm_error *err)
{
    const double *const differences[AB_STATISTIC_COUNT] = { [AB_CPU] = cpu };
    ab_policy policy;
    *noise = (ab_noise){ .pairs = 0 };
    assert_int_equal(ab_policy_make(&policy, NULL, NULL), FM_OK);
    return noise_of_pairs(noise, differences, count, &policy, err);
}

static void quiet_pairs_can_detect_the_band_and_raise_no_alarm(void **state)
{
    (void)state;
    double differences[60];
    ab_noise noise;
    fill(differences);
    assert_int_equal(calibrate(&noise, differences, 60, NULL), FM_OK);
    assert_int_equal(noise.pairs, 60);
    assert_int_equal(noise.planned, 20);
    assert_near(noise.statistics[AB_CPU].detectable, log1p(0.02), 1e-12);
    assert_int_equal(noise.statistics[AB_CPU].gates, 3);
    assert_int_equal(noise.statistics[AB_CPU].alarms, 0);
    assert_near(noise.statistics[AB_CPU].deviation, 0.01 * sqrt(0.385 * 60.0 / 59.0), 1e-12);
    assert_near(noise.statistics[AB_TIME].detectable, 0.0, 0.0); /* not measured */
}

/* 20 steps from -10 % to 10 %. The median of 20 that are evenly spread from -0.1 to 0.1 has a
 * standard error of 0.1 / sqrt(22) = 0.0213, here somewhat more; Hodges and Lehmann's estimate has
 * less. */
static void noisy_pairs_can_detect_less_and_more_of_them_more(void **state)
{
    (void)state;
    double differences[60];
    ab_noise noise;
    fill(differences);
    for (int i = 0; i < 60; i++)
        differences[i] *= 10.0;
    assert_int_equal(calibrate(&noise, differences, 60, NULL), FM_OK);
    assert_near(noise.statistics[AB_CPU].standard_error, 0.0240, 0.0027);
    assert_true(noise.statistics[AB_CPU].detectable > 0.03);
    assert_true(noise.statistics[AB_CPU].detectable < 0.1);
    assert_true(noise.statistics[AB_CPU].detectable <= noise.statistics[AB_CPU].detectable_first);
}

static void pairs_that_lean_to_a_side_are_an_alarm(void **state)
{
    (void)state;
    double differences[60];
    ab_noise noise;
    fill(differences);
    for (int i = 20; i < 40; i++)
        differences[i] += 0.5;
    assert_int_equal(calibrate(&noise, differences, 60, NULL), FM_OK);
    assert_int_equal(noise.statistics[AB_CPU].gates, 3);
    assert_int_equal(noise.statistics[AB_CPU].alarms, 1);
}

static void too_few_pairs_are_refused(void **state)
{
    (void)state;
    double differences[60];
    ab_noise noise;
    fm_error err = { 0 };
    fill(differences);
    differences[4] = NAN;
    assert_int_equal(calibrate(&noise, differences, 20, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "19 pairs"));
}

/* A file in a folder that is not there yet, both of which go away. */
typedef struct kept_file {
    char folder[64], path[128];
} kept_file;

static void open_file(kept_file *of)
{
    *of = (kept_file){ .folder = "/tmp/fragmark-noise-XXXXXX" };
    assert_non_null(mkdtemp(of->folder));
    snprintf(of->path, sizeof of->path, "%s/deep/machine.json", of->folder);
}

static void close_file(kept_file *of)
{
    unlink(of->path);
    *strrchr(of->path, '/') = '\0';
    rmdir(of->path);
    assert_int_equal(rmdir(of->folder), 0);
}

static void write_file(const kept_file *of, const char *text)
{
    assert_int_equal(text_write_file(of->path, text, strlen(text), NULL), FM_OK);
}

static void keep_device(ab_noise_list *list, const char *device, double standard_error)
{
    ab_noise noise = { .measured = "kb", .pairs = 60, .planned = 20 };
    snprintf(noise.device_name, sizeof noise.device_name, "%s", device);
    noise.statistics[AB_CPU] = (ab_noise_statistic){ .deviation = 0.02,
                                                     .standard_error = standard_error,
                                                     .detectable = 0.1,
                                                     .detectable_first = 0.2,
                                                     .gates = 3,
                                                     .alarms = 1 };
    assert_int_equal(noise_keep(list, &noise, NULL), FM_OK);
}

static void file_keeps_what_was_written(void **state)
{
    (void)state;
    kept_file file;
    ab_noise_list list = { 0 }, read = { 0 };
    static const uint32_t eighty[] = { 80, 0 };
    ab_policy usual, eighty_pairs;
    assert_int_equal(ab_policy_make(&usual, NULL, NULL), FM_OK);
    assert_int_equal(ab_policy_make(&eighty_pairs, eighty, NULL), FM_OK);
    open_file(&file);
    keep_device(&list, "one", 0.5);
    keep_device(&list, "two", 0.004);
    keep_device(&list, "one", 0.003); /* in its place */
    assert_int_equal(noise_write(file.path, &list, &here, NULL), FM_OK);
    assert_int_equal(noise_read(&read, file.path, &here, NULL), FM_OK);
    assert_int_equal(read.count, 2);
    assert_near(noise_least(&read, "one", AB_CPU, &usual), 0.009, 1e-15);
    assert_near(noise_least(&read, "two", AB_CPU, &eighty_pairs), 0.006, 1e-15);
    assert_near(noise_least(&read, "one", AB_TIME, &usual), 0.0, 0.0); /* not measured */
    assert_near(noise_least(&read, "three", AB_CPU, &usual), 0.0, 0.0);
    assert_int_equal(read.items[0].statistics[AB_CPU].alarms, 1);
    noise_free(&list);
    noise_free(&read);
    close_file(&file);
}

static void missing_file_is_no_calibration(void **state)
{
    (void)state;
    ab_noise_list list;
    assert_int_equal(noise_read(&list, "/tmp/fragmark/there/is/none.json", &here, NULL), FM_OK);
    assert_int_equal(list.count, 0);
}

static void file_of_another_machine_is_refused(void **state)
{
    (void)state;
    kept_file file;
    ab_noise_list list = { 0 }, read;
    fm_error err = { 0 };
    fm_machine other = here;
    other.cores = 4;
    open_file(&file);
    keep_device(&list, "one", 0.5);
    assert_int_equal(noise_write(file.path, &list, &here, NULL), FM_OK);
    assert_int_equal(noise_read(&read, file.path, &other, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "another machine"));
    assert_int_equal(read.count, 0);
    noise_free(&list);
    close_file(&file);
}

static void damaged_files_are_refused_with_their_name(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "",
        "{",
        "[]",
        "{\"schema\":2,\"fingerprint\":\"\",\"devices\":[]}",
        "{\"schema\":1,\"fingerprint\":7,\"devices\":[]}",
    };
    kept_file file;
    ab_noise_list list = { 0 }, read;
    open_file(&file);
    assert_int_equal(noise_write(file.path, &list, &here, NULL), FM_OK);
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        fm_error err = { 0 };
        write_file(&file, texts[i]);
        assert_int_equal(noise_read(&read, file.path, &here, &err), FM_INVALID);
        assert_non_null(strstr(err.message, file.path));
    }
    close_file(&file);
}

static void device_that_cannot_be_is_refused(void **state)
{
    (void)state;
    kept_file file;
    ab_noise_list list = { 0 }, read;
    fm_error err = { 0 };
    char *bytes = NULL, *at;
    size_t count;
    open_file(&file);
    keep_device(&list, "one", 0.5);
    assert_int_equal(noise_write(file.path, &list, &here, NULL), FM_OK);
    assert_int_equal(text_read_file(&bytes, &count, file.path, 1 << 16, NULL), FM_OK);
    at = strstr(bytes, "\"alarms\": 1");
    assert_non_null(at);
    at[strlen("\"alarms\": ")] = '4'; /* of 3 gates */
    write_file(&file, bytes);
    assert_int_equal(noise_read(&read, file.path, &here, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "device 1"));
    free(bytes);
    noise_free(&list);
    close_file(&file);
}

static void path_is_in_the_state_folder_and_names_the_machine(void **state)
{
    (void)state;
    char path[FM_PATH_MAX_BYTES], digits[17], expected[128];
    noise_fingerprint(digits, &here);
    setenv("XDG_STATE_HOME", "/state", 1);
    snprintf(expected, sizeof expected, "/state/fragmark/calibration/%s.json", digits);
    assert_int_equal(noise_path(path, &here, NULL), FM_OK);
    assert_string_equal(path, expected);
    unsetenv("XDG_STATE_HOME");
    setenv("HOME", "/home/me", 1);
    snprintf(expected, sizeof expected, "/home/me/.local/state/fragmark/calibration/%s.json",
             digits);
    assert_int_equal(noise_path(path, &here, NULL), FM_OK);
    assert_string_equal(path, expected);
    unsetenv("HOME");
    assert_int_equal(noise_path(path, &here, NULL), FM_INVALID);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quiet_pairs_can_detect_the_band_and_raise_no_alarm),
        cmocka_unit_test(noisy_pairs_can_detect_less_and_more_of_them_more),
        cmocka_unit_test(pairs_that_lean_to_a_side_are_an_alarm),
        cmocka_unit_test(too_few_pairs_are_refused),
        cmocka_unit_test(file_keeps_what_was_written),
        cmocka_unit_test(missing_file_is_no_calibration),
        cmocka_unit_test(file_of_another_machine_is_refused),
        cmocka_unit_test(damaged_files_are_refused_with_their_name),
        cmocka_unit_test(device_that_cannot_be_is_refused),
        cmocka_unit_test(path_is_in_the_state_folder_and_names_the_machine),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
