/* What code a row was measured by: hashes of the program, the driver, the plugins and the GLSL.
 *
 * The room code says what that is (code.h), how it travels (code_json.h), what it would be now
 * (code_now.h), what the rows of a run were measured by (codes.h), and where GLSL lies
 * (shader_files.h). It reads files; it loads and runs nothing. A row must have one code: who
 * measures notes what was really read, who continues compares it with what is there. */
#ifndef FM_CODE_H
#define FM_CODE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/text.h"

/* The four parts. A hash of 0: of program and driver it is not known, and differs from nothing; of
 * a file, it cannot be read, which differs from each content. */
typedef enum fm_code_part {
    FM_CODE_PROGRAM, /* the executable's content */
    FM_CODE_DRIVER,  /* what tells this build of the driver, and its device, from all others; of
                        devices that are a part of the program, the program's */
    FM_CODE_PLUGIN,  /* the method's shared object, and the floor's, which ratios rest on */
    FM_CODE_SHADERS, /* all GLSL that was read: the method's, other methods', common, the floor's;
                        what the runner puts around it is the program's */
    FM_CODE_PART_COUNT
} fm_code_part;

/* Whose folder a file's name is seen from. */
typedef enum fm_code_owner {
    FM_CODE_OF_METHOD,
    FM_CODE_OF_FLOOR,
    FM_CODE_OWNER_COUNT
} fm_code_owner;

typedef struct fm_code_file {
    fm_code_owner owner;
    const char *name; /* of GLSL as shader_files.h spells it; of a plugin "ID.so". Shared */
    uint64_t hash;    /* 0: it cannot be read */
} fm_code_file;

/* Starts as {0}. */
typedef struct fm_code {
    uint64_t program, driver;
    fm_code_file *files; /* [count], by owner and name, none twice; owned */
    size_t count;
    bool failed; /* no memory: something is missing */
} fm_code;

void code_free(fm_code *code);

/* Never 0. */
uint64_t code_hash(const void *bytes, size_t count);
/* Of a file's content, as code_hash of its bytes; 0: it cannot be read. Never waits, whatever lies
 * there, and a file may change meanwhile. */
uint64_t code_hash_file(const char *path);

/* Notes a file. One that was read twice and differed gets a hash that no file has. */
void code_add(fm_code *code, fm_code_owner owner, const char *name, uint64_t hash);
/* Notes the shared object at `path` under its name. */
void code_add_plugin(fm_code *code, fm_code_owner owner, const char *path);
/* Takes what `more` knows and `code` does not. */
void code_join(fm_code *code, const fm_code *more);

/* A plugin, by the ending of its name. */
bool code_file_is_plugin(const fm_code_file *file);

/* The word of a part in files and messages: "program", "driver", "plugin", "shaders". */
const char *code_part_name(fm_code_part part);
/* The hash of a part; of all its files together. 0: nothing is known. */
uint64_t code_part(const fm_code *code, fm_code_part part);
/* 16 hex digits; 0 is "". */
void code_digits(char digits[17], uint64_t hash);

/* Whether the driver is another one than the program, and known. */
bool code_has_driver(const fm_code *code);
/* Which parts differ, as bits 1 << part. What only one of the two knows is no difference. names:
 * gets each file that differs, once; NULL: nobody asks. */
uint32_t code_changes(fm_text_list *names, const fm_code *then, const fm_code *now);

#endif
