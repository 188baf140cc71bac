#include "crc.h"

#include <string.h>

#define CRC_POLYNOMIAL 0xEDB88320u /* reflected */

void crc_table_fill(crc_table *table)
{
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t crc = i;
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (CRC_POLYNOMIAL & (0u - (crc & 1)));
        table->slice[0][i] = crc;
    }
    for (uint32_t i = 0; i < 256; i++)
        for (int s = 1; s < CRC_SLICES; s++) {
            const uint32_t before = table->slice[s - 1][i];
            table->slice[s][i] = before >> 8 ^ table->slice[0][before & 255];
        }
}

static uint32_t feed_byte(const crc_table *table, uint32_t crc, unsigned char byte)
{
    return crc >> 8 ^ table->slice[0][(crc ^ byte) & 255];
}

uint32_t crc_of(const crc_table *table, const void *bytes, size_t count)
{
    const unsigned char *at = bytes;
    uint32_t crc = 0xFFFFFFFFu;
    for (; count >= 4; count -= 4, at += 4) {
        crc ^=
            (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
        crc = table->slice[3][crc & 255] ^ table->slice[2][crc >> 8 & 255] ^
              table->slice[1][crc >> 16 & 255] ^ table->slice[0][crc >> 24];
    }
    for (; count > 0; count--)
        crc = feed_byte(table, crc, *at++);
    return ~crc;
}

void crc_shift_fill(crc_shift *shift, const crc_table *table, size_t bytes)
{
    uint32_t of_bit[32];
    for (int bit = 0; bit < 32; bit++) {
        of_bit[bit] = 1u << bit;
        for (size_t i = 0; i < bytes; i++)
            of_bit[bit] = feed_byte(table, of_bit[bit], 0);
    }
    memset(shift, 0, sizeof *shift);
    for (int place = 0; place < 4; place++)
        for (uint32_t value = 0; value < 256; value++)
            for (int bit = 0; bit < 8; bit++)
                if ((value >> bit & 1) != 0)
                    shift->byte[place][value] ^= of_bit[8 * place + bit];
}
