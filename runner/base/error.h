/* Errors: a status and one sentence that names file, line, pass or field.
 *
 * The room base holds what any program needs: errors, texts, paths, CSV, YAML, statistics, random
 * numbers, a clock. It knows nothing of fragmark but where its folders
 * lie (data.h): no key, method or scene may be named here. */
#ifndef FM_ERROR_H
#define FM_ERROR_H

#include <stdbool.h>

#include "fragmark/status.h"

typedef struct fm_error {
    fm_status status;
    bool is_own; /* a file that comes with fragmark, or that a run keeps, failed: no plugin is to
                    blame */
    char message[2048];
} fm_error;

/* Fills *err (which may be NULL) and returns status, so that `return fm_fail(...)` reads well. */
fm_status fm_fail(fm_error *err, fm_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Puts "PREFIX: " before the message of an error that came from below; returns its status. err may
 * be NULL: then nothing is known of the failure, and the answer is FM_INVALID. */
fm_status fm_error_prefix(fm_error *err, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
