/* Small text helpers. */
#ifndef FM_TEXT_H
#define FM_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "error.h"

/* A growing text. Starts as {0}; failure to grow sticks: `failed` is set and the text stays. */
typedef struct fm_text {
    char *bytes; /* NUL-terminated once anything was added; owned */
    size_t length, capacity;
    bool failed;
} fm_text;

void text_add(fm_text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
void text_add_raw(fm_text *text, const char *bytes, size_t count);
void text_free(fm_text *text);

/* A growing list of owned copies. Starts as {0}. */
typedef struct fm_text_list {
    char **items; /* ends with NULL once anything was added */
    size_t count, capacity;
} fm_text_list;

bool text_list_add(fm_text_list *list, const char *text); /* false: no memory; the list stays */
/* Adds copies of all of `from`, which may be NULL; false: no memory, and perhaps a part was added.
 */
bool text_list_add_all(fm_text_list *list, const fm_text_list *from);
/* Whether the text is in the list, which may be NULL and then holds none. */
bool text_list_has(const fm_text_list *list, const char *text);
/* The items as an array that ends with NULL, also when there are none; it holds until the list
 * changes. */
const char *const *text_list_items(const fm_text_list *list);
void text_list_free(fm_text_list *list);

/* The one copy of the text that the process keeps until it ends: equal texts have equal addresses.
 * NULL: no memory. For one thread. */
const char *text_shared(const char *text);

/* A whole regular file (file.h), NUL-terminated. The caller frees *bytes. FM_INVALID, too: it is
 * larger than limit_bytes. */
fm_status text_read_file(char **bytes, size_t *count, const char *path, size_t limit_bytes,
                         fm_error *err);
/* Writes path.partial, flushes it to disk and renames it: never half a file, and never in the place
 * of what is no file. */
fm_status text_write_file(const char *path, const char *bytes, size_t count, fm_error *err);

/* JSON and HTML take UTF-8 only: no surrogates, nothing overlong. */
bool text_is_utf8(const char *text);
/* Each byte that keeps it from being UTF-8 becomes '?'. */
void text_make_utf8(char *text);

/* The name with the least edit distance; NULL if none is within half of word's length. */
const char *text_nearest(const char *word, const char *const *names, size_t count);

/* Whole text as a number; false: not one, or out of the type's range. No white space, no "4x". */
bool text_to_u64(uint64_t *value, const char *text);
bool text_to_double(double *value, const char *text); /* finite, "C" locale */
/* The shortest text, in the "C" locale, that text_to_double reads back as the same finite value. */
void text_from_double(char text[32], double value);

#endif
