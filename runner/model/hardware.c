#include "hardware.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <xxhash.h>

static const double memory_slack = 0.02;

bool hardware_is_known(const fm_hardware *hardware)
{
    return hardware->cpu[0] != '\0' && hardware->cores[0] != '\0' && !isnan(hardware->memory_bytes);
}

bool hardware_is_same(const fm_hardware *a, const fm_hardware *b)
{
    return hardware_is_known(a) && hardware_is_known(b) && strcmp(a->cpu, b->cpu) == 0 &&
           strcmp(a->cores, b->cores) == 0 &&
           fabs(a->memory_bytes - b->memory_bytes) <=
               memory_slack * fmax(a->memory_bytes, b->memory_bytes);
}

void hardware_fingerprint(char fingerprint[FM_FINGERPRINT_BYTES], const fm_hardware *hardware)
{
    char facts[1200];
    const int length = snprintf(facts, sizeof facts, "%s|%s|%.0f", hardware->cpu, hardware->cores,
                                hardware->memory_bytes);
    const uint32_t hash = (uint32_t)XXH3_64bits(facts, (size_t)length);
    snprintf(fingerprint, FM_FINGERPRINT_BYTES, "%08" PRIx32, hash);
}
