/* journal.jsonl: what a killed run resumes from. One JSON object a line, flushed to disk:
 *   {"event":"plan","plan":HASH,"run_id":ID,"started":UTC}   first; of a shard also "shard":"2/16"
 *                                                            and "whole":HASH of the whole plan
 *   {"event":"begin","case":ID,"launch":0}                   before a launch
 *   {"event":"end","case":ID,"launch":0,"result":{...}}      after it
 *   {"event":"died","case":ID,"launch":0,"result":{...}}     its worker died the first time: how
 *   {"event":"stop","case":ID,"launch":0}                    it was stopped: it did not finish
 *   {"event":"more","case":ID,"launch":10}                   before it: its times were not precise
 *   {"event":"enough","case":ID,"launch":10}                 they were: there is no such launch
 *   {"event":"forget","case":ID}                             what was measured of it so far is void
 * The file is locked while it is open, so that two runs cannot share a directory. */
#ifndef FM_JOURNAL_H
#define FM_JOURNAL_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"

typedef struct fm_journal fm_journal;

typedef enum fm_journal_event {
    FM_JOURNAL_BEGIN,
    FM_JOURNAL_END,
    FM_JOURNAL_DIED,
    FM_JOURNAL_STOP,
    FM_JOURNAL_MORE, /* decisions at a look: parent/run_look.c */
    FM_JOURNAL_ENOUGH,
    FM_JOURNAL_FORGET, /* of a case: its launch is 0 */
    FM_JOURNAL_EVENT_COUNT
} fm_journal_event;

/* What the lines of an earlier run tell, in order. */
typedef struct fm_journal_reader {
    /* result is borrowed; NULL but for FM_JOURNAL_END and FM_JOURNAL_DIED. FM_INVALID: the line
     * cannot be used: no such case or launch, out of order, a result that cannot be. Other failures
     * end the replay. */
    fm_status (*line)(void *context, fm_journal_event event, const char *case_id, uint32_t launch,
                      const json_t *result, fm_error *err);
    void *context;
} fm_journal_reader;

/* Whose journal it is; borrowed. */
typedef struct fm_journal_plan {
    const char *hash;  /* plan_hash: a journal of another one is refused */
    const char *shard; /* "2/16", and the hash of the whole plan: for the record; NULL: no shard */
    const char *whole;
} fm_journal_plan;

/* Opens or makes DIRECTORY/journal.jsonl.
 * FM_INVALID: in use by another run, or of another plan. FM_IO: damaged, foreign or not writable;
 * *is_damaged tells the first two. */
fm_status journal_open(fm_journal **journal, const char *directory, const fm_journal_plan *plan,
                       bool *is_damaged, fm_error *err);
/* Whether the directory has a journal with a first line: without one, results there are not ours.
 */
bool journal_is_begun(const char *directory);
/* Tells the reader all lines of the run so far, also those that are forgotten further down; not
 * between two calls of journal_write. A torn last line, which a killed run leaves, is cut off once
 * all others were understood. Lines that cannot be used are FM_IO with *is_damaged: the message
 * names the first, how many can be used, and a command that takes the others out and keeps the file
 * as it is. Nothing is changed then. */
fm_status journal_replay(fm_journal *journal, const fm_journal_reader *reader, bool *is_damaged,
                         fm_error *err);
void journal_close(fm_journal *journal);

/* Adds a line and waits until it is on disk. result: of FM_JOURNAL_END and FM_JOURNAL_DIED
 * only; borrowed. */
fm_status journal_write(fm_journal *journal, fm_journal_event event, const char *case_id,
                        uint32_t launch, json_t *result, fm_error *err);

/* It was there before: an earlier process wrote it. */
bool journal_is_continued(const fm_journal *journal);
/* Of the run, not of this process: a resumed run keeps both. */
const char *journal_run_id(const fm_journal *journal);
const char *journal_started(const fm_journal *journal); /* "2026-01-31T12:00:00Z" */

#endif
