#include "machine.h"

#include <sched.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

/* The rest of the first line of `path` that starts with `key`, without separators and quotes. */
static void read_line(char *value, size_t room, const char *path, const char *key)
{
    char line[512];
    bool is_found = false;
    FILE *file = fopen(path, "r");
    snprintf(value, room, "unknown");
    while (file != NULL && !is_found && fgets(line, sizeof line, file) != NULL) {
        is_found = strncmp(line, key, strlen(key)) == 0;
        if (!is_found)
            continue;
        const char *start = line + strlen(key);
        start += strspn(start, " \t:=\"");
        snprintf(value, room, "%.*s", (int)strcspn(start, "\"\n"), start);
    }
    if (file != NULL)
        fclose(file);
}

void machine_describe(fm_machine *machine)
{
    struct utsname name;
    cpu_set_t cpus;
    read_line(machine->cpu, sizeof machine->cpu, "/proc/cpuinfo", "model name");
    read_line(machine->os, sizeof machine->os, "/etc/os-release", "PRETTY_NAME");
    read_line(machine->governor, sizeof machine->governor,
              "/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "");
    snprintf(machine->kernel, sizeof machine->kernel, "unknown");
    if (uname(&name) == 0)
        snprintf(machine->kernel, sizeof machine->kernel, "%.20s %.60s %.20s", name.sysname,
                 name.release, name.machine);
#if defined(__clang__)
    snprintf(machine->compiler, sizeof machine->compiler, "%s", __VERSION__);
#else
    snprintf(machine->compiler, sizeof machine->compiler, "gcc %s", __VERSION__);
#endif
    machine->cores = (uint32_t)sysconf(_SC_NPROCESSORS_ONLN);
    if (sched_getaffinity(0, sizeof cpus, &cpus) == 0)
        machine->cores = (uint32_t)CPU_COUNT(&cpus);
    machine->memory_bytes = (uint64_t)sysconf(_SC_PHYS_PAGES) * (uint64_t)sysconf(_SC_PAGESIZE);
}
