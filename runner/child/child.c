#include "child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/clock.h"

enum { GRACE_S = 5, NOT_EXECUTED = 127 };
extern char **environ;

fm_status child_find(char *path, size_t room_bytes, const char *name, const char *package,
                     fm_error *err)
{
    const char *search = getenv("PATH");
    while (search != NULL && *search != '\0') {
        const size_t length = strcspn(search, ":");
        const int written = snprintf(path, room_bytes, "%.*s/%s", (int)length, search, name);
        if (length > 0 && written > 0 && (size_t)written < room_bytes && access(path, X_OK) == 0)
            return FM_OK;
        search += length + (search[length] == ':');
    }
    return fm_fail(err, FM_UNSUPPORTED, "%s is not installed; on Debian: apt-get install %s", name,
                   package);
}

static size_t count_texts(const char *const *texts)
{
    size_t count = 0;
    while (texts != NULL && texts[count] != NULL)
        count++;
    return count;
}

static bool has_name_of(const char *entry, const char *const *added)
{
    const size_t length = strcspn(entry, "=") + 1;
    for (; added != NULL && *added != NULL; added++)
        if (strncmp(*added, entry, length) == 0)
            return true;
    return false;
}

/* Each name once: of two, getenv takes the first, and the loader of libraries the last. The caller
 * frees the list. */
static const char **make_environment(const char *const *added)
{
    const char *const *ours = (const char *const *)environ;
    const size_t more = count_texts(added), all = count_texts(ours);
    const char **made = calloc(more + all + 1, sizeof *made);
    if (made == NULL)
        return NULL;
    for (size_t i = 0; i < more; i++)
        made[i] = added[i];
    for (size_t i = 0, used = more; i < all; i++)
        if (!has_name_of(ours[i], added))
            made[used++] = ours[i];
    return made;
}

/* Between fork and exec: async-signal-safe calls only. */
static void become(const fm_child_desc *desc, char *const *environment, int log, pid_t parent)
{
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent || dup2(log, STDOUT_FILENO) < 0 || dup2(log, STDERR_FILENO) < 0)
        _exit(NOT_EXECUTED);
    if (desc->kept_fd != 0)
        fcntl(desc->kept_fd, F_SETFD, 0);
    if (desc->folder != NULL && chdir(desc->folder) != 0)
        _exit(NOT_EXECUTED);
    execve(desc->path, desc->argv, environment);
    _exit(NOT_EXECUTED);
}

fm_status child_start(pid_t *pid, const fm_child_desc *desc, fm_error *err)
{
    fm_status status = FM_OK;
    const pid_t parent = getpid();
    const char **environment = make_environment(desc->added);
    const int log = open(desc->log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    *pid = 0;
    if (environment == NULL || log < 0) {
        status = fm_fail(err, log < 0 ? FM_IO : FM_NO_MEMORY, "%s: %s", desc->log, strerror(errno));
        goto out;
    }
    char *const *passed = (char *const *)(const void *)environment;
    const pid_t started = fork();
    if (started == 0)
        become(desc, passed, log, parent);
    if (started < 0) {
        status = fm_fail(err, FM_NO_MEMORY, "%s: %s", desc->path, strerror(errno));
        goto out;
    }
    setpgid(started, started); /* whoever of us two comes first */
    *pid = started;
out:
    if (log >= 0)
        close(log);
    free(environment);
    return status;
}

static bool has_ended(int *wait_status, pid_t pid)
{
    return waitpid(pid, wait_status, WNOHANG) == pid;
}

static void nap(void)
{
    nanosleep(&(struct timespec){ .tv_nsec = 20000000 }, NULL);
}

bool child_wait(int *code, pid_t pid, double seconds, const char *until)
{
    const double deadline = clock_s() + seconds;
    int wait_status = 0;
    *code = 0;
    while (clock_s() < deadline && (until == NULL || access(until, F_OK) != 0)) {
        if (has_ended(&wait_status, pid)) {
            kill(-pid, SIGKILL); /* whatever it left behind */
            *code = WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
            return true;
        }
        nap();
    }
    child_end(pid);
    return false;
}

void child_end(pid_t pid)
{
    const double deadline = clock_s() + GRACE_S;
    int wait_status = 0;
    if (pid <= 0)
        return;
    kill(-pid, SIGTERM);
    while (!has_ended(&wait_status, pid)) {
        if (clock_s() > deadline)
            kill(-pid, SIGKILL);
        nap();
    }
    kill(-pid, SIGKILL);
}
