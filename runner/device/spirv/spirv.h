/* GLSL to SPIR-V: compiled, or as it was compiled before.
 *
 * The compiler is linked into the program, and its options stand in spirv.c: so the program's hash,
 * which all keys of a cache hold, says which they are. What is kept follows from GLSL and stage
 * alone; whoever rewrites SPIR-V does so with what comes out of spirv_make. */
#ifndef FM_SPIRV_H
#define FM_SPIRV_H

#include "base/error.h"
#include "cache/cache.h"

/* Zero: compiles all anew. */
typedef struct spirv_compiler {
    struct shaderc_compiler *started; /* NULL until something has to be compiled; kept: starting one
                                         parses all that is built in, 20 ms */
    fm_cache *cache;                  /* borrowed; NULL: none */
} spirv_compiler;
void spirv_compiler_end(spirv_compiler *compiler);

typedef enum spirv_stage {
    SPIRV_VERTEX,
    SPIRV_FRAGMENT,
    SPIRV_COMPUTE,
    SPIRV_STAGE_COUNT
} spirv_stage;

typedef struct spirv_source {
    const char *name; /* of the pipeline, in messages */
    spirv_stage stage;
    const char *glsl; /* whole */
} spirv_source;

typedef struct fm_spirv {
    uint32_t *words; /* owned */
    size_t bytes;
} fm_spirv;

/* FM_SHADER: what the compiler says, with the line of GLSL that it speaks of; FM_NO_MEMORY.
 * spirv_free also after a failure. */
fm_status spirv_make(fm_spirv *spirv, spirv_compiler *compiler, const spirv_source *source,
                     fm_error *err);
void spirv_free(fm_spirv *spirv);

#endif
