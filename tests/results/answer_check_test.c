/* What is taken for a worker's answer, and what not. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "results/answer_check.h"

enum { FRAMES = 5 };

static fm_status check_text(const char *text, fm_error *err)
{
    json_t *answer = json_loads(text, JSON_DECODE_ANY, NULL);
    if (answer == NULL)
        fail_msg("no JSON: %s", text);
    const fm_status status = answer_check(answer, FRAMES, err);
    json_decref(answer);
    return status;
}

static void assert_fault(const char *text, const char *words)
{
    fm_error err = { 0 };
    const fm_status status = check_text(text, &err);
    if (status != FM_INVALID || strstr(err.message, words) == NULL)
        fail_msg("%s: %d, \"%s\" lacks \"%s\"", text, status, err.message, words);
}

static void assert_good(const char *text)
{
    fm_error err = { 0 };
    if (check_text(text, &err) != FM_OK)
        fail_msg("%s: %s", text, err.message);
}

/* Puts a part into an answer that is otherwise good. */
static void assert_part(const char *part, const char *words)
{
    char text[2048];
    snprintf(text, sizeof text, "{\"status\": \"ok\", %s}", part);
    if (words == NULL)
        assert_good(text);
    else
        assert_fault(text, words);
}

static void assert_sample(const char *frame, const char *metric, const char *value,
                          const char *unit, const char *words)
{
    char part[512];
    snprintf(part, sizeof part,
             "\"samples\": [{\"frame\": %s, \"metric\": \"%s\", \"value\": %s, \"unit\": \"%s\"}]",
             frame, metric, value, unit);
    assert_part(part, words);
}

static void answer_must_have_a_known_status(void **state)
{
    (void)state;
    assert_fault("[]", "not an object");
    assert_fault("{}", "'status'");
    assert_fault("{\"status\": \"fine\"}", "'status'");
    assert_fault("{\"status\": 3}", "'status' is not a text");
    assert_fault("{\"status\": \"skipped\"}", "contradict");
    assert_fault("{\"status\": \"ok\", \"is_runs_fault\": true}", "contradict");
    assert_good("{\"status\": \"skipped\", \"is_runs_fault\": true, \"message\": \"disk full\"}");
    assert_good("{\"status\": \"crash\", \"message\": \"killed\", \"what_comes_later\": [1]}");
}

static void a_reason_is_a_known_word_of_what_is_not_supported(void **state)
{
    (void)state;
    fm_error err = { 0 };
    static const char none[] = "{\"status\": \"not_supported\", \"message\": \"no interlock\"}";
    assert_good("{\"status\": \"not_supported\", \"reason\": \"feature\"}");
    assert_fault("{\"status\": \"not_supported\", \"reason\": 3}", "'reason' is not a text");
    assert_fault("{\"status\": \"not_supported\", \"reason\": \"featur\"}",
                 "'reason' is 'featur'; the nearest is 'feature'");
    assert_fault("{\"status\": \"ok\", \"reason\": \"loops\"}",
                 "'reason' is 'loops', and 'status' 'ok'");
    assert_fault("{\"status\": \"timeout\", \"reason\": \"loops\"}", "and 'status' 'timeout'");
    assert_good(none); /* as journals of older programs have it */
    json_t *answer = json_loads(none, 0, NULL);
    assert_int_equal(answer_check_reason(answer, &err), FM_INVALID);
    assert_string_equal(err.message,
                        "'status' is 'not_supported' without a 'reason': no interlock");
    json_object_set_new(answer, "reason", json_string("feature"));
    assert_int_equal(answer_check_reason(answer, &err), FM_OK);
    json_object_set_new(answer, "status", json_string("crash"));
    json_object_del(answer, "reason");
    assert_int_equal(answer_check_reason(answer, &err), FM_OK);
    json_decref(answer);
}

static void answer_fields_have_their_kinds(void **state)
{
    (void)state;
    assert_part("\"metrics\": []", "'metrics' is not an object");
    assert_part("\"samples\": {}", "'samples' is not a list");
    assert_part("\"launch\": []", "'launch' is not an object");
    assert_part("\"message\": 1", "'message' is not a text");
    assert_part("\"is_software\": \"yes\"", "'is_software' is not true or false");
    assert_part("\"device_name\": null", "'device_name' is not a text");
    assert_part("\"modelled\": {\"passes\": [1]}", "'passes' is not a list of names");
    assert_part("\"modelled\": {\"passes\": {}}", "'passes' is not a list");
    assert_part("\"mesh\": {\"file\": 1}", "'file' is not a text");
    assert_part("\"mesh\": {\"triangles\": -3}", "'triangles' of the mesh");
    assert_part("\"mesh\": {\"low\": [1, 2]}", "'low' of the mesh is not three numbers");
    assert_part("\"mesh\": {\"file\": \"a\", \"triangles\": 3, \"low\": [-1, 2, 0.5]}", NULL);
    assert_part("\"image_hashes\": \"aa\"", "'image_hashes' is not a list");
    assert_part("\"image_hashes\": [\"aa\"]", "16 digits");
    assert_part("\"image_hashes\": [3]", "16 digits");
    assert_part("\"image_hashes\": [\"00000000000000aG\"]", "16 digits");
    assert_part("\"image_hashes\": [\"00000000000000aa\"]", NULL);
}

