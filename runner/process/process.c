#include "process.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.h"
#include "guard.h"
#include "talk.h"

/* What a running process is known by; descriptors that are not open are -1. */
typedef struct running {
    pid_t guard;
    int input, control[2], report[2], talk[2]; /* [0]: to be read */
    fm_talk said;
    guard_report reports[2];
    size_t report_bytes;
    double started_s, ticked_s;
} running;

static void close_fd(int *fd)
{
    if (*fd >= 0)
        close(*fd);
    *fd = -1;
}

static void close_pipes(running *run)
{
    int *const fds[] = { &run->input,     &run->control[0], &run->control[1], &run->report[0],
                         &run->report[1], &run->talk[0],    &run->talk[1] };
    for (size_t i = 0; i < sizeof fds / sizeof fds[0]; i++)
        close_fd(fds[i]);
}

static fm_status open_pipes(running *run, fm_error *err)
{
    run->input = run->control[0] = run->control[1] = run->report[0] = run->report[1] = -1;
    run->talk[0] = run->talk[1] = -1;
    run->input = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (run->input >= 0 && pipe2(run->control, O_CLOEXEC) == 0 &&
        pipe2(run->report, O_CLOEXEC) == 0 && pipe2(run->talk, O_CLOEXEC) == 0 &&
        fcntl(run->talk[0], F_SETFL, O_NONBLOCK) == 0 &&
        fcntl(run->report[0], F_SETFL, O_NONBLOCK) == 0)
        return FM_OK;
    const fm_status status =
        fm_fail(err, FM_IO, "no descriptors for a process: %s", strerror(errno));
    close_pipes(run);
    return status;
}

static fm_status start(running *run, const fm_stop_signals *signals, const fm_process_desc *desc,
                       fm_error *err)
{
    sigset_t mask;
    if (desc->path != NULL && access(desc->path, X_OK) != 0)
        return fm_fail(err, FM_INVALID, "%s: %s", desc->path, strerror(errno));
    fm_status status = open_pipes(run, err);
    if (status != FM_OK)
        return status;
    sigprocmask(SIG_SETMASK, NULL, &mask);
    const guard_desc guard = { .process = desc,
                               .mask = signals != NULL ? &signals->previous : &mask,
                               .input = run->input,
                               .talk = run->talk[1],
                               .control = run->control[0],
                               .report = run->report[1] };
    run->guard = fork();
    if (run->guard == 0) {
        close(run->control[1]); /* or it would never see its end */
        guard_main(&guard);
    }
    if (run->guard < 0) {
        status = fm_fail(err, FM_IO, "no process can be started: %s", strerror(errno));
        close_pipes(run);
        return status;
    }
    setpgid(run->guard, run->guard); /* whoever of us two comes first */
    close_fd(&run->input);
    close_fd(&run->control[0]);
    close_fd(&run->report[1]);
    close_fd(&run->talk[1]);
    return FM_OK;
}

/* false: the guard is gone. */
static bool read_report(running *run)
{
    char *into = (char *)run->reports + run->report_bytes, beyond;
    const size_t room = sizeof run->reports - run->report_bytes;
    const ssize_t count = read(run->report[0], room > 0 ? into : &beyond, room > 0 ? room : 1);
    if (count > 0 && room > 0)
        run->report_bytes += (size_t)count;
    return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
}

static void tick(running *run, const fm_process_desc *desc)
{
    if (desc->tick == NULL || clock_s() < run->ticked_s + 1.0)
        return;
    run->ticked_s = clock_s();
    desc->tick(desc->context);
}

/* In milliseconds: until something is to be done without anybody's word. */
static int pause_ms(const running *run, const fm_process_desc *desc)
{
    const double left = run->started_s + desc->timeout_s - clock_s();
    if (desc->timeout_s == 0.0 || left > 1.0 || run->control[1] < 0)
        return 1000;
    return left > 0.0 ? (int)(left * 1e3) + 1 : 0;
}

static bool is_too_late(const running *run, const fm_process_desc *desc)
{
    return desc->timeout_s != 0.0 && clock_s() > run->started_s + desc->timeout_s;
}

/* Until the guard has ended. A report tells that the process has: whoever was stopped meanwhile
 * (Ctrl-Z) reads it late, and the process was not. Closing `control` asks it to. */
static void watch(fm_process_end *end, running *run, const fm_stop_signals *signals,
                  const fm_process_desc *desc)
{
    struct pollfd fds[] = { { .fd = run->report[0], .events = POLLIN },
                            { .fd = run->talk[0], .events = POLLIN },
                            { .fd = signals != NULL ? signals->fd : -1, .events = POLLIN } };
    bool is_guarded = true;
    while (is_guarded) {
        poll(fds, 3, pause_ms(run, desc));
        if (!talk_drain(&run->said, run->talk[0]))
            fds[1].fd = -1;
        is_guarded = read_report(run);
        const int stop = signals != NULL ? stop_signals_next(signals, 0.0) : 0;
        if (stop != 0 && end->stop_signal == 0)
            end->stop_signal = stop;
        if (run->control[1] >= 0 && run->report_bytes == 0 && end->stop_signal == 0 &&
            is_too_late(run, desc))
            end->is_timed_out = true;
        if (end->stop_signal != 0 || end->is_timed_out)
            close_fd(&run->control[1]);
        tick(run, desc);
    }
    while (waitpid(run->guard, NULL, 0) < 0 && errno == EINTR)
        continue;
}

static fm_status take_report(fm_process_end *end, const running *run, const fm_process_desc *desc,
                             fm_error *err)
{
    const guard_report *report = &run->reports[0];
    end->wait_status = SIGKILL;
    if (run->report_bytes < sizeof *report)
        return FM_OK;
    if (report->error != 0)
        return fm_fail(err, FM_IO, "%s cannot be started: %s",
                       desc->path != NULL ? desc->path : "this program", strerror(report->error));
    end->wait_status = report->wait_status;
    end->peak_bytes = report->peak_bytes;
    return FM_OK;
}

fm_status process_run(fm_process_end *end, const fm_stop_signals *signals,
                      const fm_process_desc *desc, fm_error *err)
{
    running run = { .started_s = clock_s(), .ticked_s = clock_s() };
    *end = (fm_process_end){ 0 };
    fm_status status = start(&run, signals, desc, err);
    if (status != FM_OK)
        return status;
    talk_open(&run.said, desc);
    watch(end, &run, signals, desc);
    end->seconds = clock_s() - run.started_s;
    status = take_report(end, &run, desc, err);
    fm_error below = { 0 };
    const fm_status said = talk_close(end->words, &run.said, run.talk[0], &below);
    close_pipes(&run);
    if (status == FM_OK && said != FM_OK)
        status = fm_fail(err, said, "%s", below.message);
    return status;
}
