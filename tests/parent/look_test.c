/* Runs that launch until times are precise: groups, looks, and what a continued run makes of them.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/stats.h"
#include "fake_worker.h"

enum { LAST = 20 }; /* looks at 5, 10, 20 */

/* steady: as precise as can be. settling: 3.9 % after 5 launches, less than 2 % after 10. wild:
 * never. */
static double time_of(const char *method, uint32_t launch)
{
    if (strcmp(method, "settling") == 0)
        return launch < 5 ? 98.0 + launch : 100.0;
    if (strcmp(method, "wild") == 0)
        return launch % 2 == 0 ? 90.0 : 110.0;
    return 50.0;
}

static void open_adaptive(fake_plan *fake, const char *const *ids)
{
    char line[64];
    open_with_worker(fake, ids, LAST);
    for (size_t i = 0; i < fake->plan.count; i++) {
        fake->cases[i].settings.launches = LAST;
        fake->cases[i].settings.precision_percent = 2.0;
        for (uint32_t j = 0; j < LAST; j++) {
            snprintf(line, sizeof line, "%s %u %g\n", ids[i], j, time_of(ids[i], j));
            fake_write(fake, "times", line, "a");
        }
    }
}

static size_t count_calls(const fake_plan *fake, const char *method)
{
    char words[32];
    snprintf(words, sizeof words, "%s ", method);
    return count_in_file(fake, "calls", words);
}

static void group_stops_when_its_last_case_is_precise(void **state)
{
    (void)state;
    static const char *const ids[] = { "settling", "steady", NULL };
    fake_plan fake;
    open_adaptive(&fake, ids);
    assert_int_equal(run_well(&fake).ok, 2);
    assert_int_equal(count_calls(&fake, "settling"), 10);
    assert_int_equal(count_calls(&fake, "steady"), 10);
    assert_in_file(&fake, "out/summary.csv", "precision 2%: reached, 1.");
    assert_in_file(&fake, "out/summary.csv", "precision 2%: reached, 0% after 10 launches");
    assert_in_file(&fake, "out/journal.jsonl",
                   "{\"event\":\"more\",\"case\":\"0000000000000001\",\"launch\":5}");
    assert_in_file(&fake, "out/journal.jsonl",
                   "{\"event\":\"enough\",\"case\":\"0000000000000002\",\"launch\":10}");
    assert_in_file(&fake, "out/manifest.json", "\"precision_percent\": 2.0");
    fake_close(&fake);
}

/* Another scene, device or feed is another chart; another name of a scene, too. */
static void groups_stop_each_for_itself(void **state)
{
    (void)state;
    static const char *const ids[] = { "settling", "steady",  "steady2", "steady3",
                                       "steady4",  "steady5", NULL };
    fake_plan fake;
    open_adaptive(&fake, ids);
    fake.cases[1].settings.k = 7; /* the one that stays with it: methods without a k do, too */
    fake.cases[2].settings.width_px = 64;
    snprintf(fake.cases[3].device, sizeof fake.cases[3].device, "dummy:1");
    snprintf(fake.cases[4].feed, sizeof fake.cases[4].feed, "compute-layer");
    snprintf(fake.cases[5].scene, sizeof fake.cases[5].scene, "other");
    assert_int_equal(run_well(&fake).ok, 6);
    assert_int_equal(count_calls(&fake, "settling"), 10);
    assert_int_equal(count_calls(&fake, "steady"), 10);
    for (size_t i = 2; i < 6; i++)
        assert_int_equal(count_calls(&fake, ids[i]), 5);
    fake_close(&fake);
}

static void group_ends_at_the_last_look(void **state)
{
    (void)state;
    static const char *const ids[] = { "steady", "wild", NULL };
    fake_plan fake;
    open_adaptive(&fake, ids);
    assert_int_equal(run_well(&fake).ok, 2);
    assert_int_equal(count_calls(&fake, "steady"), LAST);
    assert_int_equal(count_calls(&fake, "wild"), LAST);
    assert_in_file(&fake, "out/summary.csv", "precision 2%: not reached, 10% after 20 launches");
    assert_in_file(&fake, "out/summary.csv", "precision 2%: reached, 0% after 20 launches");
    fake_close(&fake);
}

/* 98 to 102 after five launches: by the level of the first look, not by 5 %. */
static void row_has_the_interval_of_its_look(void **state)
{
    (void)state;
    static const char *const ids[] = { "settling", NULL };
    fake_plan fake;
    char low_and_high[96];
    double values[] = { 98.0, 99.0, 100.0, 101.0, 102.0 };
    open_adaptive(&fake, ids);
    fake.cases[0].settings.precision_percent = 5.0;
    run_well(&fake);
    const fm_interval interval = stats_interval_at(values, 5, 1.0 - 0.05 * 5 / LAST);
    assert_true(interval.low < 97.0 && interval.high > 103.0);
    snprintf(low_and_high, sizeof low_and_high, "5,10,100,%.4g", interval.low);
    assert_in_file(&fake, "out/summary.csv", low_and_high);
    fake_close(&fake);
}

