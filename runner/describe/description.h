/* A descriptor as bytes, and back: how a process that loaded a plugin hands it to one that did not.
 *
 * A description is trusted by nobody. Whoever reads one gets a descriptor that is as good as one
 * that plugin_check took, or a refusal, whatever the bytes are. It belongs to one program: another
 * build may write it otherwise. */
#ifndef FM_DESCRIPTION_H
#define FM_DESCRIPTION_H

#include <stdint.h>

#include "base/error.h"
#include "base/text.h"
#include "fragmark/method.h"

enum { FM_DESCRIPTION_MAX_BYTES = 1 << 18 }; /* longer ones are neither written nor read */

/* A hash of how this program writes them: programs of one form read one another's. */
uint64_t description_form(void);

/* Adds the description of a descriptor that plugin_check took to an empty text. Texts are copied;
 * of a hook only whether there is one. FM_INVALID: its texts are too long, or have no end. */
fm_status description_write(fm_text *bytes, const fm_method_desc *method, fm_error *err);

/* Reads one and checks it, as plugin_check does; name is the plugin's in messages. `memory` is one
 * block that holds *method and all that it points to; the caller frees it. Hooks that are there
 * abort the program when they are called: they run where the plugin is loaded. FM_INVALID: damaged,
 * or of a method that breaks a rule; *method and *memory are then NULL. */
fm_status description_read(const fm_method_desc **method, void **memory, const uint8_t *bytes,
                           size_t count, const char *name, fm_error *err);

#endif
