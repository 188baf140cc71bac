/* What a code would be now: the same files, looked up and hashed again. */
#ifndef FM_CODE_NOW_H
#define FM_CODE_NOW_H

#include "code.h"

/* Where to look; borrowed. */
typedef struct fm_code_places {
    const char *plugins[FM_CODE_OWNER_COUNT]; /* paths of the shared objects; "": none */
    const char *common;                       /* the runner's GLSL; "": not known */
    uint64_t program, driver;                 /* as they are now; 0: not known */
} fm_code_places;

/* Adds to *now, which starts as {0}, each file of `then` with the hash that it has today; 0 where
 * it is gone. */
void code_look_again(fm_code *now, const fm_code *then, const fm_code_places *places);

/* What a launch may have read that left no answer: both plugins, all GLSL beside them, and the
 * runner's. Shaders of other methods are those that `shaders` names, which ends with NULL. */
void code_guess(fm_code *code, const fm_code_places *places, const char *const *shaders);

#endif
