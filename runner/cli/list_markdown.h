/* `list methods --markdown`: the table of methods/README.md. */
#ifndef FM_CLI_LIST_MARKDOWN_H
#define FM_CLI_LIST_MARKDOWN_H

#include <stdio.h>

#include "plugin.h"

/* A row a method, from the descriptors alone; refused plugins are left out. */
void list_markdown(FILE *out, const fm_plugin_list *plugins);

#endif
