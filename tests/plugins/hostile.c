/* Plugins that do what no plugin should: each is built of this file, with DEED, one of the
 * functions below, for its constructor, or with a field of the descriptor that is wrong. They lie
 * in a folder of their own, so that only the tests of broken plugins meet them. */
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "head.h"

#ifndef DEED
#define DEED nothing
#endif
#ifndef TITLE
#define TITLE "Hostile"
#endif
#ifndef SIZE
#define SIZE sizeof(fm_method_desc)
#endif
#ifndef ABI
#define ABI FM_ABI
#endif
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

__attribute__((constructor)) static void act(void)
{
    DEED();
}

#ifdef ZEROS
const fm_method_desc fm_method = { 0 };
#else
const fm_method_desc fm_method = {
    HEAD(ID),
    .abi = ABI,
    .size_bytes = SIZE,
    .title = TITLE,
    .resources = { NEAREST },
    .passes = { { .name = "clear",
                  .kind = FM_PASS_CLEAR,
                  .writes = { "nearest" },
                  .clear_word = 0x7F800000u },
                STORE,
                RESOLVE },
};
#endif