static void failed_cases_keep_nobody_from_stopping(void **state)
{
    (void)state;
    static const char *const ids[] = { "crash", "steady", "unsupported", NULL };
    fake_plan fake;
    open_adaptive(&fake, ids);
    const fm_run_result result = run_well(&fake);
    assert_int_equal(result.ok, 1);
    assert_int_equal(result.failed, 1);
    assert_int_equal(count_calls(&fake, "steady"), 5);
    assert_int_equal(count_in_file(&fake, "out/summary.csv", "precision"), 1);
    fake_close(&fake);
}

/* Of the run as it was, with its first `lines` lines in the journal. */
static void cut_journal(const fake_plan *fake, const char *whole, size_t lines)
{
    char *copy = strdup(whole), *end = copy;
    assert_non_null(copy);
    for (size_t i = 0; i < lines; i++)
        end = strchr(end, '\n') + 1;
    *end = '\0';
    fake_write(fake, "out/journal.jsonl", copy, "w");
    free(copy);
}

/* Killed after each line near a look, and continued: the same rows, and each launch once. */
static void continued_run_decides_as_it_would_have(void **state)
{
    (void)state;
    static const char *const ids[] = { "settling", "steady", NULL };
    fake_plan fake;
    open_adaptive(&fake, ids);
    run_well(&fake);
    char *journal = fake_read(&fake, "out/journal.jsonl");
    char *summary = fake_read(&fake, "out/summary.csv");
    size_t line = 0;
    for (const char *at = journal; *at != '\0'; at = strchr(at, '\n') + 1, line++) {
        const bool is_near = strstr(at, "\"launch\":4,") != NULL && line % 2 == 0;
        const bool is_decision = strncmp(at, "{\"event\":\"more", 14) == 0 ||
                                 strncmp(at, "{\"event\":\"enough", 16) == 0;
        if (line == 0 || !(is_decision || (is_near && line < 24 && line > 16)))
            continue;
        for (size_t more = 0; more < 2; more++) { /* before it, and after it */
            cut_journal(&fake, journal, line + more);
            assert_int_equal(run_well(&fake).ok, 2);
            assert_int_equal(count_in_file(&fake, "out/journal.jsonl", "\"event\":\"end\""), 20);
            char *summary_again = fake_read(&fake, "out/summary.csv");
            assert_string_equal(summary_again, summary);
            free(summary_again);
        }
    }
    free(journal);
    free(summary);
    fake_close(&fake);
}

static void replace_in_journal(const fake_plan *fake, const char *from, const char *to)
{
    char *text = fake_read(fake, "out/journal.jsonl");
    fm_text edited = { 0 };
    const char *at = text;
    for (const char *next; (next = strstr(at, from)) != NULL; at = next + strlen(from)) {
        text_add_raw(&edited, at, (size_t)(next - at));
        text_add(&edited, "%s", to);
    }
    text_add(&edited, "%s", at);
    fake_write(fake, "out/journal.jsonl", edited.bytes, "w");
    text_free(&edited);
    free(text);
}

/* The journal says that it went on, and that holds, whatever a second look would say. */
static void continued_run_follows_what_was_decided(void **state)
{
    (void)state;
    static const char *const ids[] = { "steady", "steady2", NULL };
    fake_plan fake;
    open_adaptive(&fake, ids);
    run_well(&fake);
    assert_int_equal(count_calls(&fake, "steady"), 5);
    replace_in_journal(&fake, "enough", "more");
    assert_int_equal(run_well(&fake).ok, 2);
    assert_int_equal(count_calls(&fake, "steady"), 10); /* and there it decides anew */
    assert_int_equal(count_calls(&fake, "steady2"), 10);
    assert_int_equal(count_in_file(&fake, "out/journal.jsonl", "\"event\":\"enough\""), 2);
    fake_close(&fake);
}

/* One line of a decision was written when the run was killed: it binds all cases of the group. */
static void half_a_decision_binds_the_group(void **state)
{
    (void)state;
    static const char *const ids[] = { "steady", "steady2", NULL };
    fake_plan fake;
    open_adaptive(&fake, ids);
    run_well(&fake);
    char *journal = fake_read(&fake, "out/journal.jsonl");
    *(strchr(strstr(journal, "\"event\":\"enough\""), '\n') + 1) = '\0';
    fake_write(&fake, "out/journal.jsonl", journal, "w");
    free(journal);
    replace_in_journal(&fake, "enough", "more");
    assert_int_equal(run_well(&fake).ok, 2);
    assert_int_equal(count_calls(&fake, "steady"), 10);
    assert_int_equal(count_calls(&fake, "steady2"), 10);
    assert_int_equal(count_in_file(&fake, "out/journal.jsonl", "\"event\":\"more\""), 2);
    fake_close(&fake);
}

