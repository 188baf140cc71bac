#include "limits.h"

#include <stdlib.h>
#include <string.h>

const fm_limit_info fm_limits[FM_LIMIT_COUNT] = {
    [FM_LIMIT_COPY] = { "copy", "copying, bytes read and written", "B/s" },
    [FM_LIMIT_ATOMICS_OWN] = { "atomics_own", "atomics, a word each", "1/s" },
    [FM_LIMIT_ATOMICS_GROUP] = { "atomics_group", "atomics, a word for 32", "1/s" },
    [FM_LIMIT_ATOMICS_ONE] = { "atomics_one", "atomics, one word", "1/s" },
    [FM_LIMIT_ATOMICS64_OWN] = { "atomics64_own", "64-bit atomics, a word each", "1/s" },
    [FM_LIMIT_ATOMICS64_GROUP] = { "atomics64_group", "64-bit atomics, a word for 32", "1/s" },
    [FM_LIMIT_ATOMICS64_ONE] = { "atomics64_one", "64-bit atomics, one word", "1/s" },
    [FM_LIMIT_DISPATCH] = { "dispatch", "a compute pass of nothing", "ns" },
    [FM_LIMIT_TIMER] = { "timer", "a timer of nothing", "ns" },
    [FM_LIMIT_RASTER] = { "raster", "fragments rasterised, none kept", "1/s" },
};

static bool is_same(const fm_limits_key *a, const fm_limits_key *b)
{
    return strcmp(a->device_name, b->device_name) == 0 && strcmp(a->driver, b->driver) == 0 &&
           strcmp(a->cpu, b->cpu) == 0 && a->cores == b->cores;
}

const fm_device_limits *limits_find(const fm_limits_list *list, const fm_limits_key *key)
{
    for (size_t i = 0; i < list->count; i++)
        if (is_same(&list->items[i].key, key))
            return &list->items[i];
    return NULL;
}

fm_status limits_keep(fm_limits_list *list, const fm_device_limits *limits, fm_error *err)
{
    for (size_t i = 0; i < list->count; i++) {
        if (!is_same(&list->items[i].key, &limits->key))
            continue;
        list->items[i] = *limits;
        return FM_OK;
    }
    fm_device_limits *grown = reallocarray(list->items, list->count + 1, sizeof *grown);
    if (grown == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu devices", list->count + 1);
    list->items = grown;
    list->items[list->count++] = *limits;
    return FM_OK;
}

void limits_free(fm_limits_list *list)
{
    free(list->items);
    *list = (fm_limits_list){ 0 };
}
