/* A SPIR-V module read: its instructions, and where each id that matters here is defined.
 *
 * The room spirv rewrites shaders. What lives here: a reader that trusts no word (this file), and
 * the pass that counts accesses (accesses.h). It calls no compiler and no driver, and knows no
 * method: resources are numbers of bindings. */
#ifndef FM_SPIRV_MODULE_H
#define FM_SPIRV_MODULE_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

/* Words that nobody needs more of: a compiler's largest shader here has a hundredth. */
enum { SPIRV_WORDS_MAX = 1 << 24 };

typedef struct spirv_module {
    const uint32_t *words; /* [count]; borrowed */
    size_t count;
    uint32_t bound;     /* ids are below */
    size_t *defined_at; /* [bound]: where the instruction that makes an id begins; 0: none. Owned */
} spirv_module;

/* One instruction. words[0] holds the opcode and the count. */
typedef struct spirv_instruction {
    const uint32_t *words; /* [count]; as long as the module's */
    uint32_t count;        /* at least as many as are looked at for the opcode */
    uint16_t opcode;
} spirv_instruction;

/* Where the first instruction begins. */
enum { SPIRV_FIRST = 5 };

/* Reads a module of this machine's byte order. FM_INVALID, with the word: it is none, or an
 * instruction is cut off, is too short for its opcode, or makes an id a second time. */
fm_status spirv_open(spirv_module *module, const uint32_t *words, size_t count, fm_error *err);
void spirv_close(spirv_module *module);

/* The instruction at a place where one begins: SPIRV_FIRST, or `at` plus the last one's count. */
spirv_instruction spirv_at(const spirv_module *module, size_t at);
/* The one that makes an id; opcode 0 and no words: there is none. */
spirv_instruction spirv_definition(const spirv_module *module, uint32_t id);
/* The value of an OpConstant of 32 bits; false: it is none. */
bool spirv_constant(uint32_t *value, const spirv_module *module, uint32_t id);
/* The literal behind a decoration of an id, or of a member of it; false: it has none. */
bool spirv_decoration(uint32_t *literal, const spirv_module *module, uint32_t id,
                      uint32_t decoration);
bool spirv_member_decoration(uint32_t *literal, const spirv_module *module, uint32_t id,
                             uint32_t member, uint32_t decoration);
/* The type that the instruction which makes an id says that it has; 0: none. */
uint32_t spirv_type_of(const spirv_module *module, uint32_t id);
/* Storage class and type of what a pointer points at; false: the type is none of a pointer. */
bool spirv_pointer(uint32_t *storage, uint32_t *pointee, const spirv_module *module, uint32_t type);
/* Bytes that a value of a type holds in memory, without padding between members; 0: of no size that
 * is known, such as an array whose length is known at run time only. */
uint64_t spirv_bytes(const spirv_module *module, uint32_t type);

#endif
