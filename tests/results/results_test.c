#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>

#include "base/csv.h"
#include "kit/fake_plan.h"
#include "results/results.h"

static const char *const only_kb[] = { "kb", NULL };

/* {"status": "ok", samples of frames 0, 1, ...}; store_ms[i] < 0 ends them. */
static json_t *result_of(const double *store_ms, const double *canary_ns)
{
    json_t *samples = json_array();
    for (int i = 0; store_ms[i] >= 0.0; i++) {
        const struct {
            const char *metric, *unit;
            double value;
        } all[] = { { "frame_ms", "ms", 2.0 * store_ms[i] }, { "store_ms", "ms", store_ms[i] },
                    { "floor_store_ms", "ms", 0.5 },         { "floor_frame_ms", "ms", 2.0 },
                    { "pass.sort_ms", "ms", 0.25 },          { "canary_ns", "ns", canary_ns[i] } };
        for (size_t j = 0; j < sizeof all / sizeof all[0]; j++)
            json_array_append_new(samples, json_pack("{s:i, s:s, s:f, s:s}", "frame", i, "metric",
                                                     all[j].metric, "value", all[j].value, "unit",
                                                     all[j].unit));
    }
    return json_pack("{s:s, s:s, s:s, s:b, s:[s], s:{s:I, s:s, s:I, s:I}, s:o}", "status", "ok",
                     "message", "", "device_name", "card, \"big\"", "has_gpu_clock", 1,
                     "image_hashes", "00000000000000aa", "metrics", "fragments_generated",
                     (json_int_t)1000, "psnr_db", "inf", "n", (json_int_t)4, "wrong_pixels",
                     (json_int_t)3, "samples", samples);
}

static fm_results *created(fake_plan *fake, uint32_t launches)
{
    fm_results *results = NULL;
    fm_error err = { 0 };
    fake_open(fake, only_kb, launches);
    if (results_create(&results, &fake->plan, &fake->list, fake->folder, "run", &err) != FM_OK ||
        results_keep_replayed(results, &err) != FM_OK)
        fail_msg("%s", err.message);
    return results;
}

static void add(fm_results *results, uint32_t launch, const double *store_ms,
                const double *canary_ns)
{
    fm_error err = { 0 };
    json_t *result = result_of(store_ms, canary_ns);
    if (results_add(results, 0, launch, result, &err) != FM_OK)
        fail_msg("%s", err.message);
    json_decref(result);
}

/* The field of the only row under this name; the row must hold no quoted field before it. */
static void field_of(char field[256], const fm_results *results, const char *name)
{
    fm_text header = { 0 }, row = { 0 };
    summary_header(&header);
    summary_row(&row, results, 0);
    const char *names = header.bytes, *values = row.bytes;
    for (;;) {
        const size_t name_length = strcspn(names, ",\n");
        size_t value_length = 0;
        for (bool quoted = false;
             values[value_length] != '\0' &&
             (quoted || (values[value_length] != ',' && values[value_length] != '\n'));
             value_length++)
            quoted ^= values[value_length] == '"';
        snprintf(field, 256, "%.*s", (int)value_length, values);
        if (strlen(name) == name_length && strncmp(names, name, name_length) == 0)
            break;
        assert_int_equal(names[name_length], ',');
        assert_int_equal(values[value_length], ',');
        names += name_length + 1;
        values += value_length + 1;
    }
    text_free(&header);
    text_free(&row);
}

static void assert_field(const fm_results *results, const char *name, const char *expected)
{
    char field[256];
    field_of(field, results, name);
    assert_string_equal(field, expected);
}

static void csv_quotes_as_rfc_4180_says(void **state)
{
    (void)state;
    fm_text text = { 0 };
    csv_add(&text, "plain text");
    csv_add(&text, "a,b");
    csv_add(&text, "say \"no\"");
    csv_add(&text, "two\nlines");
    assert_string_equal(text.bytes, "plain text\"a,b\"\"say \"\"no\"\"\"\"two\nlines\"");
    text_free(&text);
}

