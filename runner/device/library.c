#include "library.h"

#include <elf.h>
#include <link.h>
#include <stdio.h>
#include <string.h>

#include "code/code.h"

typedef struct search {
    uintptr_t address;
    char *build;
    size_t room_bytes;
} search;

static bool holds(const struct dl_phdr_info *object, uintptr_t address)
{
    for (size_t i = 0; i < object->dlpi_phnum; i++) {
        const ElfW(Phdr) *part = &object->dlpi_phdr[i];
        const uintptr_t begin = object->dlpi_addr + part->p_vaddr;
        if (part->p_type == PT_LOAD && address >= begin && address - begin < part->p_memsz)
            return true;
    }
    return false;
}

static void write_digits(const search *wanted, const unsigned char *bytes, size_t count)
{
    for (size_t i = 0; i < count && 2 * i + 2 < wanted->room_bytes; i++)
        snprintf(wanted->build + 2 * i, 3, "%02x", bytes[i]);
}

/* Notes are words: name's length, content's length, kind; then both, padded to words. */
static bool take_build_id(const search *wanted, const unsigned char *notes, size_t count)
{
    ElfW(Nhdr) note;
    for (size_t at = 0; at + sizeof note <= count;) {
        memcpy(&note, notes + at, sizeof note);
        const size_t name = at + sizeof note, content = name + (note.n_namesz + 3u) / 4u * 4u;
        const size_t end = content + (note.n_descsz + 3u) / 4u * 4u;
        if (end > count)
            return false;
        if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 &&
            memcmp(notes + name, "GNU", 4) == 0) {
            write_digits(wanted, notes + content, note.n_descsz);
            return true;
        }
        at = end;
    }
    return false;
}

static int look_at(struct dl_phdr_info *object, size_t size, void *context)
{
    const search *wanted = context;
    (void)size;
    if (!holds(object, wanted->address))
        return 0;
    for (size_t i = 0; i < object->dlpi_phnum; i++) {
        const ElfW(Phdr) *part = &object->dlpi_phdr[i];
        const unsigned char *notes = (const unsigned char *)(object->dlpi_addr + part->p_vaddr);
        if (part->p_type == PT_NOTE && take_build_id(wanted, notes, part->p_filesz))
            return 1;
    }
    char digits[17];
    code_digits(digits, code_hash_file(object->dlpi_name));
    snprintf(wanted->build, wanted->room_bytes, "%s", digits);
    return 1;
}

void library_build(char *build, size_t room_bytes, uintptr_t address)
{
    search wanted = { .address = address, .build = build, .room_bytes = room_bytes };
    build[0] = '\0';
    dl_iterate_phdr(look_at, &wanted);
}

/* The program's own devices are as it is. */
uint64_t device_build_hash(const fm_device_caps *caps, uint64_t program)
{
    const char *const texts[] = { caps->driver_build, caps->name, caps->driver, caps->api };
    uint64_t mixed = 0;
    if (caps->driver_build[0] == '\0')
        return program;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        const uint64_t both[] = { mixed, code_hash(texts[i], strlen(texts[i])) };
        mixed = code_hash(both, sizeof both);
    }
    return mixed;
}
