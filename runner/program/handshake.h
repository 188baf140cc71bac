/* What a program is asked before its workers measure for another one, and what it answers.
 *
 * It is executed as `fragmark protocol OUT`, and writes to the file OUT:
 *   { "fragmark": "version", "protocol": 1,      of requests and answers: worker/protocol.h
 *     "git_commit": "...", "compiler": "...",
 *     "descriptions": "16 hex digits",           description_form(): how it describes plugins
 *     "keys": ["width_px", ...],                 that its requests may have
 *     "metrics": ["frame_ms", ...] }             that its answers may have
 * Programs of before know no such command. */
#ifndef FM_HANDSHAKE_H
#define FM_HANDSHAKE_H

#include <stdbool.h>

#include "program.h"

/* The program that is asked. Returns its exit status: 0 when the answer was written. */
int handshake_main(const char *out);

/* Asks build->program, and takes down what it says of itself. *is_foreign: it cannot measure for
 * this program: it gives no such answer, or is of another version or protocol, or does not know a
 * key of ours, or has a metric that we do not know. FM_INVALID: it is foreign; the message names
 * both programs, and why. FM_NO_MEMORY. */
fm_status handshake_ask(bool *is_foreign, fm_build *build, fm_error *err);

#endif