/* A row that is measured anew has as many launches as those that it is compared with. */
static void retried_case_follows_its_group(void **state)
{
    (void)state;
    static const char *const ids[] = { "settling", "silent", NULL };
    fake_plan fake;
    fm_run_result result;
    char directory[96];
    open_adaptive(&fake, ids);
    run_well(&fake);
    assert_int_equal(count_calls(&fake, "settling"), 10);
    fake_write(&fake, "room", "", "w"); /* now it answers */
    fake_write(&fake, "calls", "", "w");
    snprintf(directory, sizeof directory, "%s/out", fake.folder);
    const fm_run_desc desc = { .directory = directory,
                               .retried = 1u << FM_CASE_CRASH,
                               .worker = fake.worker };
    assert_int_equal(run_cases(&result, &fake.plan, &fake.list, &desc, NULL), FM_OK);
    assert_int_equal(result.ok, 2);
    assert_int_equal(count_calls(&fake, "silent"), 10);
    assert_int_equal(count_calls(&fake, "settling"), 0);
    assert_int_equal(run_well(&fake).ok, 2); /* and so it is read again */
    assert_int_equal(count_calls(&fake, "silent"), 10);
    fake_close(&fake);
}

static void assert_damaged(const fake_plan *fake, const char *words)
{
    fm_run_result result;
    fm_error err = { 0 };
    assert_int_equal(run_in(&result, fake, 20, &err), FM_IO);
    assert_true(result.is_damaged);
    if (strstr(err.message, words) == NULL)
        fail_msg("'%s' is not in: %s", words, err.message);
}

static void decisions_that_cannot_be_are_damage(void **state)
{
    (void)state;
    static const char *const ids[] = { "steady", "steady2", NULL };
    static const struct {
        const char *line, *words;
    } rows[] = {
        { "{\"event\":\"more\",\"case\":\"0000000000000001\",\"launch\":6}\n",
          "launch 6: no look of this plan" },
        { "{\"event\":\"more\",\"case\":\"0000000000000001\",\"launch\":10}\n",
          "launch 10: other cases of its scene decided otherwise" },
        { "{\"event\":\"more\",\"case\":\"0000000000000002\",\"launch\":5}\n",
          "launch 5: other cases of its scene decided otherwise" },
        { "{\"event\":\"begin\",\"case\":\"0000000000000002\",\"launch\":5}\n",
          "launch 5: 5 were enough" },
        { "{\"event\":\"enough\",\"case\":\"0000000000000001\",\"launch\":20}\n",
          "not of this plan" },
        { "{\"event\":\"enough\",\"case\":\"0000000000000001\",\"launch\":4}\n",
          "launch 4 is decided on and had begun" },
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        fake_plan fake;
        open_adaptive(&fake, ids);
        run_well(&fake);
        fake_write(&fake, "out/journal.jsonl", rows[i].line, "a");
        assert_damaged(&fake, rows[i].words);
        fake_close(&fake);
    }
}

/* A plan without it has no looks, and one with another precision is another plan. */
static void precision_is_part_of_the_plan(void **state)
{
    (void)state;
    static const char *const ids[] = { "steady", NULL };
    fake_plan fake;
    fm_run_result result;
    open_adaptive(&fake, ids);
    run_well(&fake);
    fake.cases[0].settings.precision_percent = 3.0;
    assert_int_equal(run_in(&result, &fake, 20, NULL), FM_INVALID);
    fake.cases[0].settings.precision_percent = 0.0;
    assert_int_equal(run_in(&result, &fake, 20, NULL), FM_INVALID);
    fake_close(&fake);
    open_with_worker(&fake, ids, LAST);
    fake.cases[0].settings.launches = LAST;
    run_well(&fake);
    assert_int_equal(count_calls(&fake, "steady"), LAST);
    fake_write(&fake, "out/journal.jsonl",
               "{\"event\":\"enough\",\"case\":\"0000000000000001\",\"launch\":10}\n", "a");
    assert_damaged(&fake, "launch 10 is decided on and had begun");
    fake_close(&fake);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(group_stops_when_its_last_case_is_precise),
        cmocka_unit_test(groups_stop_each_for_itself),
        cmocka_unit_test(group_ends_at_the_last_look),
        cmocka_unit_test(row_has_the_interval_of_its_look),
        cmocka_unit_test(failed_cases_keep_nobody_from_stopping),
        cmocka_unit_test(continued_run_decides_as_it_would_have),
        cmocka_unit_test(continued_run_follows_what_was_decided),
        cmocka_unit_test(half_a_decision_binds_the_group),
        cmocka_unit_test(retried_case_follows_its_group),
        cmocka_unit_test(decisions_that_cannot_be_are_damage),
        cmocka_unit_test(precision_is_part_of_the_plan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
