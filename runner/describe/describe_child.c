/* The process that describes plugins, and those it starts:
 *
 *   describe_main  starts a keeper for each plugin, a few at a time
 *   keeper         one plugin: starts its loader and watches the clock
 *   loader         loads the plugin, within limits, and says what it found in memory that it shares
 *                  with its keeper
 *
 * A plugin that ends its parent ends its keeper, and the others are described. What a loader leaves
 * running ends with the process that describes (process/process.h). */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "answer.h"
#include "base/clock.h"
#include "describe.h"
#include "process/limits.h"

enum {
    AT_A_TIME = 8,
    WALL_S = 5,      /* of a loader */
    PROCESSOR_S = 2, /* the same */
};

static const fm_process_limits loader_limits = {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) /* these map terabytes */
    .memory_bytes = (uint64_t)2 << 30,
#endif
    .file_bytes = 1 << 20,
    .cpu_s = PROCESSOR_S,
    .open_files = 64,
};

/* Holds for the plugin's code, too. */
static void bind_hands(void)
{
    const int nowhere = open("/dev/null", O_RDWR);
    setsid(); /* what it sends to its group stays with it */
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        dup2(nowhere, fd);
    close_range(STDERR_FILENO + 1, ~0u, 0);
    limits_set(&loader_limits);
}

static void describe_loaded(answer *to, const fm_plugin *plugin)
{
    fm_text bytes = { 0 };
    fm_error err = { 0 };
    const char *name = plugin_file_name(plugin->path);
    to->head.kind = ANSWER_CHECKING;
    fm_status status = plugin_check(plugin->method, name, &err);
    if (status == FM_OK && description_write(&bytes, plugin->method, &err) != FM_OK)
        status = fm_error_prefix(&err, "%s", name);
    if (status != FM_OK) {
        answer_set_text(to, ANSWER_REFUSED, err.message);
        return;
    }
    memcpy(to->bytes, bytes.bytes, bytes.length);
    to->head = (answer_head){ .kind = ANSWER_DESCRIBED, .count = (uint32_t)bytes.length };
}

/* No destructor of the plugin runs: the process ends as it is. */
static _Noreturn void load(answer *to, const char *path)
{
    fm_plugin *plugin = NULL;
    fm_error err = { 0 };
    bind_hands();
    to->head.kind = ANSWER_LOADING;
    if (plugin_load(&plugin, path, &err) == FM_OK)
        describe_loaded(to, plugin);
    else
        answer_set_text(to, ANSWER_NOT_LOADED, err.message);
    _exit(0);
}

/* How a loader ended that has no answer. */
static void tell_end(answer *to, const char *path, int wait_status, bool is_late)
{
    char how[96], text[FM_PATH_MAX_BYTES + 256];
    const bool is_checking = to->head.kind == ANSWER_CHECKING;
    if (is_late)
        snprintf(how, sizeof how, "no end after %d s", WALL_S);
    else if (WIFSIGNALED(wait_status) && WTERMSIG(wait_status) == SIGXCPU)
        snprintf(how, sizeof how, "more than %d s of processor time", PROCESSOR_S);
    else if (WIFSIGNALED(wait_status)) {
        const char *name = sigabbrev_np(WTERMSIG(wait_status));
        snprintf(how, sizeof how, "killed by SIG%s", name != NULL ? name : "?");
    } else
        snprintf(how, sizeof how, "it ended the process, status %d", WEXITSTATUS(wait_status));
    snprintf(text, sizeof text, "%s: cannot be used: while %s: %s", plugin_file_name(path),
             is_checking ? "its descriptor was read (a pointer to nowhere?)"
                         : "it was loaded (its constructors ran)",
             how);
    answer_set_text(to, ANSWER_ENDED, text);
}

/* Writes a whole answer; a full disk leaves none, and false. */
static bool put_answer(int file, size_t slot, const answer *from)
{
    const size_t room = sizeof from->bytes;
    const size_t count = from->head.count < room ? from->head.count : room;
    const char *bytes = (const char *)from;
    size_t done = 0;
    while (done < sizeof from->head + count) {
        const ssize_t written = pwrite(file, bytes + done, sizeof from->head + count - done,
                                       (off_t)(slot * ANSWER_SLOT_BYTES + done));
        if (written <= 0 && errno != EINTR)
            return false;
        done += written > 0 ? (size_t)written : 0;
    }
    return true;
}

