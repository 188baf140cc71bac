/* Where the program keeps what it remembers between runs: the history, the baselines, the
 * calibrations. */
#ifndef FM_STATE_H
#define FM_STATE_H

#include "path.h"

/* path = FOLDER/name, with the folder: `given`; or, where that is NULL, $XDG_STATE_HOME/fragmark;
 * or $HOME/.local/state/fragmark. A variable that is empty, or no absolute path, counts as not set.
 * Folders up to it are made if `is_written`. FM_INVALID: too long, or neither variable is set;
 * also, with the folder and why, one that cannot be made; FM_IO: the disk is full. */
fm_status state_path(char path[FM_PATH_MAX_BYTES], const char *given, const char *name,
                     bool is_written, fm_error *err);

#endif
