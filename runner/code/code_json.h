/* A code as JSON, in answers, the journal and beside truths:
 *   { "program": "16 hex digits", "driver": "...", "plugin": "...", "shaders": "...",
 *     "files": { "method": { "kb.so": "16 hex digits", "store.glsl": "...", "common/lock.glsl":
 *                            "..." },
 *                "floor": { "null.so": "...", "store.glsl": "..." } } }
 * What is not known is "". plugin and shaders follow from files. */
#ifndef FM_CODE_JSON_H
#define FM_CODE_JSON_H

#include <jansson.h>

#include "code.h"

/* NULL: no memory. */
json_t *code_to_json(const fm_code *code);
/* false: not such an object. *code is {0} before; code_free also then. */
bool code_from_json(fm_code *code, const json_t *json);

#endif
