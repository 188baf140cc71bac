/* A file of the cache, under its key: it is not there, or holds what its head says. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cache/cache.h"
#include "fuzz.h"

enum { HEAD_BYTES = 64 };

static void write_file(const char *path, const uint8_t *bytes, size_t count)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL || fwrite(bytes, 1, count, file) != count)
        abort();
    fclose(file);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    char folder[] = "/tmp/fm-cache-fuzz-XXXXXX", kind[64], path[160];
    fm_cache cache;
    void *found;
    size_t size;
    if (mkdtemp(folder) == NULL)
        abort();
    cache_open(&cache, folder, 1);
    const cache_key key = cache_key_begin(&cache, CACHE_SPIRV);
    snprintf(kind, sizeof kind, "%s/%s", folder, cache_kinds[CACHE_SPIRV].name);
    snprintf(path, sizeof path, "%s/%016llx%016llx", kind, (unsigned long long)key.words[1],
             (unsigned long long)key.words[0]);
    if (mkdir(kind, 0700) != 0)
        abort();
    write_file(path, bytes, count);
    if (cache_read(&found, &size, &cache, CACHE_SPIRV, &key)) {
        if (size + HEAD_BYTES != count || memcmp(found, bytes + HEAD_BYTES, size) != 0)
            abort();
        free(found);
    }
    unlink(path);
    rmdir(kind);
    rmdir(folder);
    return 0;
}
