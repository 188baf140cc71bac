/* What a calibration says, and where it lies. */
#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "ab/noise.h"
#include "base/text.h"
#include "model/hardware.h"

static const fm_machine here = { .cpu = "a processor", .cores = 2, .memory_bytes = 1000 };

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

/* An effect of the band itself is below it in half of the gates. */
static void quiet_pairs_can_detect_little_more_than_the_band_and_raise_no_alarm(void **state)
{
    (void)state;
    double differences[60];
    ab_noise noise;
    fill(differences);
    assert_int_equal(calibrate(&noise, differences, 60, NULL), FM_OK);
    assert_int_equal(noise.pairs, 60);
    assert_int_equal(noise.planned, 20);
    assert_true(noise.statistics[AB_CPU].detectable >= log1p(0.02));
    assert_true(noise.statistics[AB_CPU].detectable < log1p(0.025));
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

static void keep_case(ab_noise_list *list, const char *measured, double cpu, double time)
{
    ab_noise noise = { .device_name = "one", .pairs = 60, .planned = 20 };
    snprintf(noise.measured, sizeof noise.measured, "%s", measured);
    noise.statistics[AB_CPU].detectable = cpu;
    noise.statistics[AB_TIME].detectable = time;
    noise.statistics[AB_TIME].standard_error = time / 10.0;
    assert_int_equal(noise_keep_noisiest(list, &noise, NULL), FM_OK);
}

/* By processor time, which decides; by time where there is no other. */
static void noisiest_case_of_a_device_is_kept(void **state)
{
    (void)state;
    ab_noise_list list = { 0 };
    keep_case(&list, "quiet", 0.02, 0.5);
    keep_case(&list, "noisy", 0.03, 0.1);
    keep_case(&list, "between", 0.025, 0.9);
    assert_int_equal(list.count, 1);
    assert_string_equal(list.items[0].measured, "noisy");
    noise_free(&list);
    keep_case(&list, "noisy", 0.0, 0.2);
    keep_case(&list, "quiet", 0.0, 0.1);
    assert_string_equal(list.items[0].measured, "noisy");
    noise_free(&list);
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
    other.memory_bytes = 1100; /* 10 % more */
    open_file(&file);
    keep_device(&list, "one", 0.5);
    assert_int_equal(noise_write(file.path, &list, &here, NULL), FM_OK);
    assert_int_equal(noise_read(&read, file.path, &other, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "another machine"));
    assert_int_equal(read.count, 0);
    noise_free(&list);
    close_file(&file);
}

/* As kernels count it from boot to boot. */
static void machine_with_a_little_other_memory_is_the_same(void **state)
{
    (void)state;
    kept_file file;
    ab_noise_list list = { 0 }, read;
    fm_machine later = here;
    char folder[128], path[FM_PATH_MAX_BYTES];
    later.memory_bytes = 985;
    open_file(&file);
    snprintf(folder, sizeof folder, "%s/deep", file.folder);
    keep_device(&list, "one", 0.5);
    assert_int_equal(noise_write(file.path, &list, &here, NULL), FM_OK);
    assert_int_equal(noise_find(path, folder, &later, NULL), FM_OK);
    assert_string_equal(path, file.path); /* whatever its name */
    assert_int_equal(noise_read(&read, path, &later, NULL), FM_OK);
    assert_int_equal(read.count, 1);
    noise_free(&read);
    noise_free(&list);
    close_file(&file);
}

/* Of two that an older version kept apart. */
static void file_that_was_written_last_is_found(void **state)
{
    (void)state;
    static const struct timespec times[][2] = { { { 2000, 0 }, { 2000, 0 } },
                                                { { 3000, 0 }, { 3000, 0 } } };
    kept_file file;
    ab_noise_list list = { 0 };
    fm_machine later = here;
    char folder[128], other[160], path[FM_PATH_MAX_BYTES];
    later.memory_bytes = 985;
    open_file(&file);
    snprintf(folder, sizeof folder, "%s/deep", file.folder);
    snprintf(other, sizeof other, "%s/a.json", folder);
    assert_int_equal(noise_write(file.path, &list, &here, NULL), FM_OK);
    assert_int_equal(noise_write(other, &list, &later, NULL), FM_OK);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(utimensat(AT_FDCWD, other, times[i], 0), 0);
        assert_int_equal(utimensat(AT_FDCWD, file.path, times[1 - i], 0), 0);
        assert_int_equal(noise_find(path, folder, &here, NULL), FM_OK);
        assert_string_equal(path, i == 0 ? file.path : other);
    }
    assert_int_equal(unlink(other), 0);
    close_file(&file);
}

