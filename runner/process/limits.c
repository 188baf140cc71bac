#include "limits.h"

#include <sys/resource.h>

static void limit(int resource, uint64_t value, uint64_t grace)
{
    struct rlimit limits;
    if (value == 0 || getrlimit((__rlimit_resource_t)resource, &limits) != 0)
        return;
    if (value + grace < limits.rlim_max)
        limits.rlim_max = value + grace;
    limits.rlim_cur = value < limits.rlim_max ? value : limits.rlim_max;
    setrlimit((__rlimit_resource_t)resource, &limits);
}

void limits_set(const fm_process_limits *limits)
{
    const struct rlimit no_core = { 0, 0 };
    setrlimit(RLIMIT_CORE, &no_core);
    limit(RLIMIT_AS, limits->memory_bytes, 0);
    limit(RLIMIT_FSIZE, limits->file_bytes, 0);
    limit(RLIMIT_CPU, limits->cpu_s, 1); /* between both it may still tidy up */
    limit(RLIMIT_NOFILE, limits->open_files, 0);
}
