/* Processes, with shell scripts in their place. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/text.h"
#include "process/process.h"

/* A folder that the scripts are in while they run. */
typedef struct scratch {
    char folder[64], log[96];
} scratch;

static void scratch_open(scratch *here)
{
    snprintf(here->folder, sizeof here->folder, "/tmp/fragmark-process-XXXXXX");
    assert_non_null(mkdtemp(here->folder));
    snprintf(here->log, sizeof here->log, "%s/log", here->folder);
    assert_int_equal(chdir(here->folder), 0);
}

static void scratch_close(const scratch *here)
{
    char command[96];
    assert_int_equal(chdir("/"), 0);
    snprintf(command, sizeof command, "rm -rf %s", here->folder);
    assert_int_equal(system(command), 0);
}

static fm_process_end run_script(const char *script, fm_process_desc desc)
{
    fm_process_end end;
    fm_error err = { 0 };
    const char *const argv[] = { "sh", "-c", script, NULL };
    desc.path = "/bin/sh";
    desc.argv = argv;
    if (process_run(&end, NULL, &desc, &err) != FM_OK)
        fail_msg("%s", err.message);
    return end;
}

/* The number that a script left in a file; 0: not yet. */
static pid_t pid_in(const char *path)
{
    char *bytes = NULL;
    size_t count = 0;
    if (text_read_file(&bytes, &count, path, 100, NULL) != FM_OK)
        return 0;
    const pid_t pid = count > 0 && bytes[count - 1] == '\n' ? (pid_t)strtol(bytes, NULL, 10) : 0;
    free(bytes);
    return pid;
}

/* Also that of a zombie that nobody has reaped yet. */
static bool lives(pid_t pid)
{
    char path[64], state = 'X';
    snprintf(path, sizeof path, "/proc/%d/stat", pid);
    FILE *file = fopen(path, "r");
    if (file == NULL)
        return false;
    assert_int_equal(fscanf(file, "%*d (%*[^)]) %c", &state), 1);
    fclose(file);
    return state != 'Z' && state != 'X';
}

static bool dies_within(pid_t pid, double seconds)
{
    const double deadline = clock_s() + seconds;
    while (lives(pid) && clock_s() < deadline)
        usleep(10000);
    return !lives(pid);
}

static void process_tells_how_it_ended(void **state)
{
    (void)state;
    fm_process_end end = run_script("echo out; echo err >&2; exit 3", (fm_process_desc){ 0 });
    assert_int_equal(WEXITSTATUS(end.wait_status), 3);
    assert_string_equal(end.words, "out\nerr\n");
    assert_true(end.peak_bytes > 100000);
    end = run_script("kill -SEGV $$", (fm_process_desc){ 0 });
    assert_true(WIFSIGNALED(end.wait_status));
    assert_int_equal(WTERMSIG(end.wait_status), SIGSEGV);
    assert_false(end.is_timed_out);
}

static void process_reads_nothing_and_inherits_nothing(void **state)
{
    (void)state;
    for (int fd = 3; fd < 10; fd++) /* what whoever runs the tests left open */
        fcntl(fd, F_SETFD, FD_CLOEXEC);
    const fm_process_end end =
        run_script("cat; for i in 3 4 5 6 7 8 9; do [ -e /proc/$$/fd/$i ] && echo $i; done; true",
                   (fm_process_desc){ 0 });
    assert_string_equal(end.words, "");
}

static void process_keeps_a_descriptor_that_it_is_given(void **state)
{
    (void)state;
    int fds[2];
    char got[8] = "", script[32];
    assert_int_equal(pipe2(fds, O_CLOEXEC), 0);
    snprintf(script, sizeof script, "echo data >&%d", fds[1]);
    run_script(script, (fm_process_desc){ .kept_fd = fds[1] });
    close(fds[1]);
    assert_int_equal(read(fds[0], got, sizeof got), 5);
    assert_int_equal(read(fds[0], got, sizeof got), 0); /* nobody holds it any more */
    close(fds[0]);
}

static void process_refuses_what_cannot_be_executed(void **state)
{
    (void)state;
    scratch here;
    fm_process_end end;
    fm_error err = { 0 };
    const char *const argv[] = { "x", NULL };
    scratch_open(&here);
    fm_process_desc desc = { .path = "/nowhere/x", .argv = argv };
    assert_int_equal(process_run(&end, NULL, &desc, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "/nowhere/x: No such file"));
    assert_int_equal(text_write_file("odd", "\1\2", 2, NULL), FM_OK);
    assert_int_equal(chmod("odd", 0755), 0);
    desc.path = "./odd";
    assert_int_equal(process_run(&end, NULL, &desc, &err), FM_IO);
    assert_non_null(strstr(err.message, "./odd cannot be started: Exec format error"));
    scratch_close(&here);
}

