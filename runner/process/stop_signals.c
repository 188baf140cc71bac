#include "stop_signals.h"

#include <errno.h>
#include <poll.h>
#include <string.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include "base/clock.h"

static const int stops[] = { SIGINT, SIGTERM, SIGHUP };

fm_status stop_signals_open(fm_stop_signals *signals, fm_error *err)
{
    sigset_t watched;
    sigemptyset(&watched);
    for (size_t i = 0; i < sizeof stops / sizeof stops[0]; i++) {
        struct sigaction action = { .sa_handler = SIG_DFL };
        sigaction(stops[i], NULL, &action);
        if (action.sa_handler != SIG_IGN) /* blocked, it would be heard again */
            sigaddset(&watched, stops[i]);
    }
    signals->fd = signalfd(-1, &watched, SFD_CLOEXEC | SFD_NONBLOCK);
    if (signals->fd < 0)
        return fm_fail(err, FM_IO, "no descriptor for signals: %s", strerror(errno));
    sigprocmask(SIG_BLOCK, &watched, &signals->previous);
    return FM_OK;
}

int stop_signals_next(const fm_stop_signals *signals, double seconds)
{
    const double deadline = clock_s() + seconds;
    for (;;) {
        struct signalfd_siginfo info;
        if (read(signals->fd, &info, sizeof info) == sizeof info)
            return (int)info.ssi_signo;
        const double left = deadline - clock_s();
        if (left <= 0.0)
            return 0;
        struct pollfd fd = { .fd = signals->fd, .events = POLLIN };
        poll(&fd, 1, (int)(left * 1e3) + 1);
    }
}

void stop_signals_close(fm_stop_signals *signals)
{
    while (stop_signals_next(signals, 0.0) != 0)
        continue;
    close(signals->fd);
    signals->fd = -1;
    sigprocmask(SIG_SETMASK, &signals->previous, NULL);
}
