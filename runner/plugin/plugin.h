/* Method plugins: finding, opening and checking them, and culling as a transform of their passes.
 *
 * This room knows descriptors and the files beside them. It compiles no shader, allocates nothing
 * on a device and runs no hook. plugin.h and plugin_list.c open plugins; check_*.c check a
 * descriptor, once; culling_apply.h puts an occupancy map before a method's passes. */
#ifndef FM_PLUGIN_H
#define FM_PLUGIN_H

#include <stddef.h>

#include "base/error.h"
#include "fragmark/method.h"
#include "model/settings.h"

/* An open plugin. The descriptor and all its strings live until plugin_close. */
typedef struct fm_plugin {
    const fm_method_desc *method;   /* checked; lies in the shared object */
    char folder[FM_PATH_MAX_BYTES]; /* where its GLSL is; holds a '/' */
    char path[FM_PATH_MAX_BYTES];   /* of the shared object */
    void *handle;                   /* of dlopen(); owned */
} fm_plugin;

/* Whether k is an axis of the method: it keeps the k nearest, or all in k places. */
bool plugin_has_k(const fm_method_desc *method);

/* What a plugin folder holds under one id: opened, or refused with the reason. */
typedef struct fm_plugin_entry {
    char id[64];       /* the folder's name */
    fm_plugin *plugin; /* NULL: refused; owned by the list */
    fm_error error;    /* why it was refused */
} fm_plugin_entry;

/* All that was found. Zero is an empty list. */
typedef struct fm_plugin_list {
    fm_plugin_entry *entries;              /* in the order of their ids, none twice */
    size_t count;                          /* of entries, refused ones counted */
    char common_folder[FM_PATH_MAX_BYTES]; /* GLSL of the runner: the first folder
                                              with common/prelude.glsl; "": none has it */
} fm_plugin_list;

/* Opens one shared object and checks its descriptor. common: the folder of the runner's GLSL,
 * beside which a pass may find the shaders of other methods; NULL: they lie beside the plugin.
 * Messages name plugin, pass and field: "kb.so: pass 'store': reads 'fragmets': no such resource;
 * nearest is 'fragments'". FM_IO: no such file; FM_INVALID: refused. Strings and hooks of the
 * descriptor are trusted to be what they say: a plugin is code. */
fm_status plugin_open(fm_plugin **plugin, const char *path, const char *common, fm_error *err);
/* Frees it, descriptor and all; NULL is allowed. */
void plugin_close(fm_plugin *plugin);

/* Checks a descriptor, as plugin_open does. name is the plugin's in messages. FM_INVALID: it
 * breaks a rule of fragmark/method.h, or sets a field that is not yet there. err may be NULL. */
fm_status plugin_check(const fm_method_desc *method, const char *name, fm_error *err);

/* All plugins of all folders, the first folder winning for an id. Folders, in order: those of
 * --plugin-dir (extra, ending with NULL; may be NULL), FRAGMARK_PLUGIN_PATH (colons), then
 * `methods` beside the executable (build tree) or ../lib/fragmark/methods (install tree).
 * A folder F holds F/ID/ID.so. A plugin that is refused is an entry, not a failure.
 * FM_IO: a folder that --plugin-dir or FRAGMARK_PLUGIN_PATH names cannot be read. */
fm_status plugin_list_open(fm_plugin_list *list, const char *const *extra, fm_error *err);
/* Closes all plugins and empties the list; a list that failed to open is empty. */
void plugin_list_close(fm_plugin_list *list);
/* The entry of this id, refused or not; NULL: there is none. It lives as long as the list. */
const fm_plugin_entry *plugin_list_find(const fm_plugin_list *list, const char *id);
/* The same. FM_INVALID: there is none; the message has the nearest id. */
fm_status plugin_list_get(const fm_plugin_entry **entry, const fm_plugin_list *list, const char *id,
                          fm_error *err);
/* The first method by id with FM_TRAIT_FLOOR that takes this feed (one FM_FEED_* bit). FM_INVALID:
 * none does; *plugin is then NULL. */
fm_status plugin_list_floor(const fm_plugin **plugin, const fm_plugin_list *list, uint32_t feed,
                            fm_error *err);

#endif
