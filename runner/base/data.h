/* Where the program's own data lies: found from the program's place, so that a build, an installed
 * prefix and a bundle work wherever they are moved to.
 *
 *   kind        variable                  in a build   installed, and in a bundle
 *   methods     FRAGMARK_PLUGIN_PATH      methods      ../lib/fragmark/methods
 *   scenes      FRAGMARK_SCENE_PATH       scenes       ../share/fragmark/scenes
 *   figures     FRAGMARK_FIGURE_PATH      figures      ../share/fragmark/figures
 *   references  FRAGMARK_REFERENCE_PATH   reference    ../share/fragmark/reference
 *   recorder    FRAGMARK_RECORDER_PATH    record       ../lib/fragmark/record
 *
 * Folders are seen from that of the program, which /proc/self/exe names. A variable holds folders
 * with colons between them, which are searched first. */
#ifndef FM_DATA_H
#define FM_DATA_H

#include "path.h"
#include "text.h"

typedef enum data_kind {
    DATA_METHODS,
    DATA_SCENES,
    DATA_FIGURES,
    DATA_REFERENCES,
    DATA_RECORDER,
    DATA_KIND_COUNT
} data_kind;

/* The folder of this program. FM_IO: /proc is not there. */
fm_status data_program_folder(char folder[FM_PATH_MAX_BYTES], fm_error *err);

/* Where things of this kind lie in a bundle, seen from its top: "share/fragmark/scenes". */
const char *data_bundle_folder(data_kind kind);

/* The file of a bundle that says what it holds, seen from its top. */
#define DATA_BUNDLE_MANIFEST "bundle.json"
/* Whether this program runs from a bundle. */
bool data_is_bundle(void);

/* Adds the folders of this kind that there are, in the order of the search: those of the variable,
 * then the program's own. FM_IO, with variable, folder and reason: one that the variable names is
 * missing or no folder, or one that is there may not be read. FM_NO_MEMORY. */
fm_status data_folders(fm_text_list *folders, data_kind kind, fm_error *err);

/* The first of a kind's folders that holds the entry NAME+ending: path = FOLDER/NAME.yml.
 * FM_INVALID, with the nearest of the names that there are: none does. Else as data_folders. */
fm_status data_find(char path[FM_PATH_MAX_BYTES], data_kind kind, const char *name,
                    const char *ending, fm_error *err);

#endif
