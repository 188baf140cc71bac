/* Errors: a status and one sentence that names file, line, pass or field.
 *
 * The room base holds what any program needs: errors, texts, paths, CSV, YAML, statistics, random
 * numbers, a clock. It knows nothing of fragmark but where its folders
 * lie (data.h): no key, method or scene may be named here. */
#ifndef FM_ERROR_H
#define FM_ERROR_H

#include <stdbool.h>

#include "fragmark/status.h"

/* Why something cannot be done, where it is nobody's fault: one word of a refusal
 * (model/outcome.h). */
/* clang-format off */
typedef enum fm_reason {
    FM_REASON_NONE,         /* no refusal */
    FM_REASON_FEED,         /* not with input that arrives in this way: the method, the device or
                               what is drawn is not made for it */
    FM_REASON_SETTING,      /* a value, of a key or of an option, alone or with others, that
                               cannot be had */
    FM_REASON_DEPTH_TEST,   /* a test against depths as they are rasterised, which do not grow
                               here: the projection is reversed */
    FM_REASON_FEATURE,      /* the device lacks something, in any amount: atomics, an interlock,
                               a format */
    FM_REASON_DEVICE_LIMIT, /* the device has it, but not so large or so many: bytes, samples,
                               layers, bindings */
    FM_REASON_LOOPS,        /* the driver would end, or has ended, loops before they are done */
    FM_REASON_SUITE_LIMIT,  /* this program, or a library in it, counts no further: passes,
                               resources, 2^32 fragments, iterations */
    FM_REASON_SCENE,        /* what is to be drawn cannot be read, or is not to be drawn so */
    FM_REASON_DRIVER,       /* the driver or its compiler gives up, or refuses shaders that no
                               method wrote, or there is none */
    FM_REASON_COUNT
} fm_reason;
/* clang-format on */

typedef struct fm_error {
    fm_status status;
    fm_reason reason; /* of FM_UNSUPPORTED, if fm_refuse said it */
    bool is_own; /* a file that comes with fragmark, or that a run keeps, failed: no plugin is to
                    blame */
    char message[2048];
} fm_error;

/* Fills *err (which may be NULL) and returns status, so that `return fm_fail(...)` reads well. The
 * error has no reason. */
fm_status fm_fail(fm_error *err, fm_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same with FM_UNSUPPORTED. reason: not FM_REASON_NONE. */
fm_status fm_refuse(fm_error *err, fm_reason reason, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* A failure from below of what was given, FM_INVALID or FM_IO, becomes a refusal with its message;
 * any other status stays. Returns what it is now. err may be NULL. */
fm_status fm_error_refuse(fm_error *err, fm_status status, fm_reason reason);

/* Puts "PREFIX: " before the message of an error that came from below; returns its status. Its
 * reason stays. err may be NULL: then nothing is known of the failure, and the answer is
 * FM_INVALID. */
fm_status fm_error_prefix(fm_error *err, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Whether its message names what the world does to whoever opens or writes a file, whoever that is:
 * a full or read-only disk, too many open files. */
bool fm_error_is_the_worlds(const fm_error *err);

#endif
