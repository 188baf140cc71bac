#include <stdlib.h>
#include <string.h>

#include "cli.h"

static fm_status add_part(fm_names *names, const char *name, size_t length, fm_error *err)
{
    char **grown = reallocarray(names->names, names->count + 2, sizeof *grown);
    if (grown == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the arguments");
    names->names = grown;
    grown[names->count] = strndup(name, length);
    if (grown[names->count] == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the arguments");
    grown[++names->count] = NULL;
    return FM_OK;
}

fm_status names_add(fm_names *names, const char *name, fm_error *err)
{
    return add_part(names, name, strlen(name), err);
}

fm_status names_add_split(fm_names *names, const char *list, fm_error *err)
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

const char *const *names_list(const fm_names *names)
{
    static const char *const none[] = { NULL };
    return names->names != NULL ? (const char *const *)names->names : none;
}

void names_free(fm_names *names)
{
    for (size_t i = 0; i < names->count; i++)
        free(names->names[i]);
    free(names->names);
    *names = (fm_names){ 0 };
}
