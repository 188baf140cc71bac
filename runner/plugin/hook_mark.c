#include "hook_mark.h"

#include <ctype.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/text.h"

static const char *const hook_name[] = {
    [FM_HOOK_LOAD] = "load",         [FM_HOOK_AFTER] = "after", [FM_HOOK_PREDICT] = "predict",
    [FM_HOOK_PLACE] = "place",       [FM_HOOK_SIGN] = "sign",   [FM_HOOK_SKIP] = "skip",
    [FM_HOOK_TILE_END] = "tile_end",
};
_Static_assert(sizeof hook_name / sizeof hook_name[0] == FM_HOOK_COUNT, "one each");

fm_hook_mark *hook_mark_open(const char *path, const char *plugin)
{
    static const fm_hook_mark empty;
    const char *slash = strrchr(plugin, '/');
    void *mapped = MAP_FAILED;
    const int file = open(path, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (file < 0)
        return NULL;
    /* Written first: a page that finds no room on the disk would kill us when it is touched. */
    if (write(file, &empty, sizeof empty) == (ssize_t)sizeof empty)
        mapped = mmap(NULL, sizeof empty, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    if (mapped == MAP_FAILED)
        return NULL;
    fm_hook_mark *mark = mapped;
    snprintf(mark->plugin, sizeof mark->plugin, "%s", slash != NULL ? slash + 1 : plugin);
    return mark;
}

void hook_mark_close(fm_hook_mark *mark)
{
    if (mark != NULL)
        munmap(mark, sizeof *mark);
}

void hook_mark_pass(fm_hook_mark *mark, const char *pass)
{
    if (mark != NULL)
        snprintf(mark->pass, sizeof mark->pass, "%s", pass);
}

/* A name that a plugin could have written over: its first letters that names may have. */
static void take_name(char name[HOOK_MARK_NAME_BYTES], const char *bytes)
{
    size_t count = 0;
    while (count + 1 < HOOK_MARK_NAME_BYTES &&
           (isalnum((unsigned char)bytes[count]) || strchr("-_.", bytes[count]) != NULL) &&
           bytes[count] != '\0')
        count++;
    memcpy(name, bytes, count);
    name[count] = '\0';
}

bool hook_mark_read(char told[HOOK_MARK_TOLD_BYTES], const char *path)
{
    fm_hook_mark mark;
    char *bytes = NULL, plugin[HOOK_MARK_NAME_BYTES], pass[HOOK_MARK_NAME_BYTES], hooks[96] = "";
    size_t count = 0, used = 0;
    if (text_read_file(&bytes, &count, path, sizeof mark, NULL) != FM_OK || count != sizeof mark) {
        free(bytes);
        return false;
    }
    memcpy(&mark, bytes, sizeof mark);
    free(bytes);
    for (int hook = 0; hook < FM_HOOK_COUNT; hook++)
        if (atomic_load(&mark.running[hook]) != 0)
            used += (size_t)snprintf(hooks + used, sizeof hooks - used, "%s'%s'",
                                     used > 0 ? " or " : "", hook_name[hook]);
    take_name(plugin, mark.plugin);
    take_name(pass, mark.pass);
    if (atomic_load(&mark.running[FM_HOOK_LOAD]) != 0)
        snprintf(told, HOOK_MARK_TOLD_BYTES, "while %s was loaded", plugin);
    else
        snprintf(told, HOOK_MARK_TOLD_BYTES, "in hook %s of %s%s%s%s", hooks, plugin,
                 pass[0] != '\0' ? ", pass '" : "", pass, pass[0] != '\0' ? "'" : "");
    return used > 0;
}