static void summary_has_the_columns_of_the_design_in_order(void **state)
{
    (void)state;
    fm_text header = { 0 };
    summary_header(&header);
    assert_string_equal(
        header.bytes,
        "schema,case_id,status,message,method,method_version,device,device_name,feed,scene,"
        "width_px,height_px,n,k,r,pixel_density,fragment_probability,tessellation,order,seed,"
        "options,launches,samples,frame_ms,frame_ms_low,frame_ms_high,clear_ms,count_ms,"
        "reference_ms,store_ms,resolve_ms,times_floor,bytes_allocated,bytes_predicted,bytes_used,"
        "fragments_generated,fragments_stored,fragments_lost,missing,extra,misordered,"
        "depth_ulp_max,rmse,psnr_db,max_abs,ssim,flip,truncation_rmse,distinct_images,"
        "frame_wall_ms,fragments_per_s,tied_pixels,wrong_tiles,clear_ms_low,clear_ms_high,count_ms_"
        "low,count_ms_high,"
        "reference_ms_low,reference_ms_high,store_ms_low,store_ms_high,resolve_ms_low,"
        "resolve_ms_high,times_floor_low,times_floor_high,frame_wall_ms_low,frame_wall_ms_high,"
        "fragments_per_s_low,fragments_per_s_high,noisy,"
        "code_program,code_driver,code_plugin,code_shaders,"
        "covered_rmse,covered_psnr_db,covered_max_abs,covered_ssim,flip_median,flip_p95,flip_max,"
        "covered_flip,covered_flip_median,covered_flip_p95,covered_flip_max,"
        "total_rmse,total_max_abs,total_ssim,total_flip,fragments_wanted,declared_ties,"
        "declared_at_one,lost_ties,lost_at_one,self_max_abs,self_beyond,"
        "frames_drawn,frames_rmse_max,frames_max_abs,frames_total_rmse_max,captured_frames,"
        "distinct_fragments,missing_max,reason,bytes_moved,atomics,bound_ms,bound_ms_low,"
        "bound_ms_high,times_bound,times_bound_low,times_bound_high,limited_by,device_bytes_per_s,"
        "device_atomics_per_s,device_fragments_per_s\n");
    text_free(&header);
}

static fm_results *with_two_launches(fake_plan *fake)
{
    fm_results *results = created(fake, 2);
    const double first[] = { 1.0, 2.0, 3.0, -1 }, second[] = { 3.0, 4.0, 5.0, -1 };
    const double steady[] = { 10, 10, 10 };
    add(results, 0, first, steady);
    add(results, 1, second, steady);
    return results;
}

static void summary_row_holds_medians_ratios_and_rates(void **state)
{
    (void)state;
    fake_plan fake;
    fm_results *results = with_two_launches(&fake);
    assert_field(results, "schema", "1");
    assert_field(results, "device_name", "\"card, \"\"big\"\"\"");
    assert_field(results, "store_ms", "3");
    assert_field(results, "frame_ms", "6");
    assert_field(results, "times_floor", "6"); /* median of 2/0.5 and 4/0.5 */
    assert_field(results, "fragments_per_s", "166666.667");
    assert_field(results, "samples", "6");
    assert_field(results, "launches", "2");
    assert_field(results, "distinct_images", "1");
    assert_field(results, "psnr_db", "inf");
    assert_field(results, "clear_ms", "");
    assert_field(results, "method_version", "7");
    assert_true(results_is_finished(results, 0));
    results_destroy(results);
    fake_close(&fake);
}

static void add_with_error(fm_results *results, uint32_t launch, json_t *rmse)
{
    const double store_ms[] = { 1.0, -1 }, canary_ns[] = { 10 };
    json_t *result = result_of(store_ms, canary_ns);
    json_t *numbers = json_object();
    if (rmse != NULL)
        json_object_set_new(numbers, "frames_rmse_max", rmse);
    json_object_set_new(result, "launch", numbers);
    assert_int_equal(results_add(results, 0, launch, result, NULL), FM_OK);
    json_decref(result);
}

/* A launch that drew nothing new says nothing; what is no number travels as a text. */
static void worst_frame_is_that_of_all_launches(void **state)
{
    (void)state;
    fake_plan fake;
    fm_results *results = created(&fake, 4);
    add_with_error(results, 0, NULL); /* of an older program */
    assert_field(results, "frames_rmse_max", "");
    add_with_error(results, 1, json_real(0.25));
    add_with_error(results, 2, json_real(0.125));
    assert_field(results, "frames_rmse_max", "0.25");
    assert_field(results, "frames_max_abs", "");
    assert_field(results, "frames_drawn", "3");
    add_with_error(results, 3, json_string("inf"));
    assert_field(results, "frames_rmse_max", "inf");
    results_destroy(results);
    fake_close(&fake);
}

