/* A night judged: what is a finding, what is none, and what is written of them. */
#include "compare_kit.h"

#include <unistd.h>

#include "history/record.h"
#include "night/gate.h"
#include "night/night.h"

/* Nights in a history of their own; the last one stays open, and is judged. */
typedef struct kit_night {
    char directory[64], path[96];
    fm_history *history;
    kit_run now, baseline;
    fm_night_desc desc;
    fm_night_result night;
    fm_error err;
} kit_night;

static void begin(kit_night *kit)
{
    *kit = (kit_night){ 0 };
    snprintf(kit->directory, sizeof kit->directory, "/tmp/fragmark-night-XXXXXX");
    assert_non_null(mkdtemp(kit->directory));
    snprintf(kit->path, sizeof kit->path, "%s/history.sqlite", kit->directory);
    assert_int_equal(history_open(&kit->history, kit->path, FM_HISTORY_WRITE, &kit->err), FM_OK);
}

/* One case, whose launches take so many milliseconds over a floor of 10. */
static void add_night(kit_night *kit, unsigned night, const char *cells, double ms)
{
    char started[32], run_id[32], samples[256];
    fm_recorded recorded;
    const char *const rows[] = { cells };
    snprintf(started, sizeof started, "2026-03-%02uT01:00:00Z", night + 1);
    snprintf(run_id, sizeof run_id, "run-%u", night);
    snprintf(samples, sizeof samples,
             "c0 0 frame_ms %g\nc0 0 floor_frame_ms 10\nc0 1 frame_ms %g\nc0 1 floor_frame_ms 10\n",
             ms, 1.1 * ms);
    if (kit->now.results != NULL)
        kit_close(&kit->now);
    kit_open(&kit->now, &(kit_run_desc){ ROWS(rows), .samples = samples, .started = started,
                                         .run_id = run_id });
    if (history_record(&recorded, kit->history, kit->now.results, &kit->err) != FM_OK)
        fail_msg("%s", kit->err.message);
}

static void judge(kit_night *kit)
{
    kit->desc.history = kit->history;
    kit->desc.now = kit->now.results;
    if (night_judge(&kit->night, &kit->desc, &kit->err) != FM_OK)
        fail_msg("%s", kit->err.message);
}

static void end(kit_night *kit)
{
    char command[128];
    night_free(&kit->night);
    kit_close(&kit->now);
    history_close(kit->history);
    snprintf(command, sizeof command, "rm -r '%s'", kit->directory);
    assert_int_equal(system(command), 0);
}

/* What is found of two nights that have these cells; kind NULL: nothing. */
static void expect_after(const char *before, const char *between, const char *now, const char *kind,
                         const char *text)
{
    kit_night kit;
    begin(&kit);
    add_night(&kit, 0, before, 30);
    if (between != NULL)
        add_night(&kit, 1, between, 30);
    add_night(&kit, 2, now, 30);
    judge(&kit);
    assert_int_equal(kit.night.alarms, kind != NULL ? 1 : 0);
    assert_int_equal(kit.night.count, kit.night.alarms);
    if (kind != NULL) {
        assert_string_equal(finding_kind_name(kit.night.findings[0].kind), kind);
        assert_non_null(strstr(kit.night.findings[0].text, text));
        assert_non_null(strstr(kit.night.findings[0].text, "2026-03-01"));
    }
    end(&kit);
}

static void expect(const char *before, const char *now, const char *kind, const char *text)
{
    expect_after(before, NULL, now, kind, text);
}

/* A night that was cut off, or failed, does not hide what is worse after it. */
static void nights_without_a_number_are_passed_over(void **state)
{
    static const char without[] = "frame_ms=;frame_ms_low=;frame_ms_high=;samples=0;"
                                  "bytes_allocated=;missing=;extra=;misordered=;max_abs=;"
                                  "total_rmse=";
    char skipped[256], crash[256];
    (void)state;
    snprintf(skipped, sizeof skipped, "k=4;status=skipped;%s", without);
    snprintf(crash, sizeof crash, "k=4;status=crash;%s", without);
    expect_after("k=4", skipped, "k=4;bytes_allocated=4100", "memory", "4096 -> 4100");
    expect_after("k=4", crash, "k=4;missing=1", "error", "missing 0 -> 1");
    expect_after("k=4", skipped, crash, "status", "ok -> crash");
    expect_after("k=4", skipped, "k=4", NULL, NULL);
    expect_after("k=4", skipped, skipped, NULL, NULL);
}

