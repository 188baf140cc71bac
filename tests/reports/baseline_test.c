/* Named runs: what is copied, which machine's is found, what is noticed. */
#include "compare_kit.h"

#include <sys/stat.h>
#include <unistd.h>

#include "baseline/baseline.h"

typedef struct kit_store {
    char path[64];
    fm_error err;
} kit_store;

static const char *const rows[] = { "k=4" };
static const char other_machine[] =
    "\"cpu\": \"Xeon\", \"cores\": 8, \"memory_bytes\": 2000000, \"kernel\": \"6.1\"";

static void begin(kit_store *store)
{
    snprintf(store->path, sizeof store->path, "/tmp/fragmark-baselines-XXXXXX");
    assert_non_null(mkdtemp(store->path));
}

static void end(kit_store *store)
{
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", store->path);
    assert_int_equal(system(command), 0);
}

static void set(kit_store *store, const char *name, const char *machine, const char *run_id)
{
    char path[FM_PATH_MAX_BYTES];
    kit_run run;
    kit_open(&run, &(kit_run_desc){ ROWS(rows), .machine = machine, .run_id = run_id });
    if (baseline_set(path, store->path, name, run.results, &store->err) != FM_OK)
        fail_msg("%s", store->err.message);
    kit_close(&run); /* the baseline outlives it */
}

/* Finds for a run of a machine, and reads what was found. */
static fm_status find(char run_id[32], kit_store *store, const char *wanted, const char *machine)
{
    char path[FM_PATH_MAX_BYTES];
    kit_run now;
    fm_result_files *found = NULL;
    kit_open(&now, &(kit_run_desc){ ROWS(rows), .machine = machine });
    const fm_status status =
        baseline_find(path, store->path, wanted, now.results->manifest, &store->err);
    if (status == FM_OK) {
        assert_int_equal(result_files_read(&found, path, &store->err), FM_OK);
        snprintf(run_id, 32, "%s", provenance_fact(found->manifest, "run_id"));
        assert_int_equal(found->count, 1);
    }
    result_files_close(found);
    kit_close(&now);
    return status;
}

static void a_baseline_is_that_of_the_machine(void **state)
{
    char run_id[32];
    kit_store store;
    (void)state;
    begin(&store);
    set(&store, "release-1", NULL, "here");
    set(&store, "release-1", other_machine, "there");
    assert_int_equal(find(run_id, &store, "release-1", NULL), FM_OK);
    assert_string_equal(run_id, "here");
    assert_int_equal(find(run_id, &store, "release-1", other_machine), FM_OK);
    assert_string_equal(run_id, "there");
    end(&store);
}

/* The kernel of an update counts a little less memory. */
static void setting_again_replaces_that_of_the_same_machine(void **state)
{
    static const char updated[] = "\"cpu\": \"EPYC\", \"cores\": 2, \"memory_bytes\": 995000";
    char run_id[32];
    kit_store store;
    fm_baseline_list list;
    (void)state;
    begin(&store);
    set(&store, "a", NULL, "first");
    set(&store, "a", updated, "second");
    assert_int_equal(baselines_read(&list, store.path, NULL, &store.err), FM_OK);
    assert_int_equal(list.count, 1);
    assert_string_equal(baseline_fact(&list.items[0], "run_id"), "second");
    baselines_free(&list);
    assert_int_equal(find(run_id, &store, "a", NULL), FM_OK);
    assert_string_equal(run_id, "second");
    end(&store);
}

static void append(const char *folder, const char *name, const char *bytes)
{
    char path[FM_PATH_MAX_BYTES + 32];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "a");
    assert_non_null(file);
    assert_true(fputs(bytes, file) >= 0);
    fclose(file);
}

/* Folders of a process that had the same number, with a file that the new run has not. */
static void what_a_killed_process_left_is_no_part_of_it(void **state)
{
    static const char *const ends[] = { "", "-0", "-1" };
    char run_id[32], folder[96], path[192];
    kit_store store;
    (void)state;
    begin(&store);
    snprintf(folder, sizeof folder, "%s/a", store.path);
    assert_int_equal(mkdir(folder, 0777), 0);
    for (size_t i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/.partial-%ld%s", folder, (long)getpid(), ends[i]);
        assert_int_equal(mkdir(path, 0777), 0);
        append(path, "journal.jsonl", "{}\n");
    }
    set(&store, "a", NULL, "new");
    assert_int_equal(find(run_id, &store, "a", NULL), FM_OK); /* checked: without a journal */
    assert_string_equal(run_id, "new");
    end(&store);
}

