/* Runs of many nights in one file: what is found again, what is kept apart, what is refused. */
#include "compare_kit.h"

#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "history/record.h"
#include "history/runs.h"
#include "history/series.h"

/* A history in a folder of its own. */
typedef struct kit_history {
    char directory[64], path[96];
    fm_error err;
} kit_history;

static void begin(kit_history *kit)
{
    snprintf(kit->directory, sizeof kit->directory, "/tmp/fragmark-history-XXXXXX");
    assert_non_null(mkdtemp(kit->directory));
    snprintf(kit->path, sizeof kit->path, "%s/history.sqlite", kit->directory);
}

static void end(kit_history *kit)
{
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", kit->directory);
    assert_int_equal(system(command), 0);
}

static fm_recorded record(kit_history *kit, const kit_run_desc *desc)
{
    fm_history *history;
    fm_recorded recorded = FM_RECORDED_NEW;
    kit_run run;
    kit_open(&run, desc);
    if (history_open(&history, kit->path, FM_HISTORY_WRITE, &kit->err) != FM_OK ||
        history_record(&recorded, history, run.results, &kit->err) != FM_OK)
        fail_msg("%s", kit->err.message);
    history_close(history);
    kit_close(&run);
    return recorded;
}

static const char *const usual_rows[] = { "method=a;k=4", "method=b;k=4;case_id=b0" };

/* One launch a night: case a has so many milliseconds, b 20, the floor 10. */
static kit_run_desc night_desc(char texts[3][256], unsigned night, double a_ms)
{
    snprintf(texts[0], 256,
             "c0 0 frame_ms %g\nc0 0 floor_frame_ms 10\nb0 0 frame_ms 20\nb0 0 floor_frame_ms 10\n",
             a_ms);
    snprintf(texts[1], 256, "2026-03-%02uT01:00:00Z", night + 1);
    snprintf(texts[2], 256, "%016x", night + 1);
    return (kit_run_desc){ ROWS(usual_rows), .samples = texts[0], .started = texts[1],
                           .run_id = texts[2] };
}

static fm_recorded record_night(kit_history *kit, unsigned night, double a_ms)
{
    char texts[3][256];
    const kit_run_desc desc = night_desc(texts, night, a_ms);
    return record(kit, &desc);
}

static void load(fm_series_list *list, kit_history *kit, const fm_series_desc *desc)
{
    fm_history *history;
    if (history_open(&history, kit->path, FM_HISTORY_READ, &kit->err) != FM_OK ||
        history_series(list, history, desc, &kit->err) != FM_OK)
        fail_msg("%s", kit->err.message);
    history_close(history);
}

static size_t count_runs(kit_history *kit)
{
    fm_history *history;
    fm_run_list runs;
    assert_int_equal(history_open(&history, kit->path, FM_HISTORY_READ, &kit->err), FM_OK);
    assert_int_equal(history_runs(&runs, history, &kit->err), FM_OK);
    const size_t count = runs.count;
    history_runs_free(&runs);
    history_close(history);
    return count;
}

static void a_run_that_is_added_twice_is_one_entry(void **state)
{
    kit_history kit;
    fm_series_list list;
    (void)state;
    begin(&kit);
    assert_int_equal(record_night(&kit, 0, 30), FM_RECORDED_NEW);
    assert_int_equal(record_night(&kit, 0, 40), FM_RECORDED_REPLACED); /* it went on */
    assert_int_equal(count_runs(&kit), 1);
    load(&list, &kit, &(fm_series_desc){ .wanted = "a" });
    assert_int_equal(list.count, 1);
    assert_int_equal(list.items[0].count, 1);
    assert_true(fabs(list.items[0].nights[0].centre.ratio - 4.0) < 1e-12);
    history_series_free(&list);
    end(&kit);
}