static double number_of(const fm_results *results, const char *name)
{
    char field[256];
    field_of(field, results, name);
    assert_string_not_equal(field, "");
    return atof(field);
}

static void expect_number(const fm_results *results, const char *name, double expected)
{
    const double number = number_of(results, name);
    if (fabs(number - expected) > 1e-6 * fabs(expected))
        fail_msg("%s is %.9g, not %.9g", name, number, expected);
}

/* Store times 2, 4 and 8: the range is widened by 4 to the power of 0.815. The floor takes 0.5. */
static void every_time_and_ratio_has_an_interval_by_launches(void **state)
{
    (void)state;
    fake_plan fake;
    fm_results *results = created(&fake, 3);
    const double times[3][4] = { { 2, 2, 9, -1 }, { 4, 1, 4, -1 }, { 8, 8, 8, -1 } };
    const double steady[] = { 10, 10, 10 }, wide = pow(4.0, 0.815);
    for (uint32_t i = 0; i < 3; i++)
        add(results, i, times[i], steady);
    expect_number(results, "store_ms", 4);
    expect_number(results, "store_ms_low", 2 / wide);
    expect_number(results, "store_ms_high", 8 * wide);
    expect_number(results, "frame_ms_low", 4 / wide);
    expect_number(results, "frame_ms_high", 16 * wide);
    expect_number(results, "times_floor", 8);
    expect_number(results, "times_floor_low", 4 / wide);
    expect_number(results, "times_floor_high", 16 * wide);
    expect_number(results, "fragments_per_s", 1000 / 8e-3);
    expect_number(results, "fragments_per_s_low", 1000 / (16e-3 * wide));
    expect_number(results, "fragments_per_s_high", 1000 / (4e-3 / wide));
    assert_field(results, "clear_ms_low", "");
    results_destroy(results);
    fake_close(&fake);
}

static void one_launch_has_no_interval(void **state)
{
    (void)state;
    static const char *const ends[] = { "frame_ms_low",      "frame_ms_high",
                                        "store_ms_low",      "store_ms_high",
                                        "times_floor_low",   "times_floor_high",
                                        "frame_wall_ms_low", "fragments_per_s_low" };
    fake_plan fake;
    fm_results *results = created(&fake, 1);
    const double store_ms[] = { 1, 2, 3, 4, 5, -1 }, steady[] = { 10, 10, 10, 10, 10 };
    add(results, 0, store_ms, steady);
    assert_field(results, "store_ms", "3");
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++)
        assert_field(results, ends[i], "");
    results_destroy(results);
    fake_close(&fake);
}

static void times_floor_is_of_frames_where_they_have_one_timer(void **state)
{
    (void)state;
    fake_plan fake;
    fm_results *results = with_two_launches(&fake);
    fake.cases[0].settings.timers = FM_TIMERS_FRAME;
    assert_field(results, "times_floor", "3"); /* median of 4/2 and 8/2 */
    results_destroy(results);
    fake_close(&fake);
}

static void summary_leaves_k_empty_where_it_is_not_used(void **state)
{
    (void)state;
    fake_plan fake;
    fm_results *results = created(&fake, 1);
    assert_field(results, "k", "8");
    fake.cases[0].settings.k = 0;
    assert_field(results, "k", "");
    assert_field(results, "r", "");
    results_destroy(results);
    fake_close(&fake);
}

static void summary_options_name_what_is_not_as_usual(void **state)
{
    (void)state;
    fake_plan fake;
    fm_results *results = created(&fake, 1);
    assert_field(results, "options", "");
    fake.cases[0].settings.lock = FM_LOCK_INTERLOCK;
    fake.cases[0].choices = &(fm_choice){ "layout", "pixel" };
    fake.cases[0].choice_count = 1;
    assert_field(results, "options", "layout=pixel lock=interlock");
    results_destroy(results);
    fake_close(&fake);
}

