#include "hardware.h"

#include <math.h>
#include <string.h>

#include "base/text.h"

static const double memory_slack = 0.02;

const char *hardware_fact(const fm_provenance *manifest, const char *name)
{
    for (size_t i = 0; i < manifest->machine_count; i++)
        if (strcmp(manifest->machine[i].name, name) == 0)
            return manifest->machine[i].value;
    return "";
}

fm_hardware hardware_of(const fm_provenance *manifest)
{
    fm_hardware hardware = { hardware_fact(manifest, "cpu"), hardware_fact(manifest, "cores"),
                             NAN };
    if (!text_to_double(&hardware.memory_bytes, hardware_fact(manifest, "memory_bytes")))
        hardware.memory_bytes = NAN;
    return hardware;
}

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