/* With a hash of the exact memory, as files had it at first. */
static void old_file_is_read(void **state)
{
    (void)state;
    static const char text[] = "{\"schema\": 1, \"fingerprint\": \"0123456789abcdef\","
                               " \"cpu\": \"a processor\", \"cores\": 2, \"memory_bytes\": 990,"
                               " \"devices\": []}";
    kept_file file;
    ab_noise_list read;
    char folder[128], path[FM_PATH_MAX_BYTES];
    open_file(&file);
    snprintf(folder, sizeof folder, "%s/deep", file.folder);
    assert_int_equal(path_make_folders(folder, NULL), FM_OK);
    write_file(&file, text);
    assert_int_equal(noise_find(path, folder, &here, NULL), FM_OK);
    assert_string_equal(path, file.path);
    assert_int_equal(noise_read(&read, path, &here, NULL), FM_OK);
    close_file(&file);
}

static void file_of_nobody_knows_which_machine_is_refused(void **state)
{
    (void)state;
    static const char *const texts[] = { "{", "{\"schema\": 1, \"devices\": []}" };
    kept_file file;
    char folder[128], path[FM_PATH_MAX_BYTES];
    open_file(&file);
    snprintf(folder, sizeof folder, "%s/deep", file.folder);
    assert_int_equal(path_make_folders(folder, NULL), FM_OK);
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        fm_error err = { 0 };
        write_file(&file, texts[i]);
        assert_int_equal(noise_find(path, folder, &here, &err), FM_INVALID);
        assert_non_null(strstr(err.message, file.path));
    }
    close_file(&file);
}

static void damaged_files_are_refused_with_their_name(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "",
        "{",
        "[]",
        "{\"schema\":2,\"cpu\":\"a processor\",\"cores\":2,\"memory_bytes\":1000,\"devices\":[]}",
        "{\"schema\":1,\"cpu\":7,\"cores\":2,\"memory_bytes\":1000,\"devices\":[]}",
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
    char folder[FM_PATH_MAX_BYTES], path[FM_PATH_MAX_BYTES], expected[128];
    char fingerprint[FM_FINGERPRINT_BYTES];
    hardware_fingerprint(fingerprint, &(fm_hardware){ "a processor", "2", 1000.0 });
    setenv("XDG_STATE_HOME", "/fragmark-has-no-such-folder", 1);
    snprintf(expected, sizeof expected, "/fragmark-has-no-such-folder/fragmark/calibration/%s.json",
             fingerprint);
    assert_int_equal(noise_folder(folder, NULL), FM_OK);
    assert_int_equal(noise_find(path, folder, &here, NULL), FM_OK);
    assert_string_equal(path, expected);
    unsetenv("XDG_STATE_HOME");
    setenv("HOME", "/home/me", 1);
    assert_int_equal(noise_folder(folder, NULL), FM_OK);
    assert_string_equal(folder, "/home/me/.local/state/fragmark/calibration");
    unsetenv("HOME");
    assert_int_equal(noise_folder(folder, NULL), FM_INVALID);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quiet_pairs_can_detect_little_more_than_the_band_and_raise_no_alarm),
        cmocka_unit_test(noisy_pairs_can_detect_less_and_more_of_them_more),
        cmocka_unit_test(pairs_that_lean_to_a_side_are_an_alarm),
        cmocka_unit_test(too_few_pairs_are_refused),
        cmocka_unit_test(file_keeps_what_was_written),
        cmocka_unit_test(noisiest_case_of_a_device_is_kept),
        cmocka_unit_test(missing_file_is_no_calibration),
        cmocka_unit_test(file_of_another_machine_is_refused),
        cmocka_unit_test(machine_with_a_little_other_memory_is_the_same),
        cmocka_unit_test(file_that_was_written_last_is_found),
        cmocka_unit_test(old_file_is_read),
        cmocka_unit_test(file_of_nobody_knows_which_machine_is_refused),
        cmocka_unit_test(damaged_files_are_refused_with_their_name),
        cmocka_unit_test(device_that_cannot_be_is_refused),
        cmocka_unit_test(path_is_in_the_state_folder_and_names_the_machine),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
