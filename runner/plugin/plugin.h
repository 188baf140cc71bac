/* Finding, opening and checking method plugins. */
#ifndef FM_PLUGIN_H
#define FM_PLUGIN_H

#include <stddef.h>

#include "base/error.h"
#include "fragmark/method.h"
#include "model/settings.h"

typedef struct fm_plugin {
    const fm_method_desc *method;   /* checked */
    char folder[FM_PATH_MAX_BYTES]; /* where its GLSL is */
    char path[FM_PATH_MAX_BYTES];   /* of the shared object */
    void *handle;
} fm_plugin;

/* Whether k is an axis of the method. */
bool plugin_has_k(const fm_method_desc *method);

/* What a plugin folder holds under one id: opened, or refused with the reason. */
typedef struct fm_plugin_entry {
    char id[64];
    fm_plugin *plugin; /* NULL: refused */
    fm_error error;
} fm_plugin_entry;

typedef struct fm_plugin_list {
    fm_plugin_entry *entries; /* by id */
    size_t count;
    char common_folder[FM_PATH_MAX_BYTES]; /* GLSL of the runner: the first folder
                                              with common/prelude.glsl; "": none has it */
} fm_plugin_list;

/* Opens one shared object and checks its descriptor. common: the folder of the runner's GLSL,
 * beside which a pass may find the shaders of other methods; NULL: they lie beside the plugin.
 * Messages name plugin, pass and field: "kb.so: pass 'store': reads 'fragmets': no such resource;
 * nearest is 'fragments'". FM_IO: no such file; FM_INVALID: refused. Strings and hooks of the
 * descriptor are trusted to be what they say: a plugin is code. */
fm_status plugin_open(fm_plugin **plugin, const char *path, const char *common, fm_error *err);
void plugin_close(fm_plugin *plugin);

/* Checks a descriptor, as plugin_open does. name is the plugin's in messages. */
fm_status plugin_check(const fm_method_desc *method, const char *name, fm_error *err);

/* All plugins of all folders, the first folder winning for an id. Folders, in order: those of
 * --plugin-dir (extra, ending with NULL; may be NULL), FRAGMARK_PLUGIN_PATH (colons), then
 * `methods` beside the executable (build tree) or ../lib/fragmark/methods (install tree).
 * A folder F holds F/ID/ID.so. A plugin that is refused is an entry, not a failure.
 * FM_IO: a folder that --plugin-dir or FRAGMARK_PLUGIN_PATH names cannot be read. */
fm_status plugin_list_open(fm_plugin_list *list, const char *const *extra, fm_error *err);
void plugin_list_close(fm_plugin_list *list);
const fm_plugin_entry *plugin_list_find(const fm_plugin_list *list, const char *id);
/* FM_INVALID with the nearest id. */
fm_status plugin_list_get(const fm_plugin_entry **entry, const fm_plugin_list *list, const char *id,
                          fm_error *err);
/* The method with FM_TRAIT_FLOOR that takes this feed (one FM_FEED_*); FM_INVALID without one. */
fm_status plugin_list_floor(const fm_plugin **plugin, const fm_plugin_list *list, uint32_t feed,
                            fm_error *err);

#endif
