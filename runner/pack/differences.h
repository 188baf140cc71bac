/* What is another here than where results were measured. */
#ifndef FM_PACK_DIFFERENCES_H
#define FM_PACK_DIFFERENCES_H

#include <jansson.h>

#include "base/text.h"
#include "plugin/plugin.h"

/* Adds a sentence for the version, the program, each method whose plugin or GLSL is another or not
 * here, each scene that would be another, and each fact of the machine. Drivers are not looked at:
 * that takes their devices. FM_NO_MEMORY. */
fm_status differences_find(fm_text_list *differences, const json_t *manifest,
                           const fm_plugin_list *plugins, fm_error *err);

#endif
