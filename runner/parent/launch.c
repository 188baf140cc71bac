#include "launch.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "answer_check.h"
#include "base/clock.h"
#include "base/text.h"
#include "worker/protocol.h"

enum {
    LOG_TAIL_BYTES = 400,   /* of a dead worker's last words in a message */
    EXIT_NOT_EXECUTED = 127 /* as shells use it */
};
static const size_t result_max_bytes = (size_t)256 << 20;

/* How a process ended. */
typedef struct ending {
    int wait_status;
    int stop_signal;
    bool is_timed_out;
    uint64_t peak_bytes; /* resident */
} ending;

void launcher_open(fm_launcher *launcher)
{
    struct sigaction action = { .sa_handler = SIG_DFL };
    struct sigaction interrupt = { .sa_handler = SIG_DFL };
    sigemptyset(&launcher->watched);
    sigaddset(&launcher->watched, SIGCHLD);
    sigaddset(&launcher->watched, SIGTERM);
    /* A shell's background jobs ignore SIGINT; blocking it would hear it again. */
    sigaction(SIGINT, NULL, &interrupt);
    if (interrupt.sa_handler != SIG_IGN)
        sigaddset(&launcher->watched, SIGINT);
    /* An inherited SIG_IGN would reap our workers before we see how they ended. */
    sigaction(SIGCHLD, &action, &launcher->child_action);
    sigprocmask(SIG_BLOCK, &launcher->watched, &launcher->previous);
}

static int next_signal(const fm_launcher *launcher, double seconds)
{
    const struct timespec wait = { .tv_sec = (time_t)seconds,
                                   .tv_nsec = (long)((seconds - (double)(time_t)seconds) * 1e9) };
    return sigtimedwait(&launcher->watched, NULL, &wait);
}

int launcher_stop_signal(const fm_launcher *launcher)
{
    for (;;) {
        const int signal_number = next_signal(launcher, 0.0);
        if (signal_number == SIGINT || signal_number == SIGTERM)
            return signal_number;
        if (signal_number < 0 && errno != EINTR)
            return 0;
    }
}

void launcher_close(const fm_launcher *launcher)
{
    while (launcher_stop_signal(launcher) != 0)
        continue;
    sigaction(SIGCHLD, &launcher->child_action, NULL);
    sigprocmask(SIG_SETMASK, &launcher->previous, NULL);
}

/* Between fork and exec: async-signal-safe calls only. */
static void become_worker(const char *path, char *const argv[], const fm_launch_desc *desc,
                          const int fds[2], const sigset_t *mask, pid_t parent)
{
    const struct rlimit no_core = { 0, 0 };
    setpgid(0, 0);
    /* A parent that is killed takes its worker with it. */
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent)
        _exit(EXIT_NOT_EXECUTED);
    setrlimit(RLIMIT_CORE, &no_core);
    if (desc->memory_bytes != 0) {
        const struct rlimit memory = { desc->memory_bytes, desc->memory_bytes };
        setrlimit(RLIMIT_AS, &memory);
    }
    if (dup2(fds[0], STDIN_FILENO) < 0 || dup2(fds[1], STDOUT_FILENO) < 0 ||
        dup2(fds[1], STDERR_FILENO) < 0)
        _exit(EXIT_NOT_EXECUTED);
    sigprocmask(SIG_SETMASK, mask, NULL);
    execv(path, argv);
    _exit(EXIT_NOT_EXECUTED);
}

static fm_status start(pid_t *pid, const fm_launcher *launcher, const fm_launch_desc *desc,
                       fm_error *err)
{
    fm_status status = FM_OK;
    const char *path = desc->worker != NULL ? desc->worker : "/proc/self/exe";
    char name[] = "fragmark", job[] = "worker";
    char *request = strdup(desc->request), *result = strdup(desc->result);
    char *const argv[] = { name, job, request, result, NULL };
    const pid_t parent = getpid();
    int fds[2] = { open("/dev/null", O_RDONLY | O_CLOEXEC),
                   open(desc->log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666) };
    if (request == NULL || result == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "no memory for the worker's arguments");
        goto out;
    }
    if (fds[0] < 0 || fds[1] < 0) {
        status =
            fm_fail(err, FM_IO, "%s: %s", fds[0] < 0 ? "/dev/null" : desc->log, strerror(errno));
        goto out;
    }
    if (access(path, X_OK) != 0) {
        status = fm_fail(err, FM_INVALID, "worker %s: %s", path, strerror(errno));
        goto out;
    }
    *pid = fork();
    if (*pid == 0)
        become_worker(path, argv, desc, fds, &launcher->previous, parent);
    if (*pid < 0)
        status = fm_fail(err, FM_NO_MEMORY, "cannot start a process: %s", strerror(errno));
    else
        setpgid(*pid, *pid); /* whoever of us two comes first */
