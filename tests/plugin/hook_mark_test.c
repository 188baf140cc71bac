/* What a process that dies in a hook leaves for whoever finds it. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/text.h"
#include "plugin/hook_mark.h"

static char folder[] = "/tmp/fragmark-test-XXXXXX", path[64];

static int make_folder(void **state)
{
    (void)state;
    if (mkdtemp(folder) == NULL)
        return -1;
    snprintf(path, sizeof path, "%s/mark", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(path);
    return rmdir(folder);
}

/* In a process of its own, which ends as no code of ours can see coming. */
static void die_in(fm_hook hook, const char *pass)
{
    const pid_t child = fork();
    int status;
    if (child == 0) {
        fm_hook_mark *mark = hook_mark_open(path, "/plugins/kb/kb.so");
        hook_enter(mark, FM_HOOK_LOAD);
        hook_leave(mark, FM_HOOK_LOAD);
        hook_mark_pass(mark, pass);
        if (hook < FM_HOOK_COUNT)
            hook_enter(mark, hook);
        kill(getpid(), SIGKILL);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status));
}

static void mark_tells_the_hook_that_ran(void **state)
{
    static const struct {
        fm_hook hook;
        const char *pass, *told;
    } rows[] = {
        { FM_HOOK_LOAD, "", "while kb.so was loaded" },
        { FM_HOOK_AFTER, "ask", "in hook 'after' of kb.so, pass 'ask'" },
        { FM_HOOK_PREDICT, "", "in hook 'predict' of kb.so" },
        { FM_HOOK_PLACE, "", "in hook 'place' of kb.so" },
        { FM_HOOK_SIGN, "", "in hook 'sign' of kb.so" },
        { FM_HOOK_SKIP, "", "in hook 'skip' of kb.so" },
        { FM_HOOK_TILE_END, "", "in hook 'tile_end' of kb.so" },
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char told[HOOK_MARK_TOLD_BYTES];
        die_in(rows[i].hook, rows[i].pass);
        assert_true(hook_mark_read(told, path));
        assert_string_equal(told, rows[i].told);
    }
}

static void mark_tells_nothing_outside_of_hooks(void **state)
{
    char told[HOOK_MARK_TOLD_BYTES];
    (void)state;
    die_in(FM_HOOK_COUNT, "ask");
    assert_false(hook_mark_read(told, path));
    unlink(path);
    assert_false(hook_mark_read(told, path));
}

static void mark_of_several_threads_tells_all_their_hooks(void **state)
{
    char told[HOOK_MARK_TOLD_BYTES];
    (void)state;
    fm_hook_mark *mark = hook_mark_open(path, "t.so");
    assert_non_null(mark);
    hook_enter(mark, FM_HOOK_SKIP);
    hook_enter(mark, FM_HOOK_SKIP);
    hook_enter(mark, FM_HOOK_TILE_END);
    hook_leave(mark, FM_HOOK_SKIP);
    assert_true(hook_mark_read(told, path));
    assert_string_equal(told, "in hook 'skip' or 'tile_end' of t.so");
    hook_mark_close(mark);
}

/* A plugin may write anything into its process's memory. */
static void mark_that_was_scribbled_on_is_read_with_care(void **state)
{
    char told[HOOK_MARK_TOLD_BYTES], bytes[sizeof(fm_hook_mark)];
    (void)state;
    memset(bytes, 'x', sizeof bytes);
    assert_int_equal(text_write_file(path, bytes, sizeof bytes, NULL), FM_OK);
    assert_true(hook_mark_read(told, path));
    assert_true(strlen(told) < sizeof told);
    memset(bytes, '\n', sizeof bytes);
    assert_int_equal(text_write_file(path, bytes, sizeof bytes, NULL), FM_OK);
    assert_true(hook_mark_read(told, path));
    assert_null(strchr(told, '\n'));
    for (size_t count = 0; count < sizeof bytes; count += 7) {
        assert_int_equal(text_write_file(path, bytes, count, NULL), FM_OK);
        assert_false(hook_mark_read(told, path));
    }
}

static void without_a_file_hooks_are_called_all_the_same(void **state)
{
    (void)state;
    assert_null(hook_mark_open("/nowhere/mark", "kb.so"));
    hook_enter(NULL, FM_HOOK_AFTER);
    hook_mark_pass(NULL, "ask");
    hook_leave(NULL, FM_HOOK_AFTER);
    hook_mark_close(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mark_tells_the_hook_that_ran),
        cmocka_unit_test(mark_tells_nothing_outside_of_hooks),
        cmocka_unit_test(mark_of_several_threads_tells_all_their_hooks),
        cmocka_unit_test(mark_that_was_scribbled_on_is_read_with_care),
        cmocka_unit_test(without_a_file_hooks_are_called_all_the_same),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
