#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "kit/fake_plan.h"
#include "results/journal.h"

static const char *const NO_IDS[] = { NULL };
static const char PLAN[] = "0123456789abcdef";
static const fm_journal_plan the_plan = { .hash = PLAN };

/* What a replay told, as text: "begin a 0|end a 0 ok|". */
typedef struct heard {
    char text[512];
} heard;

static fm_status hear(void *context, fm_journal_event event, const char *case_id, uint32_t launch,
                      const json_t *result, fm_error *err)
{
    static const char *const names[] = {
        "begin", "end", "died", "stop", "more", "enough", "forget"
    };
    heard *all = context;
    const size_t length = strlen(all->text);
    (void)err;
    snprintf(all->text + length, sizeof all->text - length, "%s %s %u%s%s|", names[event], case_id,
             launch, result != NULL ? " " : "",
             result != NULL ? json_string_value(json_object_get(result, "status")) : "");
    return FM_OK;
}

static fm_journal *opened(const fake_plan *fake)
{
    fm_journal *journal = NULL;
    bool is_damaged = true;
    fm_error err = { 0 };
    if (journal_open(&journal, fake->folder, &the_plan, &is_damaged, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_false(is_damaged);
    return journal;
}

static void write_case(fm_journal *journal, const char *id)
{
    json_t *result = json_pack("{s:s}", "status", "ok");
    assert_int_equal(journal_write(journal, FM_JOURNAL_BEGIN, id, 0, NULL, NULL), FM_OK);
    assert_int_equal(journal_write(journal, FM_JOURNAL_END, id, 0, result, NULL), FM_OK);
    json_decref(result);
}

static void replayed(heard *all, const fake_plan *fake)
{
    bool is_damaged = false;
    const fm_journal_reader reader = { .line = hear, .context = all };
    fm_error err = { 0 };
    fm_journal *journal = opened(fake);
    if (journal_replay(journal, &reader, &is_damaged, &err) != FM_OK)
        fail_msg("%s", err.message);
    journal_close(journal);
}

static void journal_tells_again_what_was_written(void **state)
{
    (void)state;
    fake_plan fake;
    heard all = { "" };
    fake_open(&fake, NO_IDS, 1);
    fm_journal *journal = opened(&fake);
    write_case(journal, "a");
    json_t *death = json_pack("{s:s}", "status", "crash");
    assert_int_equal(journal_write(journal, FM_JOURNAL_DIED, "b", 3, death, NULL), FM_OK);
    json_decref(death);
    assert_int_equal(journal_write(journal, FM_JOURNAL_STOP, "b", 3, NULL, NULL), FM_OK);
    journal_close(journal);
    replayed(&all, &fake);
    assert_string_equal(all.text, "begin a 0|end a 0 ok|died b 3 crash|stop b 3|");
    fake_close(&fake);
}

static void journal_keeps_the_runs_id_and_start(void **state)
{
    (void)state;
    fake_plan fake;
    char run_id[32], started[32];
    fake_open(&fake, NO_IDS, 1);
    fm_journal *journal = opened(&fake);
    snprintf(run_id, sizeof run_id, "%s", journal_run_id(journal));
    snprintf(started, sizeof started, "%s", journal_started(journal));
    journal_close(journal);
    journal = opened(&fake);
    assert_int_equal(strlen(run_id), 16);
    assert_string_equal(journal_run_id(journal), run_id);
    assert_string_equal(journal_started(journal), started);
    journal_close(journal);
    fake_close(&fake);
}

static void journal_cuts_a_torn_last_line_off(void **state)
{
    (void)state;
    fake_plan fake;
    heard all = { "" }, again = { "" };
    fake_open(&fake, NO_IDS, 1);
    fm_journal *journal = opened(&fake);
    write_case(journal, "a");
    journal_close(journal);
    fake_write(&fake, "journal.jsonl", "{\"event\":\"begin\",\"ca", "a");
    replayed(&all, &fake);
    assert_string_equal(all.text, "begin a 0|end a 0 ok|");
    replayed(&again, &fake); /* what follows is not glued to the torn piece */
    assert_string_equal(again.text, all.text);
    fake_close(&fake);
}

static void journal_tells_of_what_is_forgotten_in_its_place(void **state)
{
    (void)state;
    fake_plan fake;
    heard all = { "" };
    bool is_damaged = false;
    const fm_journal_reader reader = { .line = hear, .context = &all };
    fake_open(&fake, NO_IDS, 1);
    fm_journal *journal = opened(&fake);
    write_case(journal, "a");
    assert_int_equal(journal_write(journal, FM_JOURNAL_FORGET, "a", 0, NULL, NULL), FM_OK);
    write_case(journal, "a");
    assert_int_equal(journal_replay(journal, &reader, &is_damaged, NULL), FM_OK);
    assert_string_equal(all.text, "begin a 0|end a 0 ok|forget a 0|begin a 0|end a 0 ok|");
    journal_close(journal);
    fake_close(&fake);
}

static void journal_starts_anew_after_a_torn_first_line(void **state)
{
    (void)state;
    fake_plan fake;
    heard all = { "" };
    fake_open(&fake, NO_IDS, 1);
    fake_write(&fake, "journal.jsonl", "{\"event\":\"pl", "w");
    replayed(&all, &fake);
    assert_string_equal(all.text, "");
    fake_close(&fake);
}

static void journal_reports_damage_with_its_line(void **state)
{
    (void)state;
    fake_plan fake;
    heard all = { "" };
    bool is_damaged = false;
    const fm_journal_reader reader = { .line = hear, .context = &all };
    fm_error err = { 0 };
    fake_open(&fake, NO_IDS, 1);
    journal_close(opened(&fake));
    fake_write(&fake, "journal.jsonl", "{\"event\":\"begin\",\"launch\":0}\n", "a");
    fm_journal *journal = opened(&fake);
    assert_int_equal(journal_replay(journal, &reader, &is_damaged, &err), FM_IO);
    assert_true(is_damaged);
    assert_non_null(strstr(err.message, "journal.jsonl:2: damaged"));
    journal_close(journal);
    fake_close(&fake);
}

/* A journal of three good lines, with bad ones between and a torn one at the end. */
static void assert_damaged(const char *bad, size_t bad_bytes, const char *words)
{
    fake_plan fake;
    heard all = { "" };
    bool is_damaged = false;
    const fm_journal_reader reader = { .line = hear, .context = &all };
    fm_error err = { 0 };
    char path[128];
    fake_open(&fake, NO_IDS, 1);
    fm_journal *journal = opened(&fake);
    write_case(journal, "a");
    journal_close(journal);
    snprintf(path, sizeof path, "%s/journal.jsonl", fake.folder);
    FILE *file = fopen(path, "a");
    assert_int_equal(fwrite(bad, 1, bad_bytes, file), bad_bytes);
    fclose(file);
    fake_write(&fake, "journal.jsonl", "\n{\"event\":\"begin\",\"case\":\"b\",\"launch\":0}\n{\"ev",
               "a");
    char *before = NULL, *after = NULL;
    size_t before_count = 0, after_count = 0;
    text_read_file(&before, &before_count, path, 1u << 20, NULL);
    journal = opened(&fake);
    const fm_status status = journal_replay(journal, &reader, &is_damaged, &err);
    journal_close(journal);
    text_read_file(&after, &after_count, path, 1u << 20, NULL);
    if (status != FM_IO || !is_damaged || strstr(err.message, words) == NULL ||
        strstr(err.message, "journal.jsonl:4: damaged: ") == NULL ||
        strstr(err.message, "4 of 5 lines can be used: `sed -i.damaged '4d' '") == NULL)
        fail_msg("%d, \"%s\" lacks \"%s\"", status, err.message, words);
    assert_int_equal(before_count, after_count);
    assert_memory_equal(before, after, before_count);
    free(before);
    free(after);
    fake_close(&fake);
}

static void journal_says_of_each_damage_what_is_wrong(void **state)
{
    (void)state;
#define DAMAGED(text, words) assert_damaged(text, sizeof(text) - 1, words)
    DAMAGED("", "not JSON");
    DAMAGED("\0\0\0\0", "not JSON");
    DAMAGED("{\"event\":\"begin\",\"case\":\"b\",\"launch\":1}\0{}", "not JSON");
    DAMAGED("{\"event\":\"begin\",\"case\":\"b\\u0000\",\"launch\":1}", "not JSON");
    DAMAGED("{\"event\":\"begin\",\"case\":\"b\",\"launch\":1,\"launch\":1}", "not JSON: dup");
    DAMAGED("{\"event\":\"begin\",\"case\":\"b\",\"launch\":1}{\"event\"", "not JSON");
    DAMAGED("{\"event\":\"begin\",\"case\":\"b\",\"launch\":1e400}", "not JSON");
    DAMAGED("{\"event\":\"begin\",\"case\":\"b\",\"launch\":4294967296}", "fragmark writes");
    DAMAGED("{\"event\":\"begin\",\"case\":\"b\",\"launch\":-1}", "fragmark writes");
    DAMAGED("{\"event\":\"begin\",\"case\":\"b\",\"launch\":1.5}", "fragmark writes");
    DAMAGED("{\"event\":\"begin\",\"case\":7,\"launch\":1}", "fragmark writes");
    DAMAGED("{\"event\":\"begun\",\"case\":\"b\",\"launch\":1}", "fragmark writes");
    DAMAGED("{\"event\":\"end\",\"case\":\"b\",\"launch\":1}", "fragmark writes");
    DAMAGED("{\"event\":\"end\",\"case\":\"b\",\"launch\":1,\"result\":[]}", "fragmark writes");
    DAMAGED("{\"event\":\"stop\",\"case\":\"b\",\"launch\":1,\"result\":{}}", "fragmark writes");
    DAMAGED("[]", "fragmark writes");
#undef DAMAGED
}

static void journal_names_all_damaged_lines(void **state)
{
    (void)state;
    fake_plan fake;
    heard all = { "" };
    bool is_damaged = false;
    const fm_journal_reader reader = { .line = hear, .context = &all };
    fm_error err = { 0 };
    fake_open(&fake, NO_IDS, 1);
    journal_close(opened(&fake));
    fake_write(&fake, "journal.jsonl", "{}\n{\"event\":\"begin\",\"case\":\"b\",\"launch\":0}\nx\n",
               "a");
    fm_journal *journal = opened(&fake);
    assert_int_equal(journal_replay(journal, &reader, &is_damaged, &err), FM_IO);
    assert_non_null(strstr(err.message, "2 of 4 lines can be used: `sed -i.damaged '2d;4d' '"));
    journal_close(journal);
    for (int i = 0; i < 20; i++)
        fake_write(&fake, "journal.jsonl", "x\n", "a");
    journal = opened(&fake);
    assert_int_equal(journal_replay(journal, &reader, &is_damaged, &err), FM_IO);
    assert_non_null(strstr(err.message, "1 of 24 lines can be used: `sed -i.damaged '2,$d' '"));
    journal_close(journal);
    fake_close(&fake);
}

static fm_status without_room(void *context, fm_journal_event event, const char *case_id,
                              uint32_t launch, const json_t *result, fm_error *err)
{
    (void)context, (void)event, (void)case_id, (void)launch, (void)result;
    return fm_fail(err, FM_IO, "samples.csv: No space left on device");
}

static void journal_is_not_damaged_if_what_hears_it_fails(void **state)
{
    (void)state;
    fake_plan fake;
    bool is_damaged = true;
    const fm_journal_reader reader = { .line = without_room };
    fm_error err = { 0 };
    fake_open(&fake, NO_IDS, 1);
    fm_journal *journal = opened(&fake);
    write_case(journal, "a");
    assert_int_equal(journal_replay(journal, &reader, &is_damaged, &err), FM_IO);
    assert_false(is_damaged);
    assert_string_equal(err.message, "samples.csv: No space left on device");
    journal_close(journal);
    fake_close(&fake);
}

static void journal_refuses_a_pipe_without_waiting(void **state)
{
    (void)state;
    fake_plan fake;
    fm_journal *journal = NULL;
    bool is_damaged = false;
    char path[128];
    fm_error err = { 0 };
    fake_open(&fake, NO_IDS, 1);
    snprintf(path, sizeof path, "%s/journal.jsonl", fake.folder);
    assert_int_equal(mkfifo(path, 0666), 0);
    alarm(10);
    assert_int_equal(journal_open(&journal, fake.folder, &the_plan, &is_damaged, &err), FM_IO);
    alarm(0);
    assert_true(is_damaged);
    assert_non_null(strstr(err.message, "is a pipe, not a file"));
    fake_close(&fake);
}

static void refuses(const char *content, const char *plan, fm_status expected, const char *words,
                    bool damage)
{
    fake_plan fake;
    fm_journal *journal = NULL;
    bool is_damaged = false;
    fm_error err = { 0 };
    const fm_journal_plan given = { .hash = plan };
    fake_open(&fake, NO_IDS, 1);
    if (content != NULL)
        fake_write(&fake, "journal.jsonl", content, "w");
    else
        journal_close(opened(&fake));
    assert_int_equal(journal_open(&journal, fake.folder, &given, &is_damaged, &err), expected);
    assert_null(journal);
    assert_int_equal(is_damaged, damage);
    assert_non_null(strstr(err.message, words));
    fake_close(&fake);
}

static void journal_refuses_foreign_files_and_leaves_them(void **state)
{
    (void)state;
    refuses("shopping list", PLAN, FM_IO, "not the journal", true);
    refuses("{\"event\":\"other\"}\n", PLAN, FM_IO, "not the journal", true);
    refuses("{\"event\":\"plan\",\"plan\":\"0123456789abcdef\",\"run_id\":\"a,b\",\"started\":"
            "\"2026\"}\n",
            PLAN, FM_IO, "not the journal", true);
    refuses("{\"event\":\"plan\",\"plan\":\"0123456789abcdef\",\"run_id\":\"0123456789abcdef\","
            "\"run_id\":\"0123456789abcdef\",\"started\":\"2026\"}\n",
            PLAN, FM_IO, "not the journal", true);
}

static void journal_refuses_another_plan(void **state)
{
    (void)state;
    refuses(NULL, "fedcba9876543210", FM_INVALID, "another plan", false);
}

static void journal_refuses_a_folder_in_use(void **state)
{
    (void)state;
    fake_plan fake;
    fm_journal *second = NULL;
    bool is_damaged = true;
    fm_error err = { 0 };
    fake_open(&fake, NO_IDS, 1);
    fm_journal *first = opened(&fake);
    assert_int_equal(journal_open(&second, fake.folder, &the_plan, &is_damaged, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "another run is writing here"));
    journal_close(first);
    fake_close(&fake);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(journal_tells_again_what_was_written),
        cmocka_unit_test(journal_keeps_the_runs_id_and_start),
        cmocka_unit_test(journal_cuts_a_torn_last_line_off),
        cmocka_unit_test(journal_tells_of_what_is_forgotten_in_its_place),
        cmocka_unit_test(journal_starts_anew_after_a_torn_first_line),
        cmocka_unit_test(journal_reports_damage_with_its_line),
        cmocka_unit_test(journal_refuses_foreign_files_and_leaves_them),
        cmocka_unit_test(journal_says_of_each_damage_what_is_wrong),
        cmocka_unit_test(journal_names_all_damaged_lines),
        cmocka_unit_test(journal_is_not_damaged_if_what_hears_it_fails),
        cmocka_unit_test(journal_refuses_a_pipe_without_waiting),
        cmocka_unit_test(journal_refuses_another_plan),
        cmocka_unit_test(journal_refuses_a_folder_in_use),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
