/* What parent and worker say to each other. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "worker/protocol.h"

static void request_comes_back_as_it_was_written(void **state)
{
    (void)state;
    char path[] = "/tmp/fragmark-request-XXXXXX";
    fm_settings settings;
    fm_read_request read = { 0 };
    const fm_choice choices[] = { { "layout", "tile" } };
    settings_default(&settings);
    settings.k = 7;
    settings.n = 9;
    static const uint64_t known[] = { 10, UINT64_MAX };
    const fm_request request = { .is_truth_job = true,
                                 .plugin = "a/a.so",
                                 .floor = "",
                                 .common = "common",
                                 .device = "vulkan:0",
                                 .feed = "raster",
                                 .settings = &settings,
                                 .choices = choices,
                                 .choice_count = 1,
                                 .truth = "t.truth",
                                 .cache = "/c",
                                 .image = "",
                                 .range = "work/7",
                                 .known_images = known,
                                 .known_count = 2,
                                 .keep = { [KEPT_FRAGMENTS] = "kept/7.fragments" },
                                 .no_timers = true,
                                 .launch = 3 };
    close(mkstemp(path));
    assert_int_equal(request_write(path, &request, NULL), FM_OK);
    assert_int_equal(request_read(&read, path, NULL), FM_OK);
    assert_true(read.request.is_truth_job && read.request.no_timers);
    assert_false(read.request.check || read.request.validation);
    assert_string_equal(read.request.plugin, "a/a.so");
    assert_string_equal(read.request.device, "vulkan:0");
    assert_int_equal(read.request.launch, 3);
    assert_string_equal(read.request.cache, "/c");
    assert_string_equal(read.request.range, "work/7");
    assert_int_equal(read.request.known_count, 2);
    assert_memory_equal(read.request.known_images, known, sizeof known);
    assert_string_equal(read.request.keep[KEPT_FRAGMENTS], "kept/7.fragments");
    assert_string_equal(read.request.keep[KEPT_TRUTH], "");
    assert_string_equal(read.request.keep[KEPT_FRAMES], "");
    assert_memory_equal(read.request.settings, &settings, sizeof settings);
    assert_int_equal(read.request.choice_count, 1);
    assert_string_equal(read.request.choices[0].value, "tile");
    request_free(&read);
    unlink(path);
}

/* However many images a case drew, its next launch can be asked for. */
static void request_with_very_many_known_images_is_read(void **state)
{
    (void)state;
    enum { KNOWN = 60000 };
    static uint64_t known[KNOWN];
    char path[] = "/tmp/fragmark-request-XXXXXX", deep[FM_PATH_MAX_BYTES];
    fm_settings settings;
    fm_read_request read = { 0 };
    fm_error err = { 0 };
    for (size_t i = 0; i < KNOWN; i++)
        known[i] = i + 1;
    memset(deep, 'x', sizeof deep - 1);
    deep[sizeof deep - 1] = '\0';
    settings_default(&settings);
    const fm_request request = { .plugin = deep,
                                 .floor = deep,
                                 .common = deep,
                                 .device = "vulkan:0",
                                 .feed = "raster",
                                 .settings = &settings,
                                 .truth = deep,
                                 .image = deep,
                                 .range = deep,
                                 .keep = { deep, deep, deep },
                                 .known_images = known,
                                 .known_count = KNOWN };
    close(mkstemp(path));
    assert_int_equal(request_write(path, &request, NULL), FM_OK);
    if (request_read(&read, path, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_in_range(read.request.known_count, 10000, KNOWN);
    assert_memory_equal(read.request.known_images, known,
                        read.request.known_count * sizeof known[0]);
    request_free(&read);
    unlink(path);
}

#define REQUEST_KNOWING(known, job, launch, check, settings, options)                              \
    "{\"protocol\": 1, \"job\": " job ", \"plugin\": \"\", \"floor\": \"\", \"common\": \"\", "    \
    "\"device\": \"\", "                                                                           \
    "\"validation\": false, \"no_timers\": false, \"feed\": \"\", \"settings\": {" settings        \
    "}, \"options\": {" options "}, \"truth\": \"\", \"cache\": \"\", \"launch\": " launch         \
    ", \"check\": " check ", \"image\": \"\", \"range\": \"\", \"known_images\": [" known          \
    "], \"keep_fragments\": \"\", \"keep_truth\": \"\", \"keep_frames\": "                         \
    "\"\"}"
#define REQUEST(job, launch, check, settings, options)                                             \
    REQUEST_KNOWING("", job, launch, check, settings, options)

static fm_status read_text(const char *text, fm_error *err)
{
    char path[] = "/tmp/fragmark-request-XXXXXX";
    fm_read_request read = { 0 };
    const int fd = mkstemp(path);
    assert_int_equal(write(fd, text, strlen(text)), strlen(text));
    close(fd);
    const fm_status status = request_read(&read, path, err);
    request_free(&read);
    unlink(path);
    return status;
}

static void request_read_refuses_what_is_no_request(void **state)
{
    (void)state;
    static const struct {
        const char *text, *words;
    } rows[] = {
        { "[", ":1: " },
        { "[]", "no request of protocol 1" },
        { "{\"job\": \"truth\"}", "no request of protocol 1" },
        { "{\"protocol\": 2, \"job\": \"truth\"}", "no request of protocol 1" },
        { "{\"protocol\": 1}", "'job' is missing" },
        { "{\"protocol\": 1, \"job\": \"truth\"}", "'plugin' is missing" },
        { REQUEST("\"sleep\"", "0", "true", "", ""), "'job' is none that is known" },
        { REQUEST("7", "0", "true", "", ""), "'job' is missing or of another kind" },
        { REQUEST("\"mesh\"", "\"0\"", "true", "", ""), "'launch' is missing or of another kind" },
        { REQUEST("\"mesh\"", "-1", "true", "", ""), "'launch' is -1" },
        { REQUEST("\"mesh\"", "4294967296", "true", "", ""), "'launch' is 4294967296" },
        { REQUEST("\"mesh\"", "0", "1", "", ""), "'check' is missing or of another kind" },
        { REQUEST("\"mesh\"", "0", "true, \"check\": false", "", ""), "duplicate" },
        { REQUEST("\"mesh\"", "0", "true", "\"colour\": \"red\"", ""), "colour" },
        { REQUEST("\"mesh\"", "0", "true", "\"k\": \"many\"", ""), "k" },
        { REQUEST("\"mesh\"", "0", "true", "", "\"layout\": 3"), "layout" },
        { REQUEST_KNOWING("7", "\"mesh\"", "0", "true", "", ""), "known_images" },
        { REQUEST_KNOWING("\"00000000000000AA\"", "\"mesh\"", "0", "true", "", ""),
          "known_images" },
        { REQUEST("\"mesh\"", "0", "true", "",
                  "\"layout\": \"0123456789012345678901234567890123456789012345678901234567890"
                  "123456789012345678901234567890123456789012345678901234567890123456789\""),
          "'layout' is too long" },
    };
    fm_error err = { 0 };
    assert_int_equal(read_text(REQUEST("\"mesh\"", "0", "true", "\"k\": \"3\"", ""), &err), FM_OK);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const fm_status status = read_text(rows[i].text, &err);
        if (status == FM_OK || strstr(err.message, rows[i].words) == NULL)
            fail_msg("row %zu: %d, '%s' lacks '%s'", i, status, err.message, rows[i].words);
    }
}

static void answer_of_the_runs_fault_gives_no_verdict(void **state)
{
    (void)state;
    json_t *answer = json_object();
    answer_set_runs_fault(answer, "disk full");
    assert_true(answer_is_runs_fault(answer));
    assert_int_equal(answer_status(answer), FM_CASE_SKIPPED);
    assert_string_equal(answer_message(answer), "disk full");
    json_decref(answer);
}

static void answer_carries_the_reason_of_a_refusal(void **state)
{
    (void)state;
    json_t *refused = answer_make(FM_CASE_NOT_SUPPORTED, FM_REASON_LOOPS, "n = 9");
    json_t *crashed = answer_make(FM_CASE_CRASH, FM_REASON_NONE, "");
    assert_int_equal(answer_reason(refused), FM_REASON_LOOPS);
    assert_string_equal(json_string_value(json_object_get(refused, "reason")), "loops");
    assert_int_equal(answer_reason(crashed), FM_REASON_NONE);
    assert_null(json_object_get(crashed, "reason"));
    json_decref(refused);
    json_decref(crashed);
}

static void answer_takes_messages_of_any_bytes(void **state)
{
    (void)state;
    json_t *answer = answer_make(FM_CASE_CRASH, FM_REASON_NONE, "caf\xE9");
    assert_non_null(answer);
    assert_string_equal(answer_message(answer), "caf?");
    json_decref(answer);
}

/* As long as an answer's may be, since a journal with a longer one would be refused. */
static void answer_notes_stay_within_the_limit(void **state)
{
    (void)state;
    static char longest[FM_MESSAGE_MAX_BYTES + 10];
    memset(longest, 'x', sizeof longest - 1);
    json_t *answer = answer_make(FM_CASE_CRASH, FM_REASON_NONE, longest + 9);
    assert_int_equal(strlen(answer_message(answer)), FM_MESSAGE_MAX_BYTES);
    answer_add_note(answer, "and so");
    assert_int_equal(strlen(answer_message(answer)), FM_MESSAGE_MAX_BYTES);
    assert_string_equal(answer_message(answer) + FM_MESSAGE_MAX_BYTES - 9, "x; and so");
    answer_add_note(answer, longest);
    assert_int_equal(strlen(answer_message(answer)), FM_MESSAGE_MAX_BYTES);
    json_decref(answer);
}

static void answer_samples_carry_the_unit_of_their_metric(void **state)
{
    (void)state;
    json_t *samples = json_array();
    answer_add_sample_named(samples, 2, "store_ms", 1.5);
    answer_add_sample_named(samples, 2, "pass.sort_ms", 0.5);
    const fm_answer_sample store = answer_sample(json_array_get(samples, 0));
    const fm_answer_sample sort = answer_sample(json_array_get(samples, 1));
    assert_int_equal(store.frame, 2);
    assert_string_equal(store.metric, "store_ms");
    assert_true(store.value == 1.5);
    assert_string_equal(store.unit, "ms");
    assert_string_equal(sort.unit, "ms");
    json_decref(samples);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(request_comes_back_as_it_was_written),
        cmocka_unit_test(request_with_very_many_known_images_is_read),
        cmocka_unit_test(request_read_refuses_what_is_no_request),
        cmocka_unit_test(answer_of_the_runs_fault_gives_no_verdict),
        cmocka_unit_test(answer_carries_the_reason_of_a_refusal),
        cmocka_unit_test(answer_takes_messages_of_any_bytes),
        cmocka_unit_test(answer_notes_stay_within_the_limit),
        cmocka_unit_test(answer_samples_carry_the_unit_of_their_metric),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