static void process_needs_descriptors(void **state)
{
    (void)state;
    struct rlimit before, none;
    fm_process_end end;
    fm_error err = { 0 };
    const char *const argv[] = { "sh", "-c", "true", NULL };
    const fm_process_desc desc = { .path = "/bin/sh", .argv = argv };
    getrlimit(RLIMIT_NOFILE, &before);
    none = before;
    for (none.rlim_cur = 3; none.rlim_cur < 12; none.rlim_cur++) { /* also those of the guard */
        setrlimit(RLIMIT_NOFILE, &none);
        const fm_status status = process_run(&end, NULL, &desc, &err);
        if (status != FM_OK) {
            assert_int_equal(status, FM_IO);
            assert_non_null(strstr(err.message, "Too many open files"));
        }
    }
    setrlimit(RLIMIT_NOFILE, &before);
    assert_int_equal(process_run(&end, NULL, &desc, &err), FM_OK);
}

static void process_limits_the_log_and_keeps_its_end(void **state)
{
    (void)state;
    scratch here;
    struct stat info;
    char *bytes = NULL;
    size_t count = 0;
    scratch_open(&here);
    const fm_process_desc desc = { .log = here.log, .log_bytes = 10000 };
    const fm_process_end end =
        run_script("echo first; head -c 30000000 /dev/zero | tr '\\0' x; echo last", desc);
    assert_string_equal(end.words + strlen(end.words) - 6, "xlast\n");
    assert_int_equal(text_read_file(&bytes, &count, here.log, 100000, NULL), FM_OK);
    assert_true(count < 10000 + PROCESS_WORDS_BYTES + 100);
    assert_int_equal(memcmp(bytes, "first\nxxx", 9), 0);
    assert_non_null(strstr(bytes, " bytes were dropped]\nxxx"));
    assert_string_equal(bytes + count - 6, "xlast\n");
    free(bytes);
    run_script("head -c 100000 /dev/zero", desc); /* the next one finds it full */
    assert_int_equal(stat(here.log, &info), 0);
    assert_true(info.st_size < 10000 + 2 * (PROCESS_WORDS_BYTES + 100));
    scratch_close(&here);
}

static void process_that_is_silent_leaves_no_log(void **state)
{
    (void)state;
    scratch here;
    scratch_open(&here);
    run_script("true", (fm_process_desc){ .log = here.log });
    assert_int_not_equal(access(here.log, F_OK), 0);
    scratch_close(&here);
}

static void process_tells_of_a_log_that_cannot_be_written(void **state)
{
    (void)state;
    fm_process_end end;
    fm_error err = { 0 };
    const char *const argv[] = { "sh", "-c", "echo x", NULL };
    const fm_process_desc desc = { .path = "/bin/sh", .argv = argv, .log = "/dev/full" };
    assert_int_equal(process_run(&end, NULL, &desc, &err), FM_IO);
    assert_non_null(strstr(err.message, "/dev/full: No space left"));
}

/* A daemon: forked twice, in a session of its own, its output elsewhere. */
static const char daemon_script[] =
    "setsid sh -c 'sh -c \"echo \\$\\$ >pid; mv pid left; exec sleep 60\" >/dev/null 2>&1 &' & \n"
    "while [ ! -e left ]; do sleep 0.01; done\n";

static void process_ends_with_all_that_it_started(void **state)
{
    (void)state;
    scratch here;
    scratch_open(&here);
    const fm_process_end end = run_script(daemon_script, (fm_process_desc){ 0 });
    assert_true(WIFEXITED(end.wait_status));
    assert_true(pid_in("left") > 0);
    assert_false(lives(pid_in("left")));
    scratch_close(&here);
}

static void process_that_hangs_is_ended_with_all_that_it_started(void **state)
{
    (void)state;
    scratch here;
    char script[sizeof daemon_script + 16];
    scratch_open(&here);
    snprintf(script, sizeof script, "%ssleep 60", daemon_script);
    const fm_process_end end = run_script(script, (fm_process_desc){ .timeout_s = 0.5 });
    assert_true(end.is_timed_out);
    assert_true(end.seconds < 5.0);
    assert_false(lives(pid_in("left")));
    scratch_close(&here);
}

/* As Ctrl-Z does; the process has a group of its own, and goes on. */
static void process_that_ended_in_time_is_not_late_for_a_parent_that_was_stopped(void **state)
{
    (void)state;
    scratch here;
    int wait_status;
    scratch_open(&here);
    const pid_t parent = fork();
    if (parent == 0) {
        const fm_process_end end =
            run_script("touch ready; sleep 0.3", (fm_process_desc){ .timeout_s = 1.0 });
        _exit(end.is_timed_out || !WIFEXITED(end.wait_status) ? 1 : 0);
    }
    while (access("ready", F_OK) != 0)
        usleep(1000);
    kill(parent, SIGSTOP);
    usleep(1500000);
    kill(parent, SIGCONT);
    assert_int_equal(waitpid(parent, &wait_status, 0), parent);
    assert_int_equal(wait_status, 0);
    scratch_close(&here);
}

