/* Equal things found and given one number. */
#ifndef FM_WELD_H
#define FM_WELD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* numbers[i]: the first of the items that equals item i, byte by byte. False: no memory.
 * count: below 2^32 - 1. */
bool weld(uint32_t *numbers, const void *items, size_t item_bytes, size_t count);

#endif
