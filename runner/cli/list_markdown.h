/* `list methods --markdown`: the table of methods/README.md. */
#ifndef FM_CLI_LIST_MARKDOWN_H
#define FM_CLI_LIST_MARKDOWN_H

#include <stdio.h>

#include "plugin/plugin.h"

/* A row a method, from the descriptors alone; refused plugins are left out. */
void list_markdown(FILE *out, const fm_plugin_list *plugins);

/* FM_TRAIT_* in the table's words, with commas between; nothing where there are none. */
void list_markdown_traits(FILE *out, uint32_t traits);

#endif