/* Another version of the method has another id; the second night's machine has twice the memory. */
static void cases_are_found_again_and_machines_kept_apart(void **state)
{
    static const char *const renamed[] = { "method=a;k=4;case_id=d7;method_version=2" };
    static const char machine[] = "\"cpu\": \"EPYC\", \"cores\": 2, \"memory_bytes\": 2000000";
    static const char samples[] = "d7 0 frame_ms 30\nd7 0 floor_frame_ms 10\n";
    kit_history kit;
    fm_series_list list;
    (void)state;
    begin(&kit);
    record_night(&kit, 0, 30);
    record(&kit, &(kit_run_desc){ ROWS(renamed), .samples = samples, .run_id = "x",
                                  .started = "2026-03-02T01:00:00Z" });
    record(&kit, &(kit_run_desc){ ROWS(renamed), .samples = samples, .run_id = "y",
                                  .started = "2026-03-03T01:00:00Z", .machine = machine });
    load(&list, &kit, &(fm_series_desc){ .wanted = "c0" });
    assert_int_equal(list.count, 2);
    const size_t two = list.items[0].count == 2 ? 0 : 1;
    assert_int_equal(list.items[two].count, 2);
    assert_string_equal(list.items[two].nights[1].case_id, "d7");
    assert_int_equal(list.items[1 - two].count, 1);
    assert_string_not_equal(list.items[0].machine, list.items[1].machine);
    history_series_free(&list);
    end(&kit);
}

/* Launch by launch: 30 / 20 and 60 / 40, whatever the machine did meanwhile. */
static void a_reference_method_is_taken_of_the_same_round(void **state)
{
    static const char samples[] = "c0 0 frame_ms 30\nc0 1 frame_ms 60\nc0 2 frame_ms 90\n"
                                  "b0 0 frame_ms 20\nb0 1 frame_ms 40\n";
    kit_history kit;
    fm_series_list list;
    (void)state;
    begin(&kit);
    record(&kit, &(kit_run_desc){ ROWS(usual_rows), .samples = samples, .run_id = "x" });
    load(&list, &kit, &(fm_series_desc){ .wanted = "a", .reference = "b" });
    assert_int_equal(list.items[0].nights[0].centre.launches, 2);
    assert_true(fabs(list.items[0].nights[0].centre.ratio - 1.5) < 1e-12);
    history_series_free(&list);
    load(&list, &kit, &(fm_series_desc){ .wanted = "a" });
    assert_true(isnan(list.items[0].nights[0].centre.ratio)); /* there was no floor */
    assert_int_equal(list.items[0].alarm.verdict, FM_ALARM_UNMEASURED);
    history_series_free(&list);
    end(&kit);
}

/* A crash has no ratio, and does not hide the step beside it. */
static void steps_are_found_and_the_newest_comes_first(void **state)
{
    static const char *const crashed[] = { "method=a;k=4;status=crash;frame_ms=;frame_ms_low=;"
                                           "frame_ms_high=;device_name=;samples=0" };
    kit_history kit;
    fm_series_list list;
    (void)state;
    begin(&kit);
    for (unsigned i = 0; i < 24; i++)
        record_night(&kit, i, (i < 18 ? 30 : 33) + 0.01 * (i * 7 % 5));
    record(&kit, &(kit_run_desc){ ROWS(crashed), .samples = "", .run_id = "crash",
                                  .started = "2026-03-10T12:00:00Z" });
    load(&list, &kit, &(fm_series_desc){ 0 });
    assert_int_equal(list.count, 2);
    assert_string_equal(list.items[0].method, "a");
    assert_int_equal(list.items[0].count, 25);
    assert_string_equal(list.items[0].nights[10].status, "crash");
    assert_int_equal(list.items[0].step_count, 1);
    assert_string_equal(list.items[0].nights[list.items[0].steps[0].index].started,
                        "2026-03-19T01:00:00Z");
    assert_true(fabs(exp(list.items[0].steps[0].shift) - 1.1) < 0.005);
    assert_int_equal(list.items[1].step_count, 0);
    history_series_free(&list);
    load(&list, &kit, &(fm_series_desc){ .wanted = "a", .most = 4 });
    assert_int_equal(list.items[0].count, 4);
    assert_string_equal(list.items[0].nights[3].started, "2026-03-24T01:00:00Z");
    history_series_free(&list);
    end(&kit);
}

