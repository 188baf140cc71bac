/* Axes as the user writes them: "4,8,16", "4:64:*2", "4:16:+4", and lists of these. Both ends of a
 * range belong to it, the upper one if a step lands on it. */
#ifndef FM_SWEEP_H
#define FM_SWEEP_H

#include "base/error.h"
#include "base/text.h"
#include "settings.h"

enum { FM_SWEEP_MAX_VALUES = 10000 };

/* One axis: a key of the table, or an option of methods, and the values that it takes. */
typedef struct fm_sweep {
    char name[64];
    const fm_key *key;   /* NULL: an option */
    char *origin;        /* "-a k=4", "spec.yml:12": how messages about it start */
    fm_text_list values; /* a key's in canonical form; each once */
} fm_sweep;

/* Starts an axis without values. FM_INVALID: a name longer than any key or option. */
fm_status sweep_create(fm_sweep *sweep, const char *name, const char *origin, fm_error *err);
/* Adds the values that text describes; a text key takes the whole of it as one value. FM_INVALID
 * starts with the origin. */
fm_status sweep_add(fm_sweep *sweep, const char *text, fm_error *err);
void sweep_destroy(fm_sweep *sweep);

#endif
