/* What no plugin should do, one function a deed: for plugins that do it where they are loaded
 * (hostile.c), or in a hook (hostile.c, hostile-technique.c). */
#ifndef FM_TEST_PLUGIN_DEEDS_H
#define FM_TEST_PLUGIN_DEEDS_H

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#define DEED_OF(NAME) __attribute__((unused)) static void NAME(void)

/* The symbols keep the compiler from seeing what nobody should write. */
extern volatile int hostile_zero;
volatile int hostile_zero;

DEED_OF(nothing)
{
}

DEED_OF(exits)
{
    exit(0);
}

DEED_OF(crashes)
{
    raise(SIGSEGV);
}

DEED_OF(spins)
{
    while (hostile_zero == 0)
        continue;
}

DEED_OF(sleeps)
{
    while (hostile_zero == 0)
        pause();
}

DEED_OF(stops)
{
    raise(SIGSTOP);
}

DEED_OF(prints)
{
    puts("HOSTILE OUTPUT");
    fputs("HOSTILE OUTPUT\n", stderr);
    fflush(NULL);
}

DEED_OF(prints_on)
{
    while (hostile_zero == 0)
        prints();
}

DEED_OF(eats)
{
    const size_t bytes = (size_t)64 << 20;
    for (;;) {
        char *eaten = malloc(bytes);
        if (eaten == NULL)
            abort();
        memset(eaten, 1, bytes);
    }
}

/* A daemon in a session of its own, forked twice, that lives on; the plugin is good. */
DEED_OF(daemonises)
{
    if (fork() != 0)
        return;
    setsid();
    if (fork() != 0)
        _exit(0);
    sleeps();
}

DEED_OF(forks)
{
    if (fork() == 0)
        sleeps();
}

DEED_OF(raises_limits)
{
    const struct rlimit none = { RLIM_INFINITY, RLIM_INFINITY };
    setrlimit(RLIMIT_CPU, &none);
    setrlimit(RLIMIT_AS, &none);
    spins();
}

/* All streams are gone; the plugin is good. */
DEED_OF(closes)
{
    for (int fd = 0; fd < 1024; fd++)
        close(fd);
}

DEED_OF(kills_parent)
{
    kill(getppid(), SIGKILL);
    sleeps();
}

DEED_OF(kills_group)
{
    kill(0, SIGKILL);
}

DEED_OF(fills_disk)
{
    char part[1 << 16] = "HOSTILE OUTPUT";
    const int file = open("/tmp", O_TMPFILE | O_RDWR, 0600);
    while (write(file, part, sizeof part) == (ssize_t)sizeof part)
        continue;
    spins();
}

DEED_OF(aborts)
{
    abort();
}

DEED_OF(divides)
{
    raise(SIGFPE);
}

DEED_OF(kills_itself)
{
    raise(SIGKILL);
}

DEED_OF(ends_itself)
{
    raise(SIGTERM);
}

/* Thousands, or as many as there may be; they stay open. */
DEED_OF(leaks)
{
    for (int i = 0; i < 5000 && open("/dev/null", O_RDONLY | O_CLOEXEC) >= 0; i++)
        continue;
}

#endif