static void summary_excludes_samples_off_full_clock(void **state)
{
    (void)state;
    fake_plan fake;
    fm_results *results = created(&fake, 1);
    const double store_ms[] = { 1.0, 9.0, 1.0, -1 }, canary_ns[] = { 100, 141, 140 };
    fake.plan.frames = 3;
    add(results, 0, store_ms, canary_ns);
    assert_field(results, "store_ms", "1");
    assert_field(results, "samples", "2");
    assert_field(results, "message", "unclear: only 2 samples at full clock");
    assert_field(results, "status", "ok");
    assert_int_equal(results_end(results, NULL), FM_OK);
    char *samples = fake_read(&fake, "samples.csv");
    const char *mark = strstr(samples, "off_clock");
    assert_non_null(strstr(samples, "1,run,0000000000000001,0,1,off_clock,1,\n"));
    assert_null(strstr(mark + 1, "off_clock")); /* no other frame */
    free(samples);
    results_destroy(results);
    fake_close(&fake);
}

static void samples_are_kept_with_metrics_that_have_no_column(void **state)
{
    (void)state;
    fake_plan fake;
    fm_results *results = created(&fake, 1);
    const double store_ms[] = { 1.5, -1 }, canary_ns[] = { 100 };
    add(results, 0, store_ms, canary_ns);
    char *samples = fake_read(&fake, "samples.csv");
    assert_string_equal(samples, "schema,run_id,case_id,launch,frame,metric,value,unit\n"
                                 "1,run,0000000000000001,0,0,frame_ms,3,ms\n"
                                 "1,run,0000000000000001,0,0,store_ms,1.5,ms\n"
                                 "1,run,0000000000000001,0,0,floor_store_ms,0.5,ms\n"
                                 "1,run,0000000000000001,0,0,floor_frame_ms,2,ms\n"
                                 "1,run,0000000000000001,0,0,pass.sort_ms,0.25,ms\n"
                                 "1,run,0000000000000001,0,0,canary_ns,100,ns\n"
                                 "1,run,0000000000000001,,,wrong_pixels,3,\n");
    free(samples);
    results_destroy(results);
    fake_close(&fake);
}

static void numbers_of_a_launch_are_rows_without_a_frame(void **state)
{
    (void)state;
    fake_plan fake;
    fm_results *results = created(&fake, 1);
    json_t *answer =
        json_pack("{s:s, s:{s:f, s:i}}", "status", "ok", "launch", "waited_s", 0.25, "load_end", 7);
    assert_int_equal(results_add(results, 0, 0, answer, NULL), FM_OK);
    json_decref(answer);
    char *samples = fake_read(&fake, "samples.csv");
    assert_non_null(strstr(samples, "1,run,0000000000000001,0,,waited_s,0.25,s\n"
                                    "1,run,0000000000000001,0,,load_end,7,\n"));
    free(samples);
    results_destroy(results);
    fake_close(&fake);
}

static void a_case_has_the_worst_status_of_its_launches(void **state)
{
    (void)state;
    fake_plan fake;
    fm_results *results = created(&fake, 3);
    const double store_ms[] = { 1.0, -1 }, canary_ns[] = { 100 };
    json_t *crash = json_pack("{s:s, s:s}", "status", "crash", "message", "killed by SIGSEGV");
    add(results, 0, store_ms, canary_ns);
    assert_false(results_is_finished(results, 0));
    assert_int_equal(results_add(results, 0, 1, crash, NULL), FM_OK);
    json_decref(crash);
    assert_field(results, "status", "crash");
    assert_field(results, "message", "launch 1: killed by SIGSEGV");
    assert_field(results, "store_ms", "1");
    assert_true(results_is_finished(results, 0));
    results_destroy(results);
    fake_close(&fake);
}

static void skipped_cases_tell_refusal_from_missing_support(void **state)
{
    (void)state;
    fake_plan fake;
    fm_results *results = NULL;
    fake_open(&fake, only_kb, 1);
    char refused[] = "kb.so: wrong ABI", unsupported[] = "k above 16";
    fake.cases[0].skip = refused;
    fake.cases[0].skip_status = FM_CASE_PLUGIN_ERROR;
    assert_int_equal(results_create(&results, &fake.plan, &fake.list, fake.folder, "run", NULL),
                     FM_OK);
    assert_field(results, "status", "plugin_error");
    assert_field(results, "message", "kb.so: wrong ABI");
    assert_field(results, "reason", "");
    results_destroy(results);
    fake.cases[0].skip = unsupported;
    fake.cases[0].skip_status = FM_CASE_NOT_SUPPORTED;
    fake.cases[0].skip_reason = FM_REASON_SETTING;
    assert_int_equal(results_create(&results, &fake.plan, &fake.list, fake.folder, "run", NULL),
                     FM_OK);
    assert_field(results, "status", "not_supported");
    assert_field(results, "reason", "setting");
    results_destroy(results);
    fake_close(&fake);
}

