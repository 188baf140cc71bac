/* Files under a key: the file itself, and an entry that says what must be in it. A new file that
 * has its name before its entry does is not believed, and is replaced. */
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cache_internal.h"

static const char file_ending[] = ".file";

typedef struct file_facts {
    uint64_t bytes, digest[2];
} file_facts;

static bool look_at(file_facts *facts, const char *path)
{
    struct stat info;
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW);
    if (fd < 0)
        return false;
    const bool is_read = fstat(fd, &info) == 0 && S_ISREG(info.st_mode) &&
                         cache_digest(facts->digest, &facts->bytes, fd);
    close(fd);
    return is_read;
}

static bool copy_to(int out, const char *from)
{
    enum { BLOCK = 1 << 18 };
    ssize_t count = -1;
    char *block = malloc(BLOCK);
    const int in = open(from, O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW);
    if (in >= 0 && block != NULL)
        while ((count = read(in, block, BLOCK)) > 0)
            if (write(out, block, (size_t)count) != count)
                break;
    if (in >= 0)
        close(in);
    free(block);
    return count == 0;
}

/* A second name, or a copy, at `to`, which is replaced. */
static bool link_or_copy(const char *to, const char *from)
{
    struct stat info;
    if (lstat(from, &info) != 0 || !S_ISREG(info.st_mode))
        return false;
    unlink(to);
    if (link(from, to) == 0)
        return true;
    const int out = open(to, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (out < 0)
        return false;
    const bool is_copied = copy_to(out, from);
    return close(out) == 0 && is_copied;
}

static bool read_facts(file_facts *facts, const fm_cache *cache, cache_kind kind,
                       const cache_key *key)
{
    void *bytes;
    size_t count;
    const bool is_there = cache_read(&bytes, &count, cache, kind, key) && count == sizeof *facts;
    if (is_there)
        memcpy(facts, bytes, sizeof *facts);
    free(bytes);
    return is_there;
}

/* What is looked at keeps its content, whatever becomes of the name in the cache. */
bool cache_read_file(const char *path, const fm_cache *cache, cache_kind kind, const cache_key *key)
{
    char kept[FM_PATH_MAX_BYTES], partial[FM_PATH_MAX_BYTES];
    file_facts wanted, found;
    if (snprintf(partial, sizeof partial, "%s.cached", path) >= (int)sizeof partial ||
        !read_facts(&wanted, cache, kind, key))
        return false;
    cache_path(kept, cache->folder, kind, key, file_ending);
    const bool is_good = link_or_copy(partial, kept) && look_at(&found, partial) &&
                         memcmp(&found, &wanted, sizeof found) == 0;
    if (is_good && rename(partial, path) == 0) {
        unlink(partial); /* two names of one file stay two where one is renamed to the other */
        (void)utimensat(AT_FDCWD, kept, NULL, AT_SYMLINK_NOFOLLOW); /* it was used */
        return true;
    }
    unlink(partial);
    return false;
}

void cache_write_file(fm_cache *cache, cache_kind kind, const cache_key *key, const char *path)
{
    char kept[FM_PATH_MAX_BYTES], partial[FM_PATH_MAX_BYTES];
    file_facts facts;
    struct stat info;
    if (cache->folder[0] == '\0' || stat(path, &info) != 0 ||
        (uint64_t)info.st_size > cache_kinds[kind].most_bytes / CACHE_SHARE)
        return;
    const int fd = cache_open_partial(partial, cache, kind);
    if (fd < 0)
        return;
    close(fd);
    cache_path(kept, cache->folder, kind, key, file_ending);
    if (link_or_copy(partial, path) && look_at(&facts, partial) && rename(partial, kept) == 0)
        cache_write(cache, kind, key, &facts, sizeof facts);
    unlink(partial); /* of what went wrong, or a second name of the same */
}