static void what_is_not_there_is_told(void **state)
{
    char run_id[32], wanted[64];
    kit_store store;
    fm_baseline_list list;
    (void)state;
    begin(&store);
    assert_int_equal(find(run_id, &store, "release-1", NULL), FM_UNSUPPORTED);
    assert_non_null(strstr(store.err.message, "baseline set"));
    set(&store, "release-1", other_machine, "there");
    assert_int_equal(find(run_id, &store, "release-2", NULL), FM_UNSUPPORTED);
    assert_non_null(strstr(store.err.message, "'release-1'"));
    assert_int_equal(find(run_id, &store, "release-1", NULL), FM_UNSUPPORTED);
    assert_non_null(strstr(store.err.message, "Xeon"));
    assert_int_equal(baselines_read(&list, store.path, "release-1", &store.err), FM_OK);
    snprintf(wanted, sizeof wanted, "release-1@%s", list.items[0].machine);
    baselines_free(&list);
    assert_int_equal(find(run_id, &store, wanted, NULL), FM_OK); /* asked for by its machine */
    end(&store);
}

static void changed_files_are_noticed(void **state)
{
    static const char *const names[] = { "summary.csv", "samples.csv", "manifest.json" };
    char run_id[32];
    kit_store store;
    fm_baseline_list list;
    (void)state;
    begin(&store);
    for (size_t i = 0; i < 3; i++) {
        set(&store, "a", NULL, "x");
        assert_int_equal(baselines_read(&list, store.path, "a", &store.err), FM_OK);
        assert_int_equal(baseline_check(&list.items[0], &store.err), FM_OK);
        append(list.items[0].path, names[i], "\n");
        assert_int_equal(baseline_check(&list.items[0], &store.err), FM_INVALID);
        assert_non_null(strstr(store.err.message, names[i]));
        assert_int_equal(find(run_id, &store, "a", NULL), FM_INVALID);
        append(list.items[0].path, "journal.jsonl", "{}\n"); /* one that was not copied */
        assert_int_equal(baseline_check(&list.items[0], &store.err), FM_INVALID);
        baselines_free(&list);
    }
    end(&store);
}

static void a_damaged_description_is_refused(void **state)
{
    char run_id[32], path[FM_PATH_MAX_BYTES + 32];
    kit_store store;
    fm_baseline_list list;
    (void)state;
    begin(&store);
    set(&store, "a", NULL, "x");
    assert_int_equal(baselines_read(&list, store.path, "a", &store.err), FM_OK);
    append(list.items[0].path, "baseline.json", "}");
    assert_int_equal(find(run_id, &store, "a", NULL), FM_INVALID);
    snprintf(path, sizeof path, "%s/baseline.json", list.items[0].path);
    assert_int_equal(remove(path), 0);
    append(list.items[0].path, "baseline.json", "{\"schema\": 2}");
    assert_int_equal(find(run_id, &store, "a", NULL), FM_INVALID);
    baselines_free(&list);
    end(&store);
}

static void names_that_leave_the_store_are_refused(void **state)
{
    static const char *const names[] = { "", ".", "..", "../x", "a/b", ".hidden", "a b", "a\n" };
    char path[FM_PATH_MAX_BYTES], long_name[FM_BASELINE_NAME_BYTES + 1], run_id[32];
    kit_store store;
    kit_run run;
    (void)state;
    begin(&store);
    kit_open(&run, &(kit_run_desc){ ROWS(rows), .run_id = "x" });
    memset(long_name, 'a', sizeof long_name - 1);
    long_name[sizeof long_name - 1] = '\0';
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        assert_int_equal(baseline_set(path, store.path, names[i], run.results, &store.err),
                         FM_UNSUPPORTED);
        assert_int_equal(find(run_id, &store, names[i], NULL), FM_UNSUPPORTED);
    }
    assert_int_equal(baseline_set(path, store.path, long_name, run.results, &store.err),
                     FM_UNSUPPORTED);
    kit_close(&run);
    assert_int_equal(rmdir(store.path), 0); /* nothing was made in it */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_baseline_is_that_of_the_machine),
        cmocka_unit_test(setting_again_replaces_that_of_the_same_machine),
        cmocka_unit_test(what_a_killed_process_left_is_no_part_of_it),
        cmocka_unit_test(what_is_not_there_is_told),
        cmocka_unit_test(changed_files_are_noticed),
        cmocka_unit_test(a_damaged_description_is_refused),
        cmocka_unit_test(names_that_leave_the_store_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
