#include "cache_internal.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

/* What files hold, and how: another number, and none of before is found. */
enum { LAYOUT = 1 };

const cache_kind_info cache_kinds[CACHE_KIND_COUNT] = {
    [CACHE_PLUGINS] = { "plugins", UINT64_C(16) << 20 },
    [CACHE_SPIRV] = { "spirv", UINT64_C(64) << 20 },
    [CACHE_PIPELINES] = { "pipelines", UINT64_C(256) << 20 },
    [CACHE_TRUTH] = { "truth", UINT64_C(4) << 30 },
};

/* NULL: not set, or no absolute path. */
static const char *absolute(const char *variable)
{
    const char *value = getenv(variable);
    return value != NULL && value[0] == '/' ? value : NULL;
}

void cache_find_folder(char folder[FM_PATH_MAX_BYTES])
{
    const char *own = getenv("FRAGMARK_CACHE"), *chosen = absolute("FRAGMARK_CACHE");
    const char *base = absolute("XDG_CACHE_HOME"), *home = absolute("HOME");
    int length = 0;
    folder[0] = '\0';
    if (own != NULL && strcmp(own, "off") == 0)
        return;
    if (chosen != NULL)
        length = snprintf(folder, FM_PATH_MAX_BYTES, "%s", chosen);
    else if (base != NULL)
        length = snprintf(folder, FM_PATH_MAX_BYTES, "%s/fragmark", base);
    else if (home != NULL)
        length = snprintf(folder, FM_PATH_MAX_BYTES, "%s/.cache/fragmark", home);
    if (length < 0 || length >= FM_PATH_MAX_BYTES)
        folder[0] = '\0';
}

void cache_open(fm_cache *cache, const char *folder, uint64_t program)
{
    *cache = (fm_cache){ .program = program };
    if (strlen(folder) < CACHE_ROOM_BYTES)
        strcpy(cache->folder, folder);
}

void cache_key_add(cache_key *key, const void *bytes, size_t count)
{
    const XXH128_hash_t hash = XXH3_128bits(bytes, count);
    const uint64_t all[] = { key->words[0], key->words[1], count, hash.low64, hash.high64 };
    const XXH128_hash_t mixed = XXH3_128bits(all, sizeof all);
    *key = (cache_key){ { mixed.low64, mixed.high64 } };
}

void cache_key_add_text(cache_key *key, const char *text)
{
    cache_key_add(key, text, strlen(text));
}

void cache_key_add_number(cache_key *key, uint64_t number)
{
    cache_key_add(key, &number, sizeof number);
}

cache_key cache_key_begin(const fm_cache *cache, cache_kind kind)
{
    cache_key key = { { 0 } };
    cache_key_add_number(&key, LAYOUT);
    cache_key_add_text(&key, cache_kinds[kind].name);
    cache_key_add_number(&key, cache->program);
    return key;
}

void cache_path(char path[FM_PATH_MAX_BYTES], const char *folder, cache_kind kind,
                const cache_key *key, const char *ending)
{
    const int length = snprintf(path, FM_PATH_MAX_BYTES, "%.*s/%s", CACHE_ROOM_BYTES, folder,
                                cache_kinds[kind].name);
    if (key != NULL)
        snprintf(path + length, FM_PATH_MAX_BYTES - (size_t)length, "/%016llx%016llx%s",
                 (unsigned long long)key->words[1], (unsigned long long)key->words[0], ending);
}

/* Nobody else has to see what is in it. */
static void make_folders(char *path)
{
    for (char *c = path + 1; *c != '\0'; c++) {
        if (*c != '/')
            continue;
        *c = '\0';
        mkdir(path, 0700);
        *c = '/';
    }
    mkdir(path, 0700);
}

int cache_open_partial(char partial[FM_PATH_MAX_BYTES], const fm_cache *cache, cache_kind kind)
{
    char folder[FM_PATH_MAX_BYTES];
    partial[0] = '\0';
    if (cache->folder[0] == '\0')
        return -1;
    cache_path(folder, cache->folder, kind, NULL, "");
    make_folders(folder);
    snprintf(partial, FM_PATH_MAX_BYTES, "%.*s/partial.XXXXXX", FM_PATH_MAX_BYTES - 32, folder);
    const int file = mkostemp(partial, O_CLOEXEC);
    if (file < 0)
        partial[0] = '\0';
    return file;
}

bool cache_digest(uint64_t digest[2], uint64_t *bytes, int fd)
{
    enum { BLOCK = 1 << 18 };
    ssize_t count = -1;
    XXH3_state_t *state = XXH3_createState();
    char *block = malloc(BLOCK);
    *bytes = 0;
    if (state != NULL && block != NULL) {
        XXH3_128bits_reset(state);
        while ((count = read(fd, block, BLOCK)) > 0) {
            XXH3_128bits_update(state, block, (size_t)count);
            *bytes += (uint64_t)count;
        }
        const XXH128_hash_t hash = XXH3_128bits_digest(state);
        digest[0] = hash.low64;
        digest[1] = hash.high64;
    }
    XXH3_freeState(state);
    free(block);
    return count == 0;
}