static void what_got_worse_since_last_night_is_a_finding(void **state)
{
    static const char crash[] = "k=4;status=crash;frame_ms=;frame_ms_low=;frame_ms_high=;samples=0";
    (void)state;
    expect("k=4", "k=4", NULL, NULL);
    expect("k=4", "k=4;bytes_allocated=4100", "memory", "bytes_allocated 4096 -> 4100");
    expect("k=4;bytes_allocated=4100", "k=4", NULL, NULL);
    expect("k=4", "k=4;missing=1", "error", "missing 0 -> 1");
    expect("k=4;missing=1", "k=4", NULL, NULL);
    expect("k=4", crash, "status", "status ok -> crash");
    expect(crash, crash, NULL, NULL); /* it did before */
    expect("k=4", "k=4;status=not_supported;frame_ms=", NULL, NULL);
}

/* Errors of who races need not repeat; bytes do. */
static void races_are_held_to_their_memory_alone(void **state)
{
    (void)state;
    expect("method=racy", "method=racy;missing=9", NULL, NULL);
    expect("k=4", "k=4;distinct_images=3;missing=9", NULL, NULL);
    expect("method=racy", "method=racy;bytes_allocated=4100", "memory", "4100");
}

static void a_failure_without_a_past_is_told(void **state)
{
    kit_night kit;
    (void)state;
    begin(&kit);
    add_night(&kit, 0, "status=crash;frame_ms=;frame_ms_low=;frame_ms_high=;samples=0", 30);
    judge(&kit);
    assert_int_equal(kit.night.alarms, 0);
    assert_int_equal(kit.night.new_failures, 1);
    end(&kit);
}

/* The history may have nights after it: of another policy, or from when it was judged first. */
static void a_night_that_is_not_the_last_is_judged_by_those_before_it(void **state)
{
    fm_text markdown = { 0 };
    kit_night kit;
    (void)state;
    begin(&kit);
    add_night(&kit, 0, "k=4", 30);
    add_night(&kit, 2, "k=4;bytes_allocated=5000", 30);
    add_night(&kit, 3, "k=4;bytes_allocated=5000", 30);
    add_night(&kit, 1, "k=4;bytes_allocated=4100", 30);
    judge(&kit);
    assert_int_equal(kit.night.alarms, 1);
    assert_non_null(strstr(kit.night.findings[0].text, "4096 -> 4100 since 2026-03-01"));
    assert_int_equal(kit.night.newer.count, 2);
    night_add_markdown(&markdown, &kit.night);
    assert_non_null(strstr(markdown.bytes, "2 later runs of these cases, the last of 2026-03-04T"));
    text_free(&markdown);
    night_free(&kit.night);
    add_night(&kit, 3, "k=4;bytes_allocated=5000", 30);
    judge(&kit);
    assert_int_equal(kit.night.alarms, 0);
    assert_int_equal(kit.night.newer.count, 0);
    end(&kit);
}

static void add_step(kit_night *kit)
{
    for (unsigned i = 0; i < 26; i++)
        add_night(kit, i, "k=4", (i < 23 ? 30 : 33) + 0.01 * (i * 7 % 5));
}

/* What was worse that night stays so, whatever came after it. */
static void a_step_is_found_again_after_later_nights(void **state)
{
    kit_night kit;
    (void)state;
    begin(&kit);
    add_step(&kit);
    for (unsigned i = 26; i < 30; i++)
        add_night(&kit, i, "k=4", 30);
    judge(&kit);
    assert_int_equal(kit.night.alarms, 0);
    night_free(&kit.night);
    add_night(&kit, 25, "k=4", 33.01);
    judge(&kit);
    assert_int_equal(kit.night.alarms, 1);
    assert_int_equal(kit.night.findings[0].kind, FM_FINDING_SLOWER);
    end(&kit);
}