/* One that began in the same second is neither before nor after it. */
static void a_series_ends_with_the_run_that_is_asked_for(void **state)
{
    char texts[3][256];
    kit_history kit;
    fm_series_list list;
    (void)state;
    begin(&kit);
    for (unsigned i = 0; i < 4; i++)
        record_night(&kit, i, 30 + i);
    kit_run_desc twin = night_desc(texts, 2, 99);
    twin.run_id = "twin";
    record(&kit, &twin);
    record_night(&kit, 2, 32); /* again: its row is the newest now */
    load(&list, &kit, &(fm_series_desc){ .wanted = "a", .until = "0000000000000003" });
    assert_int_equal(list.items[0].count, 3);
    assert_string_equal(list.items[0].nights[2].run_id, "0000000000000003");
    assert_string_equal(list.items[0].nights[1].run_id, "0000000000000002");
    history_series_free(&list);
    load(&list, &kit, &(fm_series_desc){ .wanted = "a", .until = "twin", .most = 2 });
    assert_int_equal(list.items[0].count, 2);
    assert_string_equal(list.items[0].nights[1].run_id, "twin");
    history_series_free(&list);
    end(&kit);
}

/* Those of other machines, or of other cases alone, say nothing of it. */
static void newer_runs_are_those_of_its_machine_and_cases(void **state)
{
    static const char machine[] = "\"cpu\": \"EPYC\", \"cores\": 2, \"memory_bytes\": 2000000";
    static const char *const others[] = { "method=c;k=4;case_id=z" };
    char texts[3][256];
    kit_history kit;
    fm_history *history;
    fm_newer_runs newer;
    (void)state;
    begin(&kit);
    for (unsigned i = 0; i < 3; i++)
        record_night(&kit, i, 30);
    kit_run_desc elsewhere = night_desc(texts, 3, 30);
    elsewhere.machine = machine;
    record(&kit, &elsewhere);
    record(&kit, &(kit_run_desc){ ROWS(others), .samples = "", .run_id = "other",
                                  .started = "2026-03-09T01:00:00Z" });
    assert_int_equal(history_open(&history, kit.path, FM_HISTORY_READ, &kit.err), FM_OK);
    assert_int_equal(history_newer_runs(&newer, history, "0000000000000001", &kit.err), FM_OK);
    assert_int_equal(newer.count, 2);
    assert_string_equal(newer.last, "2026-03-03T01:00:00Z");
    assert_int_equal(history_newer_runs(&newer, history, "0000000000000003", &kit.err), FM_OK);
    assert_int_equal(newer.count, 0);
    assert_string_equal(newer.last, "");
    history_close(history);
    end(&kit);
}

/* Three nights after the step it rings: both series share the level. */
static void the_alarm_is_of_the_last_nights(void **state)
{
    kit_history kit;
    fm_series_list list;
    (void)state;
    begin(&kit);
    for (unsigned i = 0; i < 28; i++)
        record_night(&kit, i, (i < 25 ? 30 : 33) + 0.01 * (i * 7 % 5));
    load(&list, &kit, &(fm_series_desc){ .wanted = "a" });
    assert_int_equal(list.items[0].alarm.verdict, FM_ALARM_STEP);
    assert_true(fabs(list.items[0].alarm.level - 0.05 / 30 / 2) < 1e-12);
    history_series_free(&list);
    end(&kit);
}

static void expect_unknown(kit_history *kit, const fm_series_desc *desc, const char *words)
{
    fm_history *history;
    fm_series_list list;
    assert_int_equal(history_open(&history, kit->path, FM_HISTORY_READ, &kit->err), FM_OK);
    assert_int_equal(history_series(&list, history, desc, &kit->err), FM_UNSUPPORTED);
    assert_non_null(strstr(kit->err.message, words));
    history_series_free(&list);
    history_close(history);
}