static void answer_texts_have_a_limit(void **state)
{
    (void)state;
    char text[20000];
    snprintf(text, sizeof text, "{\"status\": \"ok\", \"device_name\": \"%0128d\"}", 0);
    assert_fault(text, "'device_name' is longer than 127 bytes");
    snprintf(text, sizeof text, "{\"status\": \"ok\", \"message\": \"%09000d\"}", 0);
    assert_fault(text, "'message' is longer than 8191 bytes");
    snprintf(text, sizeof text, "{\"status\": \"ok\", \"metrics\": {\"pass.%0200d_ms\": 1}}", 0);
    assert_fault(text, "is no metric");
}

static void metrics_are_known_and_in_their_range(void **state)
{
    (void)state;
    assert_part("\"metrics\": {\"n\": 4, \"rmse\": \"nan\", \"psnr_db\": \"inf\", \"ssim\": 1, "
                "\"bytes_used\": 281474976710656, \"discarded_share\": -0.5, \"vertices\": 12, "
                "\"cycles.raster\": 0.25, \"energy.dram_nj\": 1e9}",
                NULL);
    assert_part("\"metrics\": {\"speed\": 4}", "'speed' is no metric");
    assert_part("\"metrics\": {\"frame_ms\": 4}", "'frame_ms' is not a metric of a case");
    assert_part("\"metrics\": {\"n\": \"4\"}", "'n' is not a number");
    assert_part("\"metrics\": {\"n\": null}", "'n' is not a number");
    assert_part("\"metrics\": {\"n\": \"nan\"}", "'n' is nan, not a whole number");
    assert_part("\"metrics\": {\"n\": 4.5}", "'n' is 4.5, not a whole number");
    assert_part("\"metrics\": {\"missing\": -1}", "'missing' is -1, not a whole number from 0");
    assert_part("\"metrics\": {\"bytes_predicted\": -1}", "not a whole number from 0 to 2^48");
    assert_part("\"metrics\": {\"bytes_allocated\": 281474976710657}", "'bytes_allocated'");
    assert_part("\"metrics\": {\"vertices\": 9007199254740994}", "'vertices'");
    assert_part("\"metrics\": {\"rmse\": -0.1}", "'rmse' is -0.1");
    assert_part("\"metrics\": {\"redone_ms\": \"inf\"}", "'redone_ms' is inf, not a number from 0");
    assert_part("\"launch\": {\"load_end\": \"high\"}", "'load_end' is not a number");
    assert_part("\"launch\": {\"waited_s\": -1}", "'waited_s' is -1");
    assert_part("\"launch\": {\"rmse\": 1}", "'rmse' is not a metric of a launch");
    assert_part("\"launch\": {\"waited_s\": 0.5, \"involuntary_switches\": 3.0}", NULL);
}

static void samples_are_of_frames_that_there_are(void **state)
{
    (void)state;
    assert_sample("0", "frame_ms", "0.0", "ms", NULL);
    assert_sample("4", "pass.sort_ms", "3", "ms", NULL);
    assert_sample("-1", "frame_ms", "1", "ms", "a sample is of frame -1; there are 5");
    assert_sample("5", "frame_ms", "1", "ms", "a sample is of frame 5; there are 5");
    assert_sample("4294967296", "frame_ms", "1", "ms", "of frame 4294967296");
    assert_sample("0.5", "frame_ms", "1", "ms", "a sample lacks");
    assert_sample("0", "frame_ms", "\"1\"", "ms", "a sample lacks");
    assert_sample("0", "frame_ms", "-5", "ms", "'frame_ms' is -5, not a number from 0");
    assert_sample("0", "frame_ms", "1", "s", "'frame_ms' is in 's', not in 'ms'");
    assert_sample("0", "speed", "1", "", "'speed' is no metric");
    assert_sample("0", "rmse", "1", "", "'rmse' is not a metric of a frame");
    assert_part("\"samples\": [3]", "a sample lacks");
}

static void a_frame_has_a_metric_once(void **state)
{
    (void)state;
    static const char one[] = "{\"frame\": 1, \"metric\": \"frame_ms\", \"value\": 2, "
                              "\"unit\": \"ms\"}";
    static const char other[] = "{\"frame\": 0, \"metric\": \"frame_ms\", \"value\": 2, "
                                "\"unit\": \"ms\"}";
    char part[512];
    snprintf(part, sizeof part, "\"samples\": [%s, %s]", one, other);
    assert_part(part, NULL);
    snprintf(part, sizeof part, "\"samples\": [%s, %s, %s]", one, other, one);
    assert_part(part, "frame 1 has 'frame_ms' twice");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answer_must_have_a_known_status),
        cmocka_unit_test(a_reason_is_a_known_word_of_what_is_not_supported),
        cmocka_unit_test(answer_fields_have_their_kinds),
        cmocka_unit_test(answer_texts_have_a_limit),
        cmocka_unit_test(metrics_are_known_and_in_their_range),
        cmocka_unit_test(samples_are_of_frames_that_there_are),
        cmocka_unit_test(a_frame_has_a_metric_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
