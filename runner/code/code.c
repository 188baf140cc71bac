#include "code.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

static const char *const part_name[] = {
    [FM_CODE_PROGRAM] = "program",
    [FM_CODE_DRIVER] = "driver",
    [FM_CODE_PLUGIN] = "plugin",
    [FM_CODE_SHADERS] = "shaders",
};
_Static_assert(sizeof part_name / sizeof part_name[0] == FM_CODE_PART_COUNT, "one each");

const char *code_part_name(fm_code_part part)
{
    return part_name[part];
}

void code_free(fm_code *code)
{
    free(code->files);
    *code = (fm_code){ 0 };
}

static uint64_t not_zero(uint64_t hash)
{
    return hash != 0 ? hash : 1;
}

uint64_t code_hash(const void *bytes, size_t count)
{
    return not_zero(XXH3_64bits(bytes, count));
}

/* By reading: in a mapped file that is cut meanwhile, the next page is a SIGBUS. */
static uint64_t hash_to_end(int fd)
{
    char part[1 << 16];
    ssize_t count;
    uint64_t hash = 0;
    XXH3_state_t *state = XXH3_createState();
    if (state == NULL)
        return 0;
    XXH3_64bits_reset(state);
    while ((count = read(fd, part, sizeof part)) > 0)
        XXH3_64bits_update(state, part, (size_t)count);
    if (count == 0)
        hash = not_zero(XXH3_64bits_digest(state));
    XXH3_freeState(state);
    return hash;
}

uint64_t code_hash_file(const char *path)
{
    struct stat info;
    uint64_t hash = 0;
    const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0)
        return 0;
    if (fstat(fd, &info) == 0 && S_ISREG(info.st_mode))
        hash = hash_to_end(fd);
    close(fd);
    return hash;
}

static int compare(const fm_code_file *file, fm_code_owner owner, const char *name)
{
    if (file->owner != owner)
        return file->owner < owner ? -1 : 1;
    return strcmp(file->name, name);
}

/* Where the file is, or is to be. */
static size_t place_of(const fm_code *code, fm_code_owner owner, const char *name)
{
    size_t low = 0, high = code->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (compare(&code->files[middle], owner, name) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static const fm_code_file *find(const fm_code *code, const fm_code_file *file)
{
    const size_t at = place_of(code, file->owner, file->name);
    const bool is_there =
        at < code->count && compare(&code->files[at], file->owner, file->name) == 0;
    return is_there ? &code->files[at] : NULL;
}

void code_add(fm_code *code, fm_code_owner owner, const char *name, uint64_t hash)
{
    const size_t at = place_of(code, owner, name);
    if (at < code->count && compare(&code->files[at], owner, name) == 0) {
        fm_code_file *known = &code->files[at];
        if (known->hash != hash)
            known->hash = code_hash((const uint64_t[]){ known->hash, hash }, 2 * sizeof hash);
        return;
    }
    fm_code_file *grown = reallocarray(code->files, code->count + 1, sizeof *grown);
    const char *kept = grown != NULL ? text_shared(name) : NULL;
    code->files = grown != NULL ? grown : code->files;
    if (kept == NULL) {
        code->failed = true;
        return;
    }
    memmove(&grown[at + 1], &grown[at], (code->count - at) * sizeof *grown);
    grown[at] = (fm_code_file){ .owner = owner, .name = kept, .hash = hash };
    code->count++;
}

void code_add_plugin(fm_code *code, fm_code_owner owner, const char *path)
{
    const char *slash = strrchr(path, '/');
    code_add(code, owner, slash != NULL ? slash + 1 : path, code_hash_file(path));
}

void code_join(fm_code *code, const fm_code *more)
{
    code->program = code->program != 0 ? code->program : more->program;
    code->driver = code->driver != 0 ? code->driver : more->driver;
    for (size_t i = 0; i < more->count; i++)
        if (find(code, &more->files[i]) == NULL)
            code_add(code, more->files[i].owner, more->files[i].name, more->files[i].hash);
    code->failed = code->failed || more->failed;
}

bool code_file_is_plugin(const fm_code_file *file)
{
    static const char ending[] = ".so";
    const size_t length = strlen(file->name), end = sizeof ending - 1;
    return length > end && strcmp(file->name + length - end, ending) == 0;
}

static uint64_t hash_files(const fm_code *code, bool are_plugins)
{
    uint64_t mixed = 0;
    for (size_t i = 0; i < code->count; i++) {
        const fm_code_file *file = &code->files[i];
        if (code_file_is_plugin(file) != are_plugins)
            continue;
        const uint64_t facts[] = { mixed, (uint64_t)file->owner, file->hash,
                                   code_hash(file->name, strlen(file->name)) };
        mixed = code_hash(facts, sizeof facts);
    }
    return mixed;
}

uint64_t code_part(const fm_code *code, fm_code_part part)
{
    switch (part) {
    case FM_CODE_PROGRAM:
        return code->program;
    case FM_CODE_DRIVER:
        return code->driver;
    case FM_CODE_PLUGIN:
    case FM_CODE_SHADERS:
    case FM_CODE_PART_COUNT:
        break;
    }
    return hash_files(code, part == FM_CODE_PLUGIN);
}

void code_digits(char digits[17], uint64_t hash)
{
    snprintf(digits, 17, "%016llx", (unsigned long long)hash);
    if (hash == 0)
        digits[0] = '\0';
}

bool code_has_driver(const fm_code *code)
{
    return code->driver != 0 && code->driver != code->program;
}

static bool differs(uint64_t a, uint64_t b)
{
    return a != 0 && b != 0 && a != b;
}

uint32_t code_changes(fm_text_list *names, const fm_code *then, const fm_code *now)
{
    uint32_t changes = 0;
    changes |= differs(then->program, now->program) ? 1u << FM_CODE_PROGRAM : 0;
    if (code_has_driver(then))
        changes |= differs(then->driver, now->driver) ? 1u << FM_CODE_DRIVER : 0;
    for (size_t i = 0; i < then->count; i++) {
        const fm_code_file *file = &then->files[i], *other = find(now, file);
        if (other == NULL || other->hash == file->hash)
            continue;
        changes |= 1u << (code_file_is_plugin(file) ? FM_CODE_PLUGIN : FM_CODE_SHADERS);
        if (names != NULL && !text_list_has(names, file->name))
            (void)text_list_add(names, file->name); /* without memory one name less is told */
    }
    return changes;
}
