#include "launch.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/text.h"
#include "plugin/hook_mark.h"
#include "process/process.h"
#include "results/answer_check.h"
#include "worker/protocol.h"

enum { LOG_TAIL_BYTES = 400 /* of a dead worker's last words in a message */ };
static const size_t result_max_bytes = (size_t)256 << 20;

/* A signal to all of us may reach the worker first; ours is then on its way. */
static const double stop_signal_patience_s = 0.5;

/* Where the worker was when it ended, of those that a plugin has: hook_mark.h. The file is gone. */
static bool take_mark(char told[HOOK_MARK_TOLD_BYTES], const fm_launch_desc *desc)
{
    char path[FM_PATH_MAX_BYTES];
    snprintf(path, sizeof path, WORKER_HOOK_FILE, desc->result);
    const bool is_told = hook_mark_read(told, path);
    unlink(path);
    return is_told;
}

/* How a launch ended, beside what is known of every process. */
typedef struct ending {
    fm_process_end process;
    uint64_t oom_kills;              /* of the whole machine, meanwhile */
    char mark[HOOK_MARK_TOLD_BYTES]; /* "": in no hook */
} ending;

/* The end of what a worker said, on one line; "" when it was silent. */
static void log_tail(char tail[LOG_TAIL_BYTES + 1], const char *words)
{
    size_t count = strlen(words);
    if (count > LOG_TAIL_BYTES)
        words += count - LOG_TAIL_BYTES;
    snprintf(tail, LOG_TAIL_BYTES + 1, "%.*s", LOG_TAIL_BYTES, words);
    count = strlen(tail);
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

/* How often the kernel has killed for want of memory since the machine started; 0: it does not say.
 */
static uint64_t count_oom_kills(void)
{
    static const char name[] = "oom_kill ";
    char line[128];
    uint64_t count = 0;
    FILE *file = fopen("/proc/vmstat", "re");
    while (file != NULL && fgets(line, sizeof line, file) != NULL)
        if (strncmp(line, name, sizeof name - 1) == 0)
            count = strtoull(line + sizeof name - 1, NULL, 10);
    if (file != NULL)
        fclose(file);
    return count;
}

static bool was_killed_by(const ending *end, int signal_number)
{
    return WIFSIGNALED(end->process.wait_status) &&
           WTERMSIG(end->process.wait_status) == signal_number;
}

/* A limit on memory shows as any kind of crash; so does the kernel's out-of-memory killer. */
static bool died_of_memory(const ending *end, const fm_launch_desc *desc)
{
    const uint64_t machine = (uint64_t)sysconf(_SC_PHYS_PAGES) * (uint64_t)sysconf(_SC_PAGESIZE);
    if (speaks_of_memory(end->process.words))
        return true;
    if (desc->memory_bytes != 0 && end->process.peak_bytes > desc->memory_bytes / 10 * 8)
        return true;
    return was_killed_by(end, SIGKILL) &&
           (end->oom_kills > 0 || end->process.peak_bytes > machine / 2);
}

/* By somebody's hand; a worker that kills itself so looks the same. */
static bool was_killed_from_outside(const ending *end, const fm_launch_desc *desc)
{
    return (was_killed_by(end, SIGKILL) || was_killed_by(end, SIGTERM) ||
            was_killed_by(end, SIGINT) || was_killed_by(end, SIGHUP)) &&
           !died_of_memory(end, desc);
}

/* A limit that we were given, and our workers with us. */
static bool has_limit(int resource)
{
    struct rlimit limits;
    return getrlimit((__rlimit_resource_t)resource, &limits) == 0 &&
           limits.rlim_cur != RLIM_INFINITY;
}

/* NULL: no limit that the run was given ended the worker. */
static const char *limit_that_ended(const ending *end)
{
    if (was_killed_by(end, SIGXCPU) && has_limit(RLIMIT_CPU))
        return "the limit on CPU time ended the worker (ulimit -t)";
    if (was_killed_by(end, SIGXFSZ) && has_limit(RLIMIT_FSIZE))
        return "the limit on the size of files ended the worker (ulimit -f)";
    return NULL;
}

static json_t *result_of_death(const ending *end, const fm_launch_desc *desc)
{
    char words[LOG_TAIL_BYTES + 1], how[128],
        message[sizeof words + sizeof how + FM_PATH_MAX_BYTES + HOOK_MARK_TOLD_BYTES + 64];
    const char *input = desc->input != NULL ? desc->input : "";
    const int wait_status = end->process.wait_status;
    log_tail(words, end->process.words);
    if (end->process.is_timed_out)
        snprintf(how, sizeof how, "no answer within %u s", desc->timeout_s);
    else if (WIFSIGNALED(wait_status)) {
        const char *name = sigabbrev_np(WTERMSIG(wait_status));
        snprintf(how, sizeof how, "killed by SIG%s", name != NULL ? name : "?");
    } else
        snprintf(how, sizeof how, "exited with status %d and left no result",
                 WEXITSTATUS(wait_status));
    snprintf(message, sizeof message, "%s%s%s%s%s%s%s%s", how, end->mark[0] != '\0' ? ", " : "",
             end->mark, input[0] != '\0' ? "; its scene reads " : "", input,
             words[0] != '\0' ? "; its last words: \"" : "", words, words[0] != '\0' ? "\"" : "");
    if (end->process.is_timed_out)
        return answer_make(FM_CASE_TIMEOUT, FM_REASON_NONE, message);
    return answer_make(died_of_memory(end, desc) ? FM_CASE_OUT_OF_MEMORY : FM_CASE_CRASH,
                       FM_REASON_NONE, message);
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

/* Of a worker that exited by itself. NULL: it left nothing that can be used, with the reason. */
static json_t *read_answer(char *why, size_t room_bytes, const fm_launch_desc *desc)
{
    char *bytes = NULL;
    size_t count = 0;
    fm_error below = { 0 };
    json_error_t fault = { 0 };
    if (text_read_file(&bytes, &count, desc->result, result_max_bytes, &below) != FM_OK) {
        snprintf(why, room_bytes, "%.599s", below.message);
        return NULL;
    }
    json_t *result = json_loadb(bytes, count, JSON_REJECT_DUPLICATES, &fault);
    free(bytes);
    fm_status checked = result != NULL
                            ? answer_check(result, desc->frames, &below)
                            : fm_fail(&below, FM_INVALID, "line %d: %s", fault.line, fault.text);
    if (checked == FM_OK)
        checked = answer_check_reason(result, &below);
    if (checked == FM_OK)
        return result;
    json_decref(result);
    snprintf(why, room_bytes, "%.599s", below.message);
    return NULL;
}

static json_t *result_of_nonsense(const ending *end, const char *why)
{
    char message[768];
    snprintf(message, sizeof message, "the worker's result cannot be used: %.600s (exit status %d)",
             why, WEXITSTATUS(end->process.wait_status));
    return answer_make(FM_CASE_CRASH, FM_REASON_NONE, message);
}

/* Of a worker that was neither interrupted nor out of time. */
static void judge(fm_launch_outcome *outcome, const ending *end, const fm_launch_desc *desc)
{
    char why[600];
    fm_error below = { 0 };
    const char *limit = limit_that_ended(end);
    const int wait_status = end->process.wait_status;
    outcome->kind = FM_LAUNCH_ANSWERED;
    if (limit != NULL) {
        outcome->result = answer_make_runs_fault(limit);
    } else if (WIFEXITED(wait_status) && WEXITSTATUS(wait_status) == WORKER_EXIT_NO_ANSWER &&
               cannot_be_written(desc->result, &below)) {
        outcome->result = answer_make_runs_fault(below.message);
    } else if (!WIFEXITED(wait_status) || access(desc->result, F_OK) != 0) {
        outcome->kind = was_killed_from_outside(end, desc) ? FM_LAUNCH_KILLED : FM_LAUNCH_DIED;
        outcome->result = result_of_death(end, desc);
    } else {
        outcome->result = read_answer(why, sizeof why, desc);
        if (outcome->result == NULL) {
            outcome->kind = FM_LAUNCH_DIED;
            outcome->result = result_of_nonsense(end, why);
        }
    }
}

static fm_status run_process(ending *end, const fm_stop_signals *signals,
                             const fm_launch_desc *desc, fm_error *err)
{
    const char *const argv[] = { "fragmark", "worker", desc->request, desc->result, NULL };
    const fm_process_desc process = {
        .path = desc->worker,
        .argv = argv,
        .log = desc->log,
        .log_bytes = LAUNCH_LOG_BYTES,
        .limits = { .memory_bytes = desc->memory_bytes },
        .timeout_s = desc->timeout_s,
        .tick = desc->tick,
        .context = desc->context,
    };
    const uint64_t oom_kills = count_oom_kills();
    (void)take_mark(end->mark, desc); /* of a parent that was killed */
    if (unlink(desc->result) != 0 && errno != ENOENT)
        return fm_fail(err, FM_IO, "%s: %s", desc->result, strerror(errno));
    const fm_status status = process_run(&end->process, signals, &process, err);
    end->oom_kills = count_oom_kills() - oom_kills;
    if (!take_mark(end->mark, desc))
        end->mark[0] = '\0';
    return status;
}

fm_status launch_worker(fm_launch_outcome *outcome, const fm_stop_signals *signals,
                        const fm_launch_desc *desc, fm_error *err)
{
    ending end = { 0 };
    *outcome = (fm_launch_outcome){ 0 };
    const fm_status status = run_process(&end, signals, desc, err);
    if (status != FM_OK)
        return status;
    outcome->seconds = end.process.seconds;
    outcome->stop_signal = end.process.stop_signal;
    if (outcome->stop_signal == 0 && !end.process.is_timed_out)
        judge(outcome, &end, desc);
    else if (outcome->stop_signal == 0)
        outcome->result = result_of_death(&end, desc);
    if (outcome->kind == FM_LAUNCH_KILLED)
        outcome->stop_signal = stop_signals_next(signals, stop_signal_patience_s);
    if (outcome->stop_signal != 0) {
        outcome->kind = FM_LAUNCH_INTERRUPTED;
        json_decref(outcome->result);
        outcome->result = NULL;
        return FM_OK;
    }
    if (outcome->result == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for a worker's result");
    return FM_OK;
}
