#include "machines.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
            provenance_machine_fact(now, base->machine[i].name));
    for (size_t i = 0; i < now->machine_count; i++)
        if (provenance_machine_fact(base, now->machine[i].name)[0] == '\0')
            add(machines, "", now->machine[i].name, "", now->machine[i].value);
}

static const fm_device_info *find_device(const fm_provenance *manifest, const char *selector)
{
    for (size_t i = 0; i < manifest->device_count; i++)
        if (strcmp(manifest->devices[i].selector, selector) == 0)
            return &manifest->devices[i];
    return NULL;
}

/* Devices that both manifests list. */
static void add_listed_devices(fm_machines *machines, const fm_provenance *base,
                               const fm_provenance *now)
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

/* What a row was measured on; a row of an older program may leave it to the manifest. */
static const char *device_name(const fm_result_files *run, const fm_case_row *row)
{
    if (row->device_name[0] != '\0')
        return row->device_name;
    const fm_device_info *listed = find_device(run->manifest, row->device);
    return listed != NULL ? listed->name : "";
}

static bool is_told(const fm_machines *machines, const char *base, const char *now)
{
    for (size_t i = 0; i < machines->count; i++)
        if (strcmp(machines->differing[i].base, base) == 0 &&
            strcmp(machines->differing[i].now, now) == 0)
            return true;
    return false;
}

/* Devices of the cases that have times in both runs. A manifest lists devices when a run ends, so
 * that rows know them where a manifest does not. */
static void add_devices_of_cases(fm_machines *machines, const fm_machines_desc *of)
{
    for (size_t i = 0; i < of->pairs->count; i++) {
        const fm_case_row *base = of->pairs->items[i].base, *now = of->pairs->items[i].now;
        if (base == NULL || now == NULL || !base->is_measured || !now->is_measured ||
            base->is_simulated)
            continue;
        const char *one = device_name(of->base, base), *other = device_name(of->now, now);
        machines->is_same_machine &= one[0] != '\0' && strcmp(one, other) == 0;
        if (!is_told(machines, one, other))
            add(machines, base->device, "name", one, other);
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

fm_status machines_compare(fm_machines *machines, const fm_machines_desc *desc, fm_error *err)
{
    const fm_provenance *base = desc->base->manifest, *now = desc->now->manifest;
    static const char *const facts[] = {
        "fragmark", "git_commit", "launches",  "frames",
        "warmup",   "validation", "no_timers", "precision_percent"
    };
    enum { FACTS = sizeof facts / sizeof facts[0] };
    const fm_hardware here = provenance_hardware(base), there = provenance_hardware(now);
    const size_t most = base->machine_count + now->machine_count + 3 * base->device_count +
                        desc->pairs->count + FACTS;
    *machines = (fm_machines){ .is_same_machine = hardware_is_same(&here, &there) };
    machines->differing = calloc(most, sizeof *machines->differing);
    if (machines->differing == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu facts", most);
    add_machine(machines, base, now);
    add_listed_devices(machines, base, now);
    add_devices_of_cases(machines, desc);
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
