/* Files of text, line by line and word by word. Lines end with \n, \r\n or \r. */
#ifndef FM_SCAN_H
#define FM_SCAN_H

#include <locale.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

/* A whole file. bytes[count] is 0. */
typedef struct fm_file_bytes {
    const char *path;
    const char *bytes;
    size_t count;
} fm_file_bytes;

typedef struct fm_scan {
    const char *path;
    const char *at, *line_end; /* what is left of the line */
    const char *next, *end;    /* what is left of the file behind it */
    uint64_t line, joints;     /* number of the line, from 1; further ones that it is joined of */
    bool joins;                /* a backslash at a line's end continues it */
    locale_t locale;           /* "C": a point is a point */
} fm_scan;

typedef struct fm_word {
    const char *bytes;
    size_t length;
} fm_word;

/* Skips a byte-order mark. FM_INVALID: UTF-16; FM_NO_MEMORY. scan_close also after a failure. */
fm_status scan_open(fm_scan *scan, const fm_file_bytes *file, fm_error *err);
void scan_close(fm_scan *scan);

/* Goes to the next line that holds a word; false: there is none. `#` at a word's place ends a
 * line. */
bool scan_line(fm_scan *scan);
/* The next word of the line. */
bool scan_word(fm_word *word, fm_scan *scan);
/* The next word, of this line or a later one. */
bool scan_word_on(fm_word *word, fm_scan *scan);
bool scan_has_word(fm_scan *scan);
/* Whether the line is the file's last one and has no end: it may be cut off. */
bool scan_is_open_line(const fm_scan *scan);

/* The arguments of a "%.*s". */
#define WORD_TEXT(word) (int)((word).length < 64 ? (word).length : 64), (word).bytes

bool word_is(fm_word word, const char *text);
bool word_is_any_case(fm_word word, const char *text);
/* A number, infinities and NaN included; decimal only. */
bool word_real(double *value, const fm_scan *scan, fm_word word);
bool word_integer(int64_t *value, fm_word word);

/* "path:line: ...": FM_INVALID. */
fm_status scan_fail(const fm_scan *scan, fm_error *err, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Reads `count` numbers from the line. what: "a vertex", for messages. */
fm_status scan_reals(double *values, int count, fm_scan *scan, const char *what, fm_error *err);
/* The same, from this line and later ones. */
fm_status scan_reals_on(double *values, int count, fm_scan *scan, const char *what, fm_error *err);

#endif
