/* How far a run is and how long it may still take, for a human. */
#ifndef FM_PROGRESS_H
#define FM_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* Starts as {0} with out, always, is_terminal and total set. */
typedef struct fm_progress {
    FILE *out;        /* NULL: silent */
    FILE *always;     /* for what is told also where out is NULL; NULL: nothing is */
    bool is_terminal; /* one line, written over; else a line from time to time */
    uint32_t total, done;
    char current[160]; /* what runs now */
    double started_s, written_s;
    double finished_s; /* what they took, one after the other */
    uint32_t finished; /* here, not in an earlier process */
} fm_progress;

void progress_begin(fm_progress *progress, const char *current);
void progress_tick(fm_progress *progress);
/* A line of its own, which stays: "SUBJECT: SENTENCE". */
void progress_tell(fm_progress *progress, const char *subject, const char *sentence);
/* The same, also where nothing else is told. */
void progress_tell_always(fm_progress *progress, const char *subject, const char *sentence);
/* One more launch is done, after so many seconds. */
void progress_end(fm_progress *progress, double seconds);
/* One more is there already, from an earlier process: it tells nothing of the time left. */
void progress_skip(fm_progress *progress);
/* Ends the line on a terminal. */
void progress_close(fm_progress *progress);

/* "1 h 02 min", "3 min 05 s", "7 s". */
void duration_text(char text[32], double seconds);

#endif