static void tell_to_stop(void *context)
{
    kill(getpid(), *(const int *)context);
}

static void process_is_ended_by_each_signal_that_stops_us(void **state)
{
    (void)state;
    static const int stops[] = { SIGHUP, SIGINT, SIGTERM };
    scratch here;
    fm_stop_signals signals;
    char script[sizeof daemon_script + 16];
    const char *const argv[] = { "sh", "-c", script, NULL };
    snprintf(script, sizeof script, "%ssleep 60", daemon_script);
    for (size_t i = 0; i < sizeof stops / sizeof stops[0]; i++) {
        fm_process_end end;
        int stop = stops[i];
        const fm_process_desc desc = {
            .path = "/bin/sh", .argv = argv, .tick = tell_to_stop, .context = &stop
        };
        scratch_open(&here);
        assert_int_equal(stop_signals_open(&signals, NULL), FM_OK);
        assert_int_equal(process_run(&end, &signals, &desc, NULL), FM_OK);
        stop_signals_close(&signals);
        assert_int_equal(end.stop_signal, stop);
        assert_false(lives(pid_in("left")));
        scratch_close(&here);
    }
}

/* As nohup has it, and a shell for its background jobs. */
static void signals_that_are_ignored_stop_nobody(void **state)
{
    (void)state;
    fm_stop_signals signals;
    signal(SIGHUP, SIG_IGN);
    assert_int_equal(stop_signals_open(&signals, NULL), FM_OK);
    kill(getpid(), SIGHUP);
    assert_int_equal(stop_signals_next(&signals, 0.05), 0);
    kill(getpid(), SIGTERM);
    assert_int_equal(stop_signals_next(&signals, 0.05), SIGTERM);
    stop_signals_close(&signals);
    signal(SIGHUP, SIG_DFL);
}

/* Nobody is left to end it but the guard. */
static void process_ends_when_its_parent_is_killed(void **state)
{
    (void)state;
    scratch here;
    char script[sizeof daemon_script + 64];
    scratch_open(&here);
    snprintf(script, sizeof script, "echo $$ >own; %stouch ready; sleep 60", daemon_script);
    const pid_t parent = fork();
    if (parent == 0) {
        run_script(script, (fm_process_desc){ 0 });
        _exit(0);
    }
    while (access("ready", F_OK) != 0)
        usleep(10000);
    kill(parent, SIGKILL);
    waitpid(parent, NULL, 0);
    assert_true(dies_within(pid_in("own"), 5.0));
    assert_true(dies_within(pid_in("left"), 5.0));
    scratch_close(&here);
}

/* A limit on files is an error that the process can tell. */
static void process_is_limited(void **state)
{
    (void)state;
    scratch here;
    scratch_open(&here);
    fm_process_desc desc = { .limits = { .file_bytes = 1000, .open_files = 20 } };
    fm_process_end end = run_script("ulimit -n; ulimit -c; head -c 5000 /dev/zero >big", desc);
    assert_int_equal(strncmp(end.words, "20\n0\n", 5), 0);
    assert_non_null(strstr(end.words, "File too large"));
    assert_true(WIFEXITED(end.wait_status));
    desc = (fm_process_desc){ .limits = { .cpu_s = 1 } };
    end = run_script("while :; do :; done", desc);
    assert_int_equal(WTERMSIG(end.wait_status), SIGXCPU);
    desc = (fm_process_desc){ .limits = { .memory_bytes = (uint64_t)64 << 20 } };
    end = run_script("ulimit -v", desc);
    assert_string_equal(end.words, "65536\n");
    scratch_close(&here);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(process_tells_how_it_ended),
        cmocka_unit_test(process_reads_nothing_and_inherits_nothing),
        cmocka_unit_test(process_keeps_a_descriptor_that_it_is_given),
        cmocka_unit_test(process_refuses_what_cannot_be_executed),
        cmocka_unit_test(process_needs_descriptors),
        cmocka_unit_test(process_limits_the_log_and_keeps_its_end),
        cmocka_unit_test(process_that_is_silent_leaves_no_log),
        cmocka_unit_test(process_tells_of_a_log_that_cannot_be_written),
        cmocka_unit_test(process_ends_with_all_that_it_started),
        cmocka_unit_test(process_that_hangs_is_ended_with_all_that_it_started),
        cmocka_unit_test(process_that_ended_in_time_is_not_late_for_a_parent_that_was_stopped),
        cmocka_unit_test(process_is_ended_by_each_signal_that_stops_us),
        cmocka_unit_test(signals_that_are_ignored_stop_nobody),
        cmocka_unit_test(process_ends_when_its_parent_is_killed),
        cmocka_unit_test(process_is_limited),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
