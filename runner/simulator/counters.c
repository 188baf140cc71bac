#include "counters.h"

#include <string.h>

const tbr_counter_info tbr_counter_infos[TBR_COUNTER_COUNT] = {
#define TBR_INFO(name, unit) { #name, unit, offsetof(tbr_counters, name) },
    TBR_COUNTERS(TBR_INFO)
#undef TBR_INFO
};

uint64_t counters_get(const tbr_counters *counters, size_t index)
{
    uint64_t value;
    memcpy(&value, (const char *)counters + tbr_counter_infos[index].offset, sizeof value);
    return value;
}

void counters_add(tbr_counters *sum, const tbr_counters *more)
{
#define TBR_ADD(name, unit) sum->name += more->name;
    TBR_COUNTERS(TBR_ADD)
#undef TBR_ADD
}

const tbr_counter_info *counter_find(const char *name)
{
    for (size_t i = 0; i < TBR_COUNTER_COUNT; i++)
        if (strcmp(tbr_counter_infos[i].name, name) == 0)
            return &tbr_counter_infos[i];
    return NULL;
}
