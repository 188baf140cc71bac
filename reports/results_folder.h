/* Whether a folder is one of results, told before its files are read. */
#ifndef FM_RESULTS_FOLDER_H
#define FM_RESULTS_FOLDER_H

#include "base/error.h"

/* FM_INVALID: there is no such folder, it may not be read, it is empty, or neither summary.csv nor
 * manifest.json is in it, with the folder below it that has them. */
fm_status results_folder_check(const char *directory, fm_error *err);

/* What a command ends with (model/exit_code.h): FM_UNSUPPORTED is wrong use, FM_INVALID a damaged
 * file, all else but FM_OK incomplete. */
int results_exit_code(fm_status status);

#endif
