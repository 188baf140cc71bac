#include "guard.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.h"

enum { EXIT_NOT_EXECUTED = 127 /* as shells use it */ };

typedef struct guard_state {
    const guard_desc *desc;
    pid_t pid; /* of the process */
    int children_fd;
    bool has_ended;
    guard_report report;
} guard_state;

static void give_up(const guard_desc *desc)
{
    const guard_report report = { .error = errno };
    if (write(desc->report, &report, sizeof report) < 0)
        _exit(EXIT_NOT_EXECUTED + 1);
    _exit(EXIT_NOT_EXECUTED);
}

static void become_process(const guard_desc *desc, pid_t parent)
{
    const fm_process_desc *process = desc->process;
    const char *path = process->path != NULL ? process->path : "/proc/self/exe";
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL); /* of the guard */
    if (getppid() != parent)
        _exit(EXIT_NOT_EXECUTED);
    limits_set(&process->limits);
    if (dup2(desc->input, STDIN_FILENO) < 0 || dup2(desc->talk, STDOUT_FILENO) < 0 ||
        dup2(desc->talk, STDERR_FILENO) < 0 ||
        (process->kept_fd != 0 && fcntl(process->kept_fd, F_SETFD, 0) != 0))
        give_up(desc);
    signal(SIGXFSZ, SIG_IGN);
    signal(SIGPIPE, SIG_DFL);
    sigprocmask(SIG_SETMASK, desc->mask, NULL);
    execv(path, (char *const *)(const void *)process->argv);
    give_up(desc);
}

/* What the guard does not need: a lock that it held would outlive its owner. */
static void close_others(const guard_state *guard)
{
    const int kept[] = { guard->desc->control, guard->desc->report, guard->children_fd };
    const int count = (int)sysconf(_SC_OPEN_MAX);
    int first = 0;
    for (;;) { /* the next of the kept ones, whatever their order */
        int next = -1;
        for (size_t i = 0; i < sizeof kept / sizeof kept[0]; i++)
            if (kept[i] >= first && (next < 0 || kept[i] < next))
                next = kept[i];
        const unsigned last = next < 0 ? ~0u : (unsigned)next - 1u;
        if (next != first && close_range((unsigned)first, last, 0) != 0)
            for (int fd = first; fd < (next < 0 ? count : next); fd++)
                close(fd);
        if (next < 0)
            return;
        first = next + 1;
    }
}

static void reap(guard_state *guard)
{
    struct rusage usage;
    int wait_status;
    pid_t pid;
    while ((pid = wait4(-1, &wait_status, WNOHANG, &usage)) > 0) {
        if (pid != guard->pid)
            continue;
        guard->has_ended = true;
        guard->report.wait_status = wait_status;
        guard->report.peak_bytes = (uint64_t)usage.ru_maxrss * 1024u;
    }
}

static bool is_child(const char *pid)
{
    char path[64], text[512];
    snprintf(path, sizeof path, "/proc/%.20s/stat", pid);
    const int fd = open(path, O_RDONLY | O_CLOEXEC);
    const ssize_t count = fd < 0 ? 0 : read(fd, text, sizeof text - 1);
    if (fd >= 0)
        close(fd);
    text[count > 0 ? count : 0] = '\0';
    const char *behind = strrchr(text, ')'); /* a program's name may have any letters */
    int parent = 0;
    return behind != NULL && sscanf(behind, ") %*c %d", &parent) == 1 && parent == getpid();
}

/* Those that it started, and those that it was handed. */
static void kill_children(void)
{
    DIR *all = opendir("/proc");
    const struct dirent *entry;
    while (all != NULL && (entry = readdir(all)) != NULL)
        if (isdigit((unsigned char)entry->d_name[0]) && is_child(entry->d_name))
            kill((pid_t)strtol(entry->d_name, NULL, 10), SIGKILL);
    if (all != NULL)
        closedir(all);
}

/* Until none is left: children of whoever dies are handed to us. */
static void end_all(guard_state *guard)
{
    const double deadline = clock_s() + GUARD_PATIENCE_S;
    struct pollfd fd = { .fd = guard->children_fd, .events = POLLIN };
    struct signalfd_siginfo info;
    siginfo_t child;
    reap(guard);
    while (waitid(P_ALL, 0, &child, WEXITED | WNOHANG | WNOWAIT) == 0 && clock_s() < deadline) {
        if (!guard->has_ended)
            kill(-guard->pid, SIGKILL); /* also where there is no /proc */
        kill_children();
        poll(&fd, 1, 5);
        while (read(fd.fd, &info, sizeof info) > 0)
            continue;
        reap(guard);
    }
    if (!guard->has_ended)
        guard->report.wait_status = SIGKILL;
}

static void wait_for_end(guard_state *guard)
{
    struct signalfd_siginfo info;
    struct pollfd fds[] = { { .fd = guard->children_fd, .events = POLLIN },
                            { .fd = guard->desc->control, .events = POLLIN } };
    while (!guard->has_ended) {
        if (poll(fds, 2, -1) < 0 && errno != EINTR)
            return;
        if (fds[1].revents != 0)
            return;
        while (read(guard->children_fd, &info, sizeof info) > 0)
            continue;
        reap(guard);
    }
}

_Noreturn void guard_main(const guard_desc *desc)
{
    guard_state self = { .desc = desc };
    sigset_t children, all;
    setpgid(0, 0);
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, NULL);
    signal(SIGCHLD, SIG_DFL); /* ignored, children would end unseen */
    sigemptyset(&children);
    sigaddset(&children, SIGCHLD);
    self.children_fd = signalfd(-1, &children, SFD_CLOEXEC | SFD_NONBLOCK);
    const pid_t parent = getpid();
    if (self.children_fd < 0 || prctl(PR_SET_CHILD_SUBREAPER, 1) != 0)
        give_up(desc);
    self.pid = fork();
    if (self.pid == 0)
        become_process(desc, parent);
    if (self.pid < 0)
        give_up(desc);
    setpgid(self.pid, self.pid); /* whoever of us two comes first */
    close_others(&self);
    wait_for_end(&self);
    end_all(&self);
    if (write(desc->report, &self.report, sizeof self.report) < 0)
        _exit(EXIT_NOT_EXECUTED);
    _exit(0);
}
