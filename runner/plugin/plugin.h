/* Method plugins: finding, opening and checking them, and culling as a transform of their passes.
 *
 * This room knows descriptors and the files beside them. It compiles no shader, allocates nothing
 * on a device and runs no hook. plugin.c opens plugins, plugin_list.c finds them; check_*.c check a
 * descriptor, once; shader_files.h finds GLSL; culling_apply.h puts an occupancy map before a
 * method's passes. */
#ifndef FM_PLUGIN_H
#define FM_PLUGIN_H

#include <stddef.h>

#include "base/error.h"
#include "fragmark/method.h"
#include "model/settings.h"

/* A plugin: loaded, where its hooks are to run, or a description of it, where nothing of it may
 * run. The descriptor and all its strings live until plugin_close. */
typedef struct fm_plugin {
    const fm_method_desc *method;   /* in the shared object, or in `description` */
    char folder[FM_PATH_MAX_BYTES]; /* where its GLSL is; holds a '/' */
    char path[FM_PATH_MAX_BYTES];   /* of the shared object */
    void *handle;                   /* of dlopen(); owned; NULL: not loaded */
    void *description;              /* of malloc(); owned; NULL: loaded */
} fm_plugin;

/* Whether k is an axis of the method: it keeps the k nearest, or all in k places. */
bool plugin_has_k(const fm_method_desc *method);

/* What a plugin folder holds under one id: not read yet, good, or refused with the reason. */
typedef struct fm_plugin_entry {
    char id[64];                  /* the folder's name */
    char path[FM_PATH_MAX_BYTES]; /* of the shared object */
    fm_plugin *plugin;            /* NULL: not read yet, or refused; owned by the list */
    fm_error error;               /* why it was refused; FM_OK: it was not */
} fm_plugin_entry;

struct fm_plugin_list;
/* How a list learns what is in plugins: each of the entries, none of which was read yet, gets its
 * plugin or its error. Another status than FM_OK is a failure that is no plugin's. */
typedef fm_status fm_plugin_reader(const struct fm_plugin_list *list,
                                   fm_plugin_entry *const *entries, size_t count, fm_error *err);

/* All that was found. Zero is an empty list. */
typedef struct fm_plugin_list {
    fm_plugin_entry *entries;              /* in the order of their ids, none twice */
    size_t count;                          /* of entries, refused ones counted */
    char common_folder[FM_PATH_MAX_BYTES]; /* GLSL of the runner: the first folder
                                              with common/prelude.glsl; "": none has it */
    fm_plugin_reader *reader;              /* NULL: plugin_load_entries */
    const void *reader_context;            /* the reader's own */
} fm_plugin_list;

/* Loads one shared object and checks its descriptor. common: the folder of the runner's GLSL,
 * beside which a pass may find the shaders of other methods; NULL: they lie beside the plugin.
 * Messages name plugin, pass and field: "kb.so: pass 'store': reads 'fragmets': no such resource;
 * nearest is 'fragments'". FM_IO: no such file; FM_INVALID: refused. The plugin's code runs: it may
 * end or hang this process. So workers call it, and whoever may die. */
fm_status plugin_open(fm_plugin **plugin, const char *path, const char *common, fm_error *err);
/* Frees it, descriptor and all; NULL is allowed. */
void plugin_close(fm_plugin *plugin);

/* The parts of plugin_open, for a process that describes a plugin and one that takes the
 * description. Loads, and checks nothing. */
fm_status plugin_load(fm_plugin **plugin, const char *path, fm_error *err);
/* A plugin that is not loaded, of a checked descriptor that lies in `description` or outlives it;
 * on success that memory is the plugin's. FM_INVALID: the path is too long. */
fm_status plugin_adopt(fm_plugin **plugin, const char *path, const fm_method_desc *method,
                       void *description, fm_error *err);
/* Checks a descriptor. name is the plugin's in messages. FM_INVALID: it breaks a rule of
 * fragmark/method.h, or sets a field that is not yet there. err may be NULL. */
fm_status plugin_check(const fm_method_desc *method, const char *name, fm_error *err);
/* Checks what lies around the file: its name is the id's, the shaders can be read. */
fm_status plugin_check_files(const fm_plugin *plugin, const char *common, fm_error *err);
/* The part of a path behind its last slash: a plugin's name in messages. */
const char *plugin_file_name(const char *path);

/* All plugins of all folders, the first folder winning for an id; none is read yet. Folders, in
 * order: those of --plugin-dir (extra, ending with NULL; may be NULL), FRAGMARK_PLUGIN_PATH
 * (colons), then `methods` beside the executable (build tree) or ../lib/fragmark/methods (install
 * tree). A folder F holds F/ID/ID.so. Whoever wants another reader sets it afterwards.
 * FM_IO: a folder that --plugin-dir or FRAGMARK_PLUGIN_PATH names cannot be read. */
fm_status plugin_list_open(fm_plugin_list *list, const char *const *extra, fm_error *err);
/* Reads those of the entries that were not read yet. The list stays the same list: what is known of
 * it grows. A plugin that is refused is no failure. */
fm_status plugin_list_read(const fm_plugin_list *list, fm_plugin_entry *const *entries,
                           size_t count, fm_error *err);
fm_status plugin_list_read_all(const fm_plugin_list *list, fm_error *err);
/* The reader that loads plugins into this process: for tests, whose hooks run where they are. */
fm_plugin_reader plugin_load_entries;
/* Whether it was read, and refused. */
bool plugin_entry_is_refused(const fm_plugin_entry *entry);
/* Closes all plugins and empties the list; a list that failed to open is empty. */
void plugin_list_close(fm_plugin_list *list);
/* The entry of this id, read or not; NULL: there is none. It lives as long as the list. */
fm_plugin_entry *plugin_list_find(const fm_plugin_list *list, const char *id);
/* The same. FM_INVALID: there is none; the message has the nearest id. */
fm_status plugin_list_get(fm_plugin_entry **entry, const fm_plugin_list *list, const char *id,
                          fm_error *err);
/* The floor of this feed (one FM_FEED_* bit): the one that fragmark brings, else the first by id
 * with FM_TRAIT_FLOOR that takes the feed. Reads what it needs. FM_INVALID: none does; *plugin is
 * then NULL. */
fm_status plugin_list_floor(const fm_plugin **plugin, const fm_plugin_list *list, uint32_t feed,
                            fm_error *err);

#endif
