/* The files of a baseline, and their hashes. */
#ifndef FM_BASELINE_FILES_H
#define FM_BASELINE_FILES_H

#include <stdbool.h>

#include "base/path.h"

enum { BASELINE_FILES = 4, BASELINE_HASH_BYTES = 17 };

typedef struct baseline_file {
    const char *name;
    bool is_needed; /* results can do without the others */
} baseline_file;
extern const baseline_file baseline_files[BASELINE_FILES];

/* 16 hex digits of XXH3; "": there is no such file. With `to` it is copied there, too. FM_INVALID,
 * FM_IO, FM_NO_MEMORY. */
fm_status baseline_hash(char hash[BASELINE_HASH_BYTES], const char *folder, const char *name,
                        const char *to, fm_error *err);

/* Whether it is a name: letters, digits, '.', '_' and '-', and not '.' first. */
bool baseline_is_name(const char *name);

/* Removes a folder of a baseline, which has none below it; what is not there is removed. */
void baseline_remove(const char *folder);

#endif