/* Waits until a child has ended, at most WALL_S; it is not reaped. */
static bool ends_in_time(pid_t pid)
{
    const struct timespec pause = { .tv_nsec = 1000000 };
    const double deadline = clock_s() + WALL_S;
    while (clock_s() < deadline) {
        siginfo_t info = { 0 };
        const int failed = waitid(P_PID, (id_t)pid, &info, WEXITED | WNOHANG | WNOWAIT);
        if (info.si_pid == pid || (failed != 0 && errno != EINTR))
            return true;
        nanosleep(&pause, NULL);
    }
    return false;
}

/* Nothing is known of the plugin, and it is not to blame: the words go to who asked. */
static _Noreturn void give_up(const char *path)
{
    fprintf(stderr, "%s: %s\n", plugin_file_name(path), strerror(errno));
    fflush(stderr);
    _exit(EXIT_FAILURE);
}

static _Noreturn void keep(int file, size_t slot, const char *path)
{
    int wait_status = 0;
    answer *shared =
        mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED)
        give_up(path);
    const pid_t loader = fork();
    if (loader == 0)
        load(shared, path);
    if (loader < 0)
        give_up(path);
    const bool is_late = !ends_in_time(loader);
    kill(loader, SIGKILL);
    kill(-loader, SIGKILL);
    while (waitpid(loader, &wait_status, 0) < 0 && errno == EINTR)
        continue;
    if (shared->head.kind < ANSWER_ENDED || shared->head.kind > ANSWER_DESCRIBED)
        tell_end(shared, path, wait_status, is_late);
    if (!put_answer(file, slot, shared))
        give_up(path);
    _exit(0);
}

/* A plugin that killed its keeper; false: nobody is told. */
static bool tell_lost(int file, size_t slot, const char *path, int signal_number)
{
    answer *lost = malloc(sizeof *lost);
    char text[FM_PATH_MAX_BYTES + 128];
    if (lost == NULL)
        return false;
    snprintf(text, sizeof text,
             "%s: cannot be used: it ended the process that watched it (signal %d)",
             plugin_file_name(path), signal_number);
    answer_set_text(lost, ANSWER_ENDED, text);
    const bool is_told = put_answer(file, slot, lost);
    free(lost);
    return is_told;
}

/* The keepers that are at work. */
typedef struct keepers {
    int file;
    char *const *plugins;
    pid_t pids[AT_A_TIME]; /* 0: free */
    size_t slots[AT_A_TIME];
} keepers;

static size_t find_keeper(const keepers *of, pid_t pid)
{
    size_t i = 0;
    while (i < AT_A_TIME && of->pids[i] != pid)
        i++;
    return i;
}

static bool start_keeper(keepers *of, size_t slot)
{
    const size_t place = find_keeper(of, 0);
    const pid_t pid = fork();
    if (pid == 0)
        keep(of->file, slot, of->plugins[slot]);
    if (pid < 0)
        return false;
    of->pids[place] = pid;
    of->slots[place] = slot;
    return true;
}

/* false: a plugin has no answer, and not for what it did. */
static bool await_keeper(keepers *of)
{
    int wait_status;
    pid_t pid;
    do
        pid = waitpid(-1, &wait_status, 0);
    while (pid < 0 && errno == EINTR);
    const size_t place = find_keeper(of, pid);
    if (place == AT_A_TIME)
        return true;
    of->pids[place] = 0;
    if (WIFSIGNALED(wait_status))
        return tell_lost(of->file, of->slots[place], of->plugins[of->slots[place]],
                         WTERMSIG(wait_status));
    return wait_status == 0;
}

int describe_main(const char *out, char *const *plugins)
{
    keepers of = { .file = open(out, O_WRONLY | O_CLOEXEC), .plugins = plugins };
    size_t next = 0, running = 0;
    bool can_start = true, is_whole = true;
    if (of.file < 0) {
        perror(out);
        return EXIT_FAILURE;
    }
    while (running > 0 || (can_start && plugins[next] != NULL)) {
        if (can_start && running < AT_A_TIME && plugins[next] != NULL) {
            can_start = start_keeper(&of, next++);
            if (!can_start)
                perror("no process can be started");
            running += can_start;
            continue;
        }
        is_whole = await_keeper(&of) && is_whole;
        running--;
    }
    return can_start && is_whole ? EXIT_SUCCESS : EXIT_FAILURE;
}
