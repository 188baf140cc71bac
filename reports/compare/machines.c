#include "machines.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

static const double memory_slack = 0.02;

/* "": it does not tell. */
static const char *machine_fact(const fm_provenance *manifest, const char *name)
{
    for (size_t i = 0; i < manifest->machine_count; i++)
        if (strcmp(manifest->machine[i].name, name) == 0)
            return manifest->machine[i].value;
    return "";
}

static bool is_same_size(const char *base, const char *now)
{
    double a, b;
    return text_to_double(&a, base) && text_to_double(&b, now) &&
           fabs(a - b) <= memory_slack * fmax(a, b);
}

/* Known, and the same. */
static bool is_same_hardware(const char *name, const char *base, const char *now)
{
    if (base[0] == '\0' || now[0] == '\0')
        return false;
    return strcmp(base, now) == 0 || (strcmp(name, "memory_bytes") == 0 && is_same_size(base, now));
}

static void add(fm_machines *machines, const char *prefix, const char *name, const char *base,
                const char *now)
{
    if (strcmp(base, now) == 0)
        return;
    fm_machine_fact *fact = &machines->differing[machines->count++];
    snprintf(fact->name, sizeof fact->name, "%.40s%s%.40s", prefix, prefix[0] != '\0' ? " " : "",
             name);
    fact->base = base;
    fact->now = now;
}

static void add_machine(fm_machines *machines, const fm_provenance *base, const fm_provenance *now)
{
    for (size_t i = 0; i < base->machine_count; i++)
        add(machines, "", base->machine[i].name, base->machine[i].value,
            machine_fact(now, base->machine[i].name));
    for (size_t i = 0; i < now->machine_count; i++)
        if (machine_fact(base, now->machine[i].name)[0] == '\0')
            add(machines, "", now->machine[i].name, "", now->machine[i].value);
}

static const fm_device_info *find_device(const fm_provenance *manifest, const char *selector)
{
    for (size_t i = 0; i < manifest->device_count; i++)
        if (strcmp(manifest->devices[i].selector, selector) == 0)
            return &manifest->devices[i];
    return NULL;
}

/* Devices that both used; one that only one used has no case in both. */
static void add_devices(fm_machines *machines, const fm_provenance *base, const fm_provenance *now)
{
    for (size_t i = 0; i < base->device_count; i++) {
        const fm_device_info *one = &base->devices[i];
        const fm_device_info *other = find_device(now, one->selector);
        if (other == NULL)
            continue;
        machines->is_same_machine &= strcmp(one->name, other->name) == 0;
        add(machines, one->selector, "name", one->name, other->name);
        add(machines, one->selector, "driver", one->driver, other->driver);
        add(machines, one->selector, "api", one->api, other->api);
    }
}

/* Of "2026-01-31T12:00:00Z": known, and the same up to the T. */
static bool is_same_day(const char *base, const char *now)
{
    enum { DAY_BYTES = sizeof "2026-01-31" };
    char a[DAY_BYTES], b[DAY_BYTES];
    snprintf(a, sizeof a, "%.10s", base);
    snprintf(b, sizeof b, "%.10s", now);
    return a[0] != '\0' && strcmp(a, b) == 0;
}

fm_status machines_compare(fm_machines *machines, const fm_provenance *base,
                           const fm_provenance *now, fm_error *err)
{
    static const char *const hardware[] = { "cpu", "cores", "memory_bytes" };
    static const char *const facts[] = {
        "fragmark", "git_commit", "launches",  "frames",
        "warmup",   "validation", "no_timers", "precision_percent"
    };
    enum {
        HARDWARE = sizeof hardware / sizeof hardware[0],
        FACTS = sizeof facts / sizeof facts[0]
    };
    const size_t most = base->machine_count + now->machine_count + 3 * base->device_count + FACTS;
    *machines = (fm_machines){ .is_same_machine = true };
    machines->differing = calloc(most, sizeof *machines->differing);
    if (machines->differing == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu facts", most);
    for (size_t i = 0; i < HARDWARE; i++)
        machines->is_same_machine &= is_same_hardware(hardware[i], machine_fact(base, hardware[i]),
                                                      machine_fact(now, hardware[i]));
    add_machine(machines, base, now);
    add_devices(machines, base, now);
    for (size_t i = 0; i < FACTS; i++)
        add(machines, "", facts[i], provenance_fact(base, facts[i]),
            provenance_fact(now, facts[i]));
    machines->is_same_day =
        is_same_day(provenance_fact(base, "started"), provenance_fact(now, "started"));
    return FM_OK;
}

void machines_free(fm_machines *machines)
{
    free(machines->differing);
    *machines = (fm_machines){ 0 };
}