static void unknown_names_are_answered_with_the_nearest(void **state)
{
    static const char *const rows[] = { "method=kplus-array" };
    kit_history kit;
    (void)state;
    begin(&kit);
    record(&kit, &(kit_run_desc){ ROWS(rows), .samples = "", .run_id = "x" });
    expect_unknown(&kit, &(fm_series_desc){ .wanted = "kplus-aray" }, "'kplus-array'");
    expect_unknown(&kit, &(fm_series_desc){ .reference = "kplus-aray" }, "'kplus-array'");
    expect_unknown(&kit, &(fm_series_desc){ .machine = "00000000" }, "machine '00000000'");
    expect_unknown(&kit, &(fm_series_desc){ .until = "y" }, "run 'y'");
    end(&kit);
}

static void a_run_without_a_place_is_refused(void **state)
{
    const kit_run_desc runs[] = {
        { ROWS(usual_rows), .samples = "" },
        { ROWS(usual_rows), .samples = "", .run_id = "x", .started = "" },
        { ROWS(usual_rows), .samples = "", .run_id = "x", .machine = "\"cores\": 2" },
    };
    kit_history kit;
    fm_history *history;
    (void)state;
    begin(&kit);
    for (size_t i = 0; i < 3; i++) {
        fm_recorded recorded;
        kit_run run;
        kit_open(&run, &runs[i]);
        assert_int_equal(history_open(&history, kit.path, FM_HISTORY_WRITE, &kit.err), FM_OK);
        assert_int_equal(history_record(&recorded, history, run.results, &kit.err), FM_UNSUPPORTED);
        history_close(history);
        kit_close(&run);
    }
    assert_int_equal(count_runs(&kit), 0);
    end(&kit);
}

static void run_sql(const char *path, const char *sql)
{
    sqlite3 *sqlite;
    assert_int_equal(sqlite3_open(path, &sqlite), SQLITE_OK);
    assert_int_equal(sqlite3_exec(sqlite, sql, NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(sqlite);
}

static void expect_refused(kit_history *kit, const char *words)
{
    for (int use = FM_HISTORY_READ; use <= FM_HISTORY_WRITE; use++) {
        fm_history *history;
        assert_int_equal(history_open(&history, kit->path, (fm_history_use)use, &kit->err),
                         FM_INVALID);
        assert_null(history);
        if (strstr(kit->err.message, words) == NULL || strstr(kit->err.message, kit->path) == NULL)
            fail_msg("'%s' does not say '%s'", kit->err.message, words);
    }
}

static void write_bytes(const char *path, const char *bytes)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(bytes, file) >= 0);
    fclose(file);
}

static void foreign_files_are_refused_and_stay(void **state)
{
    struct stat info;
    kit_history kit;
    (void)state;
    begin(&kit);
    write_bytes(kit.path, "this is no database, and long enough to be taken for one, perhaps");
    expect_refused(&kit, "no history of fragmark");
    assert_int_equal(stat(kit.path, &info), 0);
    assert_int_equal(info.st_size, 65);
    assert_int_equal(remove(kit.path), 0);
    run_sql(kit.path, "CREATE TABLE other(x); INSERT INTO other VALUES(1)");
    expect_refused(&kit, "another program");
    run_sql(kit.path, "SELECT x FROM other");
    assert_int_equal(remove(kit.path), 0);
    assert_int_equal(mkdir(kit.path, 0777), 0);
    expect_refused(&kit, "a folder");
    assert_int_equal(rmdir(kit.path), 0);
    assert_int_equal(mkfifo(kit.path, 0666), 0);
    expect_refused(&kit, "a pipe");
    end(&kit);
}

/* Pages that are gone, or that something else was written over; another version; a table less. */
static void damaged_and_newer_files_are_refused(void **state)
{
    struct stat info;
    kit_history kit;
    (void)state;
    begin(&kit);
    record_night(&kit, 0, 30);
    run_sql(kit.path, "PRAGMA user_version = 99");
    expect_refused(&kit, "version 99");
    run_sql(kit.path, "PRAGMA user_version = 2");
    assert_int_equal(count_runs(&kit), 1);
    assert_int_equal(stat(kit.path, &info), 0);
    FILE *file = fopen(kit.path, "r+b");
    assert_non_null(file);
    for (long page = 1; page < info.st_size / 4096; page++) {
        assert_int_equal(fseek(file, page * 4096, SEEK_SET), 0);
        for (int i = 0; i < 64; i++)
            fputc(0xa5, file);
    }
    fclose(file);
    expect_refused(&kit, "damaged");
    assert_int_equal(truncate(kit.path, info.st_size / 2), 0);
    expect_refused(&kit, "damaged");
    end(&kit);
}

