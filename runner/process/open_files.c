#include "open_files.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/resource.h>
#include <unistd.h>

enum { DRIVERS_MOST = 200 };

/* The folder itself, which is open meanwhile, and its two dots are counted each time. 0: it cannot
 * be read. */
static uint32_t count_open(void)
{
    uint32_t count = 0;
    DIR *folder = opendir("/proc/self/fd");
    while (folder != NULL && readdir(folder) != NULL)
        count++;
    if (folder != NULL)
        closedir(folder);
    return count;
}

void open_files_begin(fm_open_files *files)
{
    files->before = count_open();
    files->reserve = open("/dev/null", O_RDONLY | O_CLOEXEC);
}

uint32_t open_files_left(fm_open_files *files)
{
    struct rlimit limit = { 0, 0 };
    const bool is_limited =
        getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur / 2 < DRIVERS_MOST;
    const rlim_t most = is_limited ? limit.rlim_cur / 2 : DRIVERS_MOST;
    if (files->reserve >= 0)
        close(files->reserve);
    files->reserve = -1;
    const uint32_t now = count_open();
    const bool is_told = files->before > 0 && now > files->before;
    return is_told && now - files->before > most ? now - files->before : 0;
}
