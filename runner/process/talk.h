/* What a process says: the beginning goes to a log, the end is kept. For process.c alone. */
#ifndef FM_TALK_H
#define FM_TALK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "process.h"

typedef struct fm_talk {
    const char *path; /* of the log; NULL: none */
    uint64_t room;    /* what it still takes */
    uint64_t dropped; /* of which the last ones are in `last` */
    int log;          /* -1: not made yet */
    int error;        /* errno: the log cannot be written */
    char last[2 * PROCESS_WORDS_BYTES];
    size_t last_count;
} fm_talk;

void talk_open(fm_talk *talk, const fm_process_desc *desc);
/* Takes what is in the pipe now, which is not blocking. false: all who could write are gone. */
bool talk_drain(fm_talk *talk, int pipe);
/* Drains what is left, ends the log, and copies the last words. FM_IO: it could not be written. */
fm_status talk_close(char words[PROCESS_WORDS_BYTES + 1], fm_talk *talk, int pipe, fm_error *err);

#endif
