#include <stdlib.h>
#include <string.h>

#include "cli.h"

static fm_status fail(fm_error *err)
{
    return fm_fail(err, FM_NO_MEMORY, "no memory for the arguments");
}

fm_status names_add(fm_text_list *names, const char *name, fm_error *err)
{
    return text_list_add(names, name) ? FM_OK : fail(err);
}

static fm_status add_part(fm_text_list *names, const char *part, size_t length, fm_error *err)
{
    char *name = strndup(part, length);
    const fm_status status = name != NULL ? names_add(names, name, err) : fail(err);
    free(name);
    return status;
}

fm_status names_add_split(fm_text_list *names, const char *list, fm_error *err)
{
    const char *part = list;
    for (;;) {
        const size_t length = strcspn(part, ",");
        if (length == 0)
            return fm_fail(err, FM_INVALID, "'%s': an empty name in the list", list);
        const fm_status status = add_part(names, part, length, err);
        if (status != FM_OK || part[length] == '\0')
            return status;
        part += length + 1;
    }
}