out:
    for (int i = 0; i < 2; i++)
        if (fds[i] >= 0)
            close(fds[i]);
    free(request);
    free(result);
    return status;
}

static bool has_ended(pid_t pid)
{
    siginfo_t info = { 0 };
    return waitid(P_PID, (id_t)pid, &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == pid;
}

/* Waits for the end of a process, stops its group at the deadline or when told to. */
static void watch(ending *end, pid_t pid, const fm_launcher *launcher, const fm_launch_desc *desc)
{
    const double started = clock_s();
    struct rusage usage = { 0 };
    while (!has_ended(pid)) {
        const double left = desc->timeout_s == 0 ? 1.0 : started + desc->timeout_s - clock_s();
        const int signal_number = left <= 0.0 ? 0 : next_signal(launcher, left < 1.0 ? left : 1.0);
        if (signal_number == SIGINT || signal_number == SIGTERM)
            end->stop_signal = signal_number;
        else if (left <= 0.0)
            end->is_timed_out = true;
        if (end->stop_signal != 0 || end->is_timed_out) {
            kill(-pid, SIGKILL);
            break;
        }
        if (desc->tick != NULL)
            desc->tick(desc->context);
    }
    /* Not yet reaped, so the group's number is still ours: nothing it started survives. */
    while (!has_ended(pid)) {
        const int signal_number = next_signal(launcher, 1.0);
        if (signal_number == SIGINT || signal_number == SIGTERM)
            end->stop_signal = signal_number;
    }
    kill(-pid, SIGKILL);
    while (wait4(pid, &end->wait_status, 0, &usage) < 0 && errno == EINTR)
        continue;
    end->peak_bytes = (uint64_t)usage.ru_maxrss * 1024u;
}

/* The end of what a worker wrote since `from`, on one line; "" when it was silent. */
static void log_tail(char tail[LOG_TAIL_BYTES + 1], const char *path, off_t from)
{
    struct stat info;
    size_t count = 0;
    FILE *file = fopen(path, "rb");
    tail[0] = '\0';
    if (file == NULL)
        return;
    if (fstat(fileno(file), &info) == 0 && info.st_size > from) {
        const off_t longest = info.st_size - LOG_TAIL_BYTES;
        if (fseeko(file, longest > from ? longest : from, SEEK_SET) == 0)
            count = fread(tail, 1, LOG_TAIL_BYTES, file);
    }
    fclose(file);
    tail[count] = '\0';
    while (count > 0 && tail[count - 1] == '\n')
        tail[--count] = '\0';
    for (size_t i = 0; i < count; i++)
        if ((unsigned char)tail[i] < ' ' || (unsigned char)tail[i] > '~')
            tail[i] = tail[i] == '\n' ? '|' : ' ';
}

static bool speaks_of_memory(const char *words)
{
    static const char *const signs[] = { "bad_alloc", "annot allocate memory", "ut of memory" };
    for (size_t i = 0; i < sizeof signs / sizeof signs[0]; i++)
        if (strstr(words, signs[i]) != NULL)
            return true;
    return false;
}

/* A limit on memory shows as any kind of crash; so does the kernel's out-of-memory killer. */
static bool died_of_memory(const ending *end, const fm_launch_desc *desc, const char *words)
{
    const uint64_t machine = (uint64_t)sysconf(_SC_PHYS_PAGES) * (uint64_t)sysconf(_SC_PAGESIZE);
    if (speaks_of_memory(words))
        return true;
    if (desc->memory_bytes != 0 && end->peak_bytes > desc->memory_bytes / 10 * 8)
        return true;
    return WIFSIGNALED(end->wait_status) && WTERMSIG(end->wait_status) == SIGKILL &&
           end->peak_bytes > machine / 2;
}

static json_t *result_of_death(const ending *end, const fm_launch_desc *desc, off_t log_from)
{
    char words[LOG_TAIL_BYTES + 1], how[128],
        message[sizeof words + sizeof how + FM_PATH_MAX_BYTES + 64];
    const char *input = desc->input != NULL ? desc->input : "";
    log_tail(words, desc->log, log_from);
    if (end->is_timed_out)
        snprintf(how, sizeof how, "no answer within %u s", desc->timeout_s);
    else if (WIFSIGNALED(end->wait_status)) {
        const char *name = sigabbrev_np(WTERMSIG(end->wait_status));
        snprintf(how, sizeof how, "killed by SIG%s", name != NULL ? name : "?");
    } else
        snprintf(how, sizeof how, "exited with status %d and left no result",
                 WEXITSTATUS(end->wait_status));
    snprintf(message, sizeof message, "%s%s%s%s%s%s", how,
             input[0] != '\0' ? "; its scene reads " : "", input,
             words[0] != '\0' ? "; its last words: \"" : "", words, words[0] != '\0' ? "\"" : "");
    if (end->is_timed_out)
        return answer_make(FM_CASE_TIMEOUT, message);
    return answer_make(died_of_memory(end, desc, words) ? FM_CASE_OUT_OF_MEMORY : FM_CASE_CRASH,
                       message);
}

/* Whether a worker that says it could not write its answer speaks the truth: a plugin may exit with
 * any status. */
static bool cannot_be_written(const char *path, fm_error *err)
{
    static const char probe[1 << 16] = "";
    const fm_status status = text_write_file(path, probe, sizeof probe, err);
    unlink(path);
    return status != FM_OK;
}

static bool says_no_answer(const ending *end)
{
    return WIFEXITED(end->wait_status) && WEXITSTATUS(end->wait_status) == WORKER_EXIT_NO_ANSWER;
}

static json_t *read_result(const ending *end, const fm_launch_desc *desc, off_t log_from)
{
    char *bytes = NULL, message[600];
    size_t count = 0;
    fm_error below = { 0 };
    json_error_t fault = { 0 };
    json_t *result = NULL;
    if (!end->is_timed_out && says_no_answer(end) && cannot_be_written(desc->result, &below))
        return answer_make_runs_fault(below.message);
    if (end->is_timed_out || !WIFEXITED(end->wait_status) || access(desc->result, R_OK) != 0)
        return result_of_death(end, desc, log_from);
    if (text_read_file(&bytes, &count, desc->result, result_max_bytes, &below) != FM_OK)
        return answer_make(FM_CASE_CRASH, below.message);
    result = json_loadb(bytes, count, JSON_REJECT_DUPLICATES, &fault);
    free(bytes);
    const fm_status checked =
        result != NULL ? answer_check(result, desc->frames, &below)
                       : fm_fail(&below, FM_INVALID, "line %d: %s", fault.line, fault.text);
    if (checked == FM_OK)
        return result;
    json_decref(result);
    if (checked == FM_NO_MEMORY)
        return NULL;
    snprintf(message, sizeof message, "the worker's result cannot be used: %.400s (exit status %d)",
             below.message, WEXITSTATUS(end->wait_status));
    return answer_make(FM_CASE_CRASH, message);
}

fm_status launch_worker(fm_launch_outcome *outcome, const fm_launcher *launcher,
                        const fm_launch_desc *desc, fm_error *err)
{
    const double started = clock_s();
    struct stat log_before;
    ending end = { 0 };
    pid_t pid = -1;
    *outcome = (fm_launch_outcome){ 0 };
    if (unlink(desc->result) != 0 && errno != ENOENT)
        return fm_fail(err, FM_IO, "%s: %s", desc->result, strerror(errno));
    const off_t log_from = stat(desc->log, &log_before) == 0 ? log_before.st_size : 0;
    const fm_status status = start(&pid, launcher, desc, err);
    if (status != FM_OK)
        return status;
    watch(&end, pid, launcher, desc);
    outcome->seconds = clock_s() - started;
    outcome->stop_signal = end.stop_signal;
    outcome->is_interrupted = end.stop_signal != 0;
    if (outcome->is_interrupted)
        return FM_OK;
    outcome->result = read_result(&end, desc, log_from);
    if (outcome->result == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for a worker's result");
    return FM_OK;
}
