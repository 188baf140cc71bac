/* CRC32 (the polynomial of zlib) that can be put together: crc(A B) = shift(crc(A)) xor crc(B),
 * where shift is linear and depends on B's length alone. So hardware keeps one small table for each
 * length that occurs, and never reads A again. */
#ifndef FM_TBR_CRC_H
#define FM_TBR_CRC_H

#include <stddef.h>
#include <stdint.h>

enum { CRC_SLICES = 4 };

typedef struct crc_table {
    uint32_t slice[CRC_SLICES][256];
} crc_table;

/* Shifts a CRC over `bytes` further bytes. */
typedef struct crc_shift {
    uint32_t byte[4][256];
} crc_shift;

void crc_table_fill(crc_table *table);
/* CRC32 of count bytes. */
uint32_t crc_of(const crc_table *table, const void *bytes, size_t count);
void crc_shift_fill(crc_shift *shift, const crc_table *table, size_t bytes);

static inline uint32_t crc_combine(const crc_shift *shift, uint32_t crc, uint32_t of_next)
{
    return shift->byte[0][crc & 255] ^ shift->byte[1][crc >> 8 & 255] ^
           shift->byte[2][crc >> 16 & 255] ^ shift->byte[3][crc >> 24] ^ of_next;
}

#endif