static void a_missing_table_is_damage(void **state)
{
    kit_history kit;
    fm_history *history;
    fm_run_list runs;
    (void)state;
    begin(&kit);
    record_night(&kit, 0, 30);
    run_sql(kit.path, "DROP TABLE machine");
    assert_int_equal(history_open(&history, kit.path, FM_HISTORY_READ, &kit.err), FM_OK);
    assert_int_equal(history_runs(&runs, history, &kit.err), FM_INVALID);
    history_runs_free(&runs);
    history_close(history);
    end(&kit);
}

/* As version 1 left it, with a run that it recorded. */
static void an_older_version_is_brought_up_to_date(void **state)
{
    char pragma[64];
    kit_history kit;
    fm_series_list list;
    (void)state;
    begin(&kit);
    run_sql(kit.path, history_migration(1));
    snprintf(pragma, sizeof pragma, "PRAGMA application_id=%d; PRAGMA user_version=1",
             HISTORY_APPLICATION);
    run_sql(kit.path, pragma);
    run_sql(kit.path,
            "INSERT INTO machine VALUES(1, 'cafe', 'EPYC', '2', 1000000);"
            "INSERT INTO run VALUES(1, 'r', '2026-01-01T00:00:00Z', 'c', '0', 'x', 'd', 1)");
    assert_int_equal(count_runs(&kit), 1);
    record_night(&kit, 5, 30);
    load(&list, &kit, &(fm_series_desc){ .wanted = "a" });
    assert_string_equal(list.items[0].machine, "cafe"); /* the same hardware */
    history_series_free(&list);
    end(&kit);
}

static void without_a_history_there_is_none_to_read(void **state)
{
    kit_history kit;
    fm_history *history;
    (void)state;
    begin(&kit);
    assert_int_equal(history_open(&history, kit.path, FM_HISTORY_READ, &kit.err), FM_UNSUPPORTED);
    assert_int_not_equal(access(kit.path, F_OK), 0);
    end(&kit);
}

/* Eight processes make the file, or find it made, and add four runs each. */
static void writers_take_turns(void **state)
{
    enum { WRITERS = 8, EACH = 4 };
    kit_history kit;
    (void)state;
    begin(&kit);
    for (unsigned writer = 0; writer < WRITERS; writer++) {
        const pid_t child = fork();
        assert_true(child >= 0);
        if (child > 0)
            continue;
        for (unsigned i = 0; i < EACH; i++)
            record_night(&kit, writer * EACH + i, 30);
        _exit(0);
    }
    for (unsigned writer = 0; writer < WRITERS; writer++) {
        int status;
        assert_true(wait(&status) > 0);
        assert_int_equal(status, 0);
    }
    assert_int_equal(count_runs(&kit), WRITERS * EACH);
    end(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_that_is_added_twice_is_one_entry),
        cmocka_unit_test(cases_are_found_again_and_machines_kept_apart),
        cmocka_unit_test(a_reference_method_is_taken_of_the_same_round),
        cmocka_unit_test(steps_are_found_and_the_newest_comes_first),
        cmocka_unit_test(a_series_ends_with_the_run_that_is_asked_for),
        cmocka_unit_test(newer_runs_are_those_of_its_machine_and_cases),
        cmocka_unit_test(the_alarm_is_of_the_last_nights),
        cmocka_unit_test(unknown_names_are_answered_with_the_nearest),
        cmocka_unit_test(a_run_without_a_place_is_refused),
        cmocka_unit_test(foreign_files_are_refused_and_stay),
        cmocka_unit_test(damaged_and_newer_files_are_refused),
        cmocka_unit_test(a_missing_table_is_damage),
        cmocka_unit_test(an_older_version_is_brought_up_to_date),
        cmocka_unit_test(without_a_history_there_is_none_to_read),
        cmocka_unit_test(writers_take_turns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
