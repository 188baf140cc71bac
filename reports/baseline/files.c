#include "files.h"

#include <ctype.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

#include "baseline.h"

static const size_t most_bytes = (size_t)1 << 32;

const baseline_file baseline_files[BASELINE_FILES] = {
    { "manifest.json", true },
    { "summary.csv", true },
    { "samples.csv", false },
    { "journal.jsonl", false },
};

fm_status baseline_hash(char hash[BASELINE_HASH_BYTES], const char *folder, const char *name,
                        const char *to, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], target[FM_PATH_MAX_BYTES];
    char *bytes = NULL;
    size_t count = 0;
    hash[0] = '\0';
    fm_status status = path_join(path, folder, name, err);
    if (status != FM_OK || access(path, F_OK) != 0)
        return status;
    status = text_read_file(&bytes, &count, path, most_bytes, err);
    if (status == FM_OK)
        snprintf(hash, BASELINE_HASH_BYTES, "%016llx",
                 (unsigned long long)XXH3_64bits(bytes, count));
    if (status == FM_OK && to != NULL)
        status = path_join(target, to, name, err);
    if (status == FM_OK && to != NULL)
        status = text_write_file(target, bytes, count, err);
    free(bytes);
    return status;
}

bool baseline_is_name(const char *name)
{
    size_t length = 0;
    for (; name[length] != '\0'; length++)
        if (!isalnum((unsigned char)name[length]) && strchr("._-", name[length]) == NULL)
            return false;
    return length > 0 && length < FM_BASELINE_NAME_BYTES && name[0] != '.';
}

void baseline_remove(const char *folder)
{
    char path[FM_PATH_MAX_BYTES];
    DIR *opened = opendir(folder);
    const struct dirent *entry;
    while (opened != NULL && (entry = readdir(opened)) != NULL)
        if (path_join(path, folder, entry->d_name, NULL) == FM_OK)
            unlink(path); /* . and .. stay */
    if (opened != NULL)
        closedir(opened);
    rmdir(folder);
}
