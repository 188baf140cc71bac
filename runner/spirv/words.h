/* A growing list of SPIR-V words. Starts as {0}; failure to grow sticks. */
#ifndef FM_SPIRV_WORDS_H
#define FM_SPIRV_WORDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct spirv_words {
    uint32_t *items; /* [count]; owned */
    size_t count, room;
    bool failed; /* no memory: what was added since is lost */
} spirv_words;

void words_add(spirv_words *words, const uint32_t *items, size_t count);
/* An instruction: opcode and operands. */
void words_add_instruction(spirv_words *words, uint32_t opcode, const uint32_t *operands,
                           size_t count);
void words_free(spirv_words *words);

/* words_put(&out, SpvOpStore, pointer, value) */
#define words_put(words, opcode, ...)                                                              \
    words_add_instruction(words, opcode, (const uint32_t[]){ __VA_ARGS__ },                        \
                          sizeof(const uint32_t[]){ __VA_ARGS__ } / sizeof(uint32_t))

#endif
