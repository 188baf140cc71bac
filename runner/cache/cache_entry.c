/* Bytes under a key: a head, and the bytes. */
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include "cache_internal.h"

typedef struct entry_head {
    char magic[16];
    cache_key key;
    uint64_t kind, bytes;
    uint64_t digest[2]; /* of the bytes */
} entry_head;
_Static_assert(sizeof(entry_head) == 64, "no padding in the file");

static const char magic[16] = "fragmark cached";

static entry_head head_of(cache_kind kind, const cache_key *key, const void *bytes, size_t count)
{
    const XXH128_hash_t hash = XXH3_128bits(bytes, count);
    entry_head head = {
        .key = *key, .kind = (uint64_t)kind, .bytes = count, .digest = { hash.low64, hash.high64 }
    };
    memcpy(head.magic, magic, sizeof magic);
    return head;
}

/* false: what is there is no entry, or one that nobody would have written. */
static bool find_bytes(size_t *bytes, int fd, cache_kind kind)
{
    struct stat info;
    const uint64_t most = cache_kinds[kind].most_bytes / CACHE_SHARE;
    if (fstat(fd, &info) != 0 || !S_ISREG(info.st_mode) ||
        info.st_size <= (off_t)sizeof(entry_head))
        return false;
    *bytes = (size_t)info.st_size - sizeof(entry_head);
    return *bytes <= most;
}

/* The file may be cut, or grow, meanwhile: what was read is what is checked. */
static bool read_all(int fd, void *bytes, size_t count)
{
    size_t done = 0;
    ssize_t more = 1;
    while (done < count && (more = read(fd, (char *)bytes + done, count - done)) > 0)
        done += (size_t)more;
    return done == count;
}

static bool read_entry(void *bytes, size_t count, int fd, cache_kind kind, const cache_key *key)
{
    entry_head head;
    if (!read_all(fd, &head, sizeof head) || !read_all(fd, bytes, count))
        return false;
    const entry_head wanted = head_of(kind, key, bytes, count);
    return memcmp(&head, &wanted, sizeof head) == 0;
}

bool cache_read(void **bytes, size_t *count, const fm_cache *cache, cache_kind kind,
                const cache_key *key)
{
    char path[FM_PATH_MAX_BYTES];
    void *found = NULL;
    *bytes = NULL;
    *count = 0;
    if (cache->folder[0] == '\0')
        return false;
    cache_path(path, cache->folder, kind, key, "");
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW);
    if (fd < 0)
        return false;
    if (find_bytes(count, fd, kind))
        found = malloc(*count);
    if (found != NULL && read_entry(found, *count, fd, kind, key)) {
        (void)futimens(fd, NULL); /* it was used */
        *bytes = found;
        found = NULL;
    }
    close(fd);
    free(found);
    return *bytes != NULL;
}

static bool write_all(int fd, const void *bytes, size_t count)
{
    size_t done = 0;
    ssize_t more = 1;
    while (done < count && (more = write(fd, (const char *)bytes + done, count - done)) > 0)
        done += (size_t)more;
    return done == count;
}

void cache_write(fm_cache *cache, cache_kind kind, const cache_key *key, const void *bytes,
                 size_t count)
{
    char path[FM_PATH_MAX_BYTES], partial[FM_PATH_MAX_BYTES];
    if (count == 0 || count > cache_kinds[kind].most_bytes / CACHE_SHARE)
        return;
    const int fd = cache_open_partial(partial, cache, kind);
    if (fd < 0)
        return;
    const entry_head head = head_of(kind, key, bytes, count);
    cache_path(path, cache->folder, kind, key, "");
    const bool is_whole = write_all(fd, &head, sizeof head) && write_all(fd, bytes, count);
    if (close(fd) != 0 || !is_whole || rename(partial, path) != 0)
        unlink(partial);
    else
        cache->has_written[kind] = true;
}