static bool dismiss(fm_finding *finding, const fm_result_files *now, void *context)
{
    size_t *asked = context;
    (*asked)++;
    assert_string_equal(now->cases[finding->case_index].id, "c0");
    return false;
}

static void an_alarm_on_time_may_be_dismissed_by_who_measures_again(void **state)
{
    size_t asked = 0;
    kit_night kit;
    (void)state;
    begin(&kit);
    add_step(&kit);
    judge(&kit);
    assert_int_equal(kit.night.alarms, 1);
    assert_int_equal(kit.night.findings[0].kind, FM_FINDING_SLOWER);
    night_free(&kit.night);
    kit.desc.confirm = dismiss;
    kit.desc.context = &asked;
    judge(&kit);
    assert_int_equal(asked, 1);
    assert_int_equal(kit.night.count, 1);
    assert_int_equal(kit.night.alarms, 0);
    end(&kit);
}

/* What is said of a step once a gate has this row of its case; row NULL: none. */
static void judge_step_with_gate(kit_night *kit, const char *row)
{
    char path[96], csv[512];
    fm_gate_answers answers;
    snprintf(path, sizeof path, "%s/ab.csv", kit->directory);
    snprintf(csv, sizeof csv, "schema,case_id_new,verdict,time_shift,cpu_shift,why\n%s\n",
             row != NULL ? row : "1,c9,same,1,,");
    assert_int_equal(text_write_file(path, csv, strlen(csv), NULL), FM_OK);
    assert_int_equal(gate_answers_open(&answers, path, &kit->err), FM_OK);
    kit->desc.confirm = gate_confirm;
    kit->desc.context = &answers;
    judge(kit);
    gate_answers_close(&answers);
}

static void a_gate_confirms_dismisses_or_leaves_an_alarm(void **state)
{
    static const struct {
        const char *row, *words, *standing;
        size_t alarms;
    } cases[] = {
        { "1,c0,worse,1.5,1.25,confirmed on 20 fresh pairs",
          "; a gate says worse, time +50.0 %, cpu +25.0 %: confirmed on 20 fresh pairs",
          ", confirmed", 1 },
        { "1,c0,same,1.001,,", "; a gate says same, time +0.1 %", ", not confirmed", 0 },
        { "1,c0,unclear,1.2,,60 pairs might decide", "; a gate says unclear", ", not confirmed",
          0 },
        { "1,c0,unmeasured,,,base: crash", "; a gate could not measure it", "", 1 },
        { NULL, "; a gate could not measure it", "", 1 },
    };
    kit_night kit;
    (void)state;
    begin(&kit);
    add_step(&kit);
    kit.desc.unconfirmed = "Nobody knows.";
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        fm_text markdown = { 0 }, json = { 0 };
        judge_step_with_gate(&kit, cases[i].row);
        assert_int_equal(kit.night.count, 1);
        assert_int_equal(kit.night.alarms, cases[i].alarms);
        assert_non_null(strstr(kit.night.findings[0].text, cases[i].words));
        assert_string_equal(finding_standing(&kit.night.findings[0]), cases[i].standing);
        night_add_markdown(&markdown, &kit.night);
        assert_int_equal(night_add_json(&json, &kit.night, &kit.err), FM_OK);
        assert_int_equal(strstr(markdown.bytes, "Nobody knows.") != NULL,
                         cases[i].standing[0] == '\0');
        assert_int_equal(strstr(json.bytes, "\"confirmed\": true") != NULL,
                         strcmp(cases[i].standing, ", confirmed") == 0);
        assert_non_null(strstr(json.bytes, "\"method\": \""));
        text_free(&json);
        text_free(&markdown);
        night_free(&kit.night);
    }
    kit.desc.confirm = NULL;
    judge(&kit); /* what end() frees */
    end(&kit);
}

