/* What all parts of the plugin check share: the names of a descriptor's lists, and which words may
 * be names. This module knows no rule about any field. Functions that fail return FM_INVALID and a
 * message that begins with the field; whoever calls puts pass and plugin before it. */
#ifndef FM_CHECK_WORDS_H
#define FM_CHECK_WORDS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "fragmark/method.h"

/* The names of one list of a descriptor, for look-up and for naming the nearest in a message. The
 * strings are the plugin's. */
typedef struct fm_known_names {
    const char *what, *list; /* one of them and all of them in messages: "pass", "passes" */
    bool may_repeat;         /* one name may stand twice: whoever knows why checks that */
    size_t count;
    const char *items[FM_MAX_RESOURCES]; /* resources are the longest list */
} fm_known_names;
_Static_assert((int)FM_MAX_PASSES <= (int)FM_MAX_RESOURCES, "passes fit in fm_known_names");

/* Length of a list of at most `room` entries that ends at the first NULL name. The i-th name lies
 * i * stride_bytes behind `first`. Refused: a name behind the end, an empty name, one name twice.
 */
fm_status check_list(size_t *count, const char *const *first, size_t stride_bytes, size_t room,
                     const char *list, fm_error *err);
/* The same, and the names themselves; names->what and names->list are set by the caller. */
fm_status check_names(fm_known_names *names, const char *const *first, size_t stride_bytes,
                      size_t room, fm_error *err);
/* The index of `word` in `names`. Refused: it is not there; the message has the nearest. */
fm_status check_known(size_t *index, const char *word, const char *field,
                      const fm_known_names *names, fm_error *err);
/* Refused: an enum's value that is not below `count`. */
fm_status check_range(unsigned value, unsigned count, const char *field, fm_error *err);

/* Whether a name is a letter of [a-z], then [a-z0-9] and the characters of `others`. */
bool check_is_word(const char *name, const char *others);
/* Whether GLSL or the runner owns a name, or a macro of it in upper case: gl_x, fm_x, a__b. */
bool check_is_taken(const char *name);
/* Whether no variable or function may have this name: those, and words of GLSL such as buffer. */
bool check_is_reserved(const char *name);
/* Replaces all but letters and digits by '_', as the runner writes names in GLSL. */
void check_fold_name(char *name);

#endif
