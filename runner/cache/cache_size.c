/* How much there is, and the removal of what was used least recently. */
#include <dirent.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "cache_internal.h"

enum { PARTIAL_AGE_S = 3600 }; /* of what a process left that was killed as it wrote */

typedef struct cached {
    struct timespec used;
    uint64_t bytes;
    char name[64];
} cached;

typedef struct cached_list {
    cached *items; /* [count]; owned */
    size_t count;
    uint64_t bytes;
} cached_list;

static bool add(cached_list *list, int folder, const char *name)
{
    struct stat info;
    if (strlen(name) >= sizeof list->items->name ||
        fstatat(folder, name, &info, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(info.st_mode))
        return true;
    if ((list->count & (list->count - 1)) == 0) { /* room doubles */
        const size_t room = list->count > 0 ? 2 * list->count : 1;
        cached *grown = reallocarray(list->items, room, sizeof *grown);
        if (grown == NULL)
            return false;
        list->items = grown;
    }
    cached *item = &list->items[list->count++];
    *item = (cached){ .used = info.st_mtim, .bytes = (uint64_t)info.st_size };
    memcpy(item->name, name, strlen(name) + 1);
    list->bytes += item->bytes;
    return true;
}

/* NULL: there is no such folder. The caller closes it, and frees the items. */
static DIR *list_files(cached_list *list, const char *folder, cache_kind kind)
{
    char path[FM_PATH_MAX_BYTES];
    struct dirent *item;
    *list = (cached_list){ .count = 0 };
    if (folder[0] == '\0')
        return NULL;
    cache_path(path, folder, kind, NULL, "");
    DIR *opened = opendir(path);
    if (opened != NULL)
        while ((item = readdir(opened)) != NULL && add(list, dirfd(opened), item->d_name))
            continue;
    return opened;
}

cache_size cache_measure(const char *folder, cache_kind kind)
{
    cached_list list;
    DIR *opened = list_files(&list, folder, kind);
    if (opened != NULL)
        closedir(opened);
    free(list.items);
    return (cache_size){ .files = list.count, .bytes = list.bytes };
}

static int compare_age(const void *left, const void *right)
{
    const struct timespec *a = &((const cached *)left)->used, *b = &((const cached *)right)->used;
    if (a->tv_sec != b->tv_sec)
        return a->tv_sec < b->tv_sec ? -1 : 1;
    return (a->tv_nsec > b->tv_nsec) - (a->tv_nsec < b->tv_nsec);
}

static bool is_left_over(const cached *item, time_t now)
{
    return strncmp(item->name, "partial.", 8) == 0 && now - item->used.tv_sec > PARTIAL_AGE_S;
}

/* Down to three quarters, so that not each process has something to remove. */
static void trim(const fm_cache *cache, cache_kind kind)
{
    cached_list list;
    const uint64_t most = cache_kinds[kind].most_bytes;
    const time_t now = time(NULL);
    DIR *opened = list_files(&list, cache->folder, kind);
    if (opened == NULL)
        return;
    const bool is_full = list.bytes > most;
    if (list.count > 0)
        qsort(list.items, list.count, sizeof *list.items, compare_age);
    for (size_t i = 0; i < list.count; i++) {
        const cached *item = &list.items[i];
        const bool is_too_much = is_full && list.bytes > most / 4 * 3;
        if ((is_too_much || is_left_over(item, now)) && unlinkat(dirfd(opened), item->name, 0) == 0)
            list.bytes -= item->bytes;
    }
    free(list.items);
    closedir(opened);
}

void cache_close(fm_cache *cache)
{
    for (int kind = 0; kind < CACHE_KIND_COUNT; kind++)
        if (cache->has_written[kind])
            trim(cache, (cache_kind)kind);
    *cache = (fm_cache){ .program = 0 };
}