static void a_file_that_is_no_gates_is_refused(void **state)
{
    char path[] = "/tmp/fragmark-gate-XXXXXX";
    fm_gate_answers answers;
    fm_error err = { 0 };
    (void)state;
    close(mkstemp(path));
    assert_int_equal(text_write_file(path, "schema,verdict\n1,worse\n", 23, NULL), FM_OK);
    assert_int_equal(gate_answers_open(&answers, path, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "case_id_new"));
    gate_answers_close(&answers);
    unlink(path);
    assert_int_equal(gate_answers_open(&answers, path, &err), FM_IO);
    gate_answers_close(&answers);
}

/* Two launches of 30 and 33 are known to 4.8 %; for a step of 6 % it is to be 1.6 %. */
static void the_launches_that_are_needed_follow_from_the_noise(void **state)
{
    kit_night kit;
    (void)state;
    begin(&kit);
    add_night(&kit, 0, "k=4", 30);
    judge(&kit);
    const double error = log(1.1) / 2, wanted = log(1.06) / 3.6;
    assert_true(fabs(kit.night.noisiest - error) < 1e-9);
    assert_int_equal(kit.night.launches_needed, (size_t)ceil(2 * error * error / wanted / wanted));
    end(&kit);
}

static void a_baseline_is_held_against_each_night(void **state)
{
    static const char *const rows[] = { "k=4;bytes_allocated=4000" };
    kit_night kit;
    (void)state;
    begin(&kit);
    add_night(&kit, 0, "k=4", 30);
    kit_open(&kit.baseline, &(kit_run_desc){ ROWS(rows), .run_id = "old" });
    kit.desc.baseline = kit.baseline.results;
    kit.desc.baseline_name = "release-1";
    judge(&kit);
    assert_int_equal(kit.night.alarms, 1);
    assert_non_null(strstr(kit.night.findings[0].text, "4000 -> 4096 since baseline release-1"));
    kit_close(&kit.baseline);
    end(&kit);
}

static void what_is_written_names_the_finding_and_escapes_it(void **state)
{
    fm_text markdown = { 0 }, junit = { 0 }, json = { 0 };
    kit_night kit;
    (void)state;
    begin(&kit);
    add_night(&kit, 0, "scene=a|b<&>", 30);
    add_night(&kit, 1, "scene=a|b<&>;bytes_allocated=4100", 30);
    judge(&kit);
    night_add_markdown(&markdown, &kit.night);
    night_add_junit(&junit, &kit.night);
    assert_int_equal(night_add_json(&json, &kit.night, &kit.err), FM_OK);
    assert_non_null(strstr(markdown.bytes, "# fragmark nightly: ALARM"));
    assert_non_null(strstr(markdown.bytes, "a\\|b<&>"));
    assert_non_null(strstr(markdown.bytes, "bytes_allocated 4096 -> 4100"));
    assert_non_null(strstr(junit.bytes, "tests=\"1\" failures=\"1\" errors=\"0\""));
    assert_non_null(strstr(junit.bytes, "a|b&#60;&#38;&#62;"));
    assert_non_null(strstr(junit.bytes, "<failure type=\"memory\""));
    assert_non_null(strstr(json.bytes, "\"verdict\": \"alarm\""));
    text_free(&json);
    text_free(&junit);
    text_free(&markdown);
    end(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_got_worse_since_last_night_is_a_finding),
        cmocka_unit_test(nights_without_a_number_are_passed_over),
        cmocka_unit_test(races_are_held_to_their_memory_alone),
        cmocka_unit_test(a_failure_without_a_past_is_told),
        cmocka_unit_test(a_night_that_is_not_the_last_is_judged_by_those_before_it),
        cmocka_unit_test(a_step_is_found_again_after_later_nights),
        cmocka_unit_test(an_alarm_on_time_may_be_dismissed_by_who_measures_again),
        cmocka_unit_test(a_gate_confirms_dismisses_or_leaves_an_alarm),
        cmocka_unit_test(a_file_that_is_no_gates_is_refused),
        cmocka_unit_test(the_launches_that_are_needed_follow_from_the_noise),
        cmocka_unit_test(a_baseline_is_held_against_each_night),
        cmocka_unit_test(what_is_written_names_the_finding_and_escapes_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
