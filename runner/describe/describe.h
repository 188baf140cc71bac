/* Plugins described by a process that may die.
 *
 * The room describe learns what is in plugins without loading them here: describe_child.c loads
 * them in processes of their own and describe.c asks it; description.h is a descriptor as bytes,
 * fields.h the table of its fields, remembered.h keeps descriptions. A plugin that crashes, hangs,
 * prints, forks or ends its process is refused with the reason, and costs nobody else anything.
 *
 * These processes hold faults off, not malice: a plugin runs with the user's rights, here and in
 * workers. One that looks for our processes and kills them can end a run. */
#ifndef FM_DESCRIBE_H
#define FM_DESCRIBE_H

#include "plugin/plugin.h"

/* What describe_plugins works with; zero is the default. */
typedef struct fm_describer {
    const char *program; /* that describes; NULL: this one */
    const char *cache;   /* folder of a cache (cache/cache.h) that keeps descriptions; NULL: the
                            user's; "": none. Where it cannot be used all is slower, not wrong */
} fm_describer;

/* The reader of lists whose plugins are not to run here; list->reader_context is an fm_describer,
 * or NULL. FM_IO, FM_NO_MEMORY: no process could be started, or none of its answers read, or it
 * ended without an answer for a reason that is no plugin's. */
fm_plugin_reader describe_plugins;

/* The other process: `fragmark describe OUT PLUGIN...`. Describes each plugin in a process with
 * limits, some at a time, ends what these leave running, and writes the answers to the file OUT, in
 * slots (answer.h). Returns the exit status: 0 if each plugin has one, or is to blame for none;
 * else why not is said on stderr. */
int describe_main(const char *out, char *const *plugins);

#endif
