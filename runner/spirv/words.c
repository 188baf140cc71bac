#include "words.h"

#include <spirv/unified1/spirv.h>
#include <stdlib.h>
#include <string.h>

static bool make_room(spirv_words *words, size_t count)
{
    size_t room = words->room > 0 ? words->room : 256;
    while (room < words->count + count)
        room *= 2;
    if (room == words->room)
        return true;
    uint32_t *grown = reallocarray(words->items, room, sizeof *grown);
    if (grown == NULL)
        return false;
    words->items = grown;
    words->room = room;
    return true;
}

void words_add(spirv_words *words, const uint32_t *items, size_t count)
{
    words->failed = words->failed || !make_room(words, count);
    if (words->failed || count == 0)
        return;
    memcpy(words->items + words->count, items, count * sizeof *items);
    words->count += count;
}

void words_add_instruction(spirv_words *words, uint32_t opcode, const uint32_t *operands,
                           size_t count)
{
    const uint32_t head = (uint32_t)(count + 1) << SpvWordCountShift | opcode;
    words_add(words, &head, 1);
    words_add(words, operands, count);
}

void words_free(spirv_words *words)
{
    free(words->items);
    *words = (spirv_words){ 0 };
}
