#include "weld.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

/* A table of at least twice as many slots as items, a power of two; a slot holds an item's number
 * + 1. */
static size_t slots_for(size_t count)
{
    size_t slots = 16;
    while (slots < 2 * count)
        slots *= 2;
    return slots;
}

bool weld(uint32_t *numbers, const void *items, size_t item_bytes, size_t count)
{
    const char *bytes = items;
    const size_t slots = slots_for(count);
    uint32_t *table = calloc(slots, sizeof *table);
    if (table == NULL)
        return false;
    for (size_t i = 0; i < count; i++) {
        const char *item = bytes + i * item_bytes;
        size_t slot = (size_t)XXH3_64bits(item, item_bytes) & (slots - 1);
        while (table[slot] != 0 &&
               memcmp(bytes + (size_t)(table[slot] - 1) * item_bytes, item, item_bytes) != 0)
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == 0)
            table[slot] = (uint32_t)i + 1;
        numbers[i] = table[slot] - 1;
    }
    free(table);
    return true;
}
