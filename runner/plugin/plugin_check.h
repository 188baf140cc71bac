/* The parts of plugin_check: each checks one list of a descriptor, once. Messages start with the
 * field; callers put plugin and pass before them. */
#ifndef FM_PLUGIN_CHECK_H
#define FM_PLUGIN_CHECK_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "fragmark/method.h"

/* The names of a list, for look-up and for the nearest. */
typedef struct fm_known_names {
    const char *what, *list; /* "pass" and "passes", in messages */
    size_t count;
    const char *items[FM_MAX_RESOURCES]; /* the longest list */
} fm_known_names;
_Static_assert((int)FM_MAX_PASSES <= (int)FM_MAX_RESOURCES, "passes fit in fm_known_names");

/* A descriptor whose lists were counted: nothing after that looks for their ends. */
typedef struct fm_checked_method {
    const fm_method_desc *method;
    fm_known_names options, resources, totals, passes;
} fm_checked_method;

fm_status check_options(const fm_checked_method *check, fm_error *err);
fm_status check_resources(const fm_checked_method *check, fm_error *err);
fm_status check_totals(const fm_checked_method *check, fm_error *err);
fm_status check_passes(const fm_checked_method *check, fm_error *err);
fm_status check_loops(const fm_checked_method *check, fm_error *err);
/* Instead of resources, totals, passes and loops. */
fm_status check_technique(const fm_checked_method *check, fm_error *err);

/* Length of a list that ends at the first NULL name; the i-th name lies i * stride_bytes behind
 * first. FM_INVALID: a name stands behind the end, or one is empty or twice there. */
fm_status check_list(size_t *count, const char *const *first, size_t stride_bytes, size_t room,
                     const char *list, fm_error *err);
/* Index of word in names; FM_INVALID: none, with the nearest. */
fm_status check_known(size_t *index, const char *word, const char *field,
                      const fm_known_names *names, fm_error *err);
/* FM_INVALID unless it is an option of whole numbers. */
fm_status check_counting_option(const fm_checked_method *check, const char *name, const char *field,
                                fm_error *err);
fm_status check_range(unsigned value, unsigned count, const char *field, fm_error *err);
/* [a-z] first, then [a-z0-9] and the characters of `others`. */
bool check_is_word(const char *name, const char *others);
/* gl_*, fm_*, a__b: names, and in upper case macros, that GLSL or the runner owns. */
bool check_is_taken(const char *name);
/* Those, and words as buffer or main: no name of a variable or function. */
bool check_is_reserved(const char *name);
/* '-' becomes '_', as GLSL sees names. */
void check_fold_hyphens(char *name);
bool check_is_depth_format(fm_format format);

#endif