static void add_end(fm_results *results, uint32_t launch, const char *status, const char *reason)
{
    json_t *answer =
        json_pack("{s:s, s:s, s:s*}", "status", status, "message", "why", "reason", reason);
    assert_int_equal(results_add(results, 0, launch, answer, NULL), FM_OK);
    json_decref(answer);
}

/* It is that of the worst status, as the message is. */
static void a_reason_goes_with_its_status(void **state)
{
    (void)state;
    fake_plan fake;
    fm_results *results = created(&fake, 3);
    add_end(results, 0, "ok", NULL);
    assert_field(results, "reason", "");
    add_end(results, 1, "not_supported", "device-limit");
    assert_field(results, "status", "not_supported");
    assert_field(results, "reason", "device-limit");
    add_end(results, 2, "out_of_memory", NULL);
    assert_field(results, "status", "out_of_memory");
    assert_field(results, "reason", "");
    results_destroy(results);
    fake_close(&fake);
}

static size_t summary_bytes(const fm_results *results)
{
    char *bytes = NULL;
    size_t count = 0;
    if (text_read_file(&bytes, &count, results->summary_path, 1u << 20, NULL) != FM_OK)
        count = 0;
    free(bytes);
    return count;
}

static void summary_of_many_cases_waits_for_its_turn(void **state)
{
    (void)state;
    fake_plan fake;
    fm_results *results = created(&fake, 1);
    fm_plan many = fake.plan;
    many.count = 1000; /* what is finished is far below 1/64 of them */
    assert_int_equal(results_write_summary_if_due(results, 100.0, NULL), FM_OK);
    const size_t empty = summary_bytes(results);
    assert_true(empty > 0);
    const double ms[] = { 1.0, -1 }, steady[] = { 10 };
    add(results, 0, ms, steady);
    results->plan = &many;
    assert_int_equal(results_write_summary_if_due(results, 101.0, NULL), FM_OK);
    results->plan = &fake.plan;
    assert_int_equal(summary_bytes(results), empty);
    results->took_s = 1.0; /* so that 3 s are too soon, too */
    results->plan = &many;
    assert_int_equal(results_write_summary_if_due(results, 103.0, NULL), FM_OK);
    results->plan = &fake.plan;
    assert_int_equal(summary_bytes(results), empty);
    assert_int_equal(results_write_summary_if_due(results, 103.5, NULL), FM_OK);
    assert_true(summary_bytes(results) > empty);
    results_destroy(results);
    fake_close(&fake);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(csv_quotes_as_rfc_4180_says),
        cmocka_unit_test(summary_of_many_cases_waits_for_its_turn),
        cmocka_unit_test(summary_has_the_columns_of_the_design_in_order),
        cmocka_unit_test(summary_row_holds_medians_ratios_and_rates),
        cmocka_unit_test(worst_frame_is_that_of_all_launches),
        cmocka_unit_test(every_time_and_ratio_has_an_interval_by_launches),
        cmocka_unit_test(one_launch_has_no_interval),
        cmocka_unit_test(times_floor_is_of_frames_where_they_have_one_timer),
        cmocka_unit_test(summary_leaves_k_empty_where_it_is_not_used),
        cmocka_unit_test(summary_options_name_what_is_not_as_usual),
        cmocka_unit_test(summary_excludes_samples_off_full_clock),
        cmocka_unit_test(samples_are_kept_with_metrics_that_have_no_column),
        cmocka_unit_test(numbers_of_a_launch_are_rows_without_a_frame),
        cmocka_unit_test(a_case_has_the_worst_status_of_its_launches),
        cmocka_unit_test(skipped_cases_tell_refusal_from_missing_support),
        cmocka_unit_test(a_reason_goes_with_its_status),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
