/* GLSL to SPIR-V: compiled, or as it was compiled before.
 *
 * The compiler is linked into the program, and its options stand in glsl.c: so the program's hash,
 * which all keys of a cache hold, says which they are. What is kept follows from GLSL and stage
 * alone; whoever rewrites SPIR-V does so with what comes out of glsl_compile. */
#ifndef FM_GLSL_H
#define FM_GLSL_H

#include "base/error.h"
#include "cache/cache.h"

/* Zero: compiles all anew. */
typedef struct glsl_compiler {
    struct shaderc_compiler *started; /* NULL until something has to be compiled; kept: starting one
                                         parses all that is built in, 20 ms */
    fm_cache *cache;                  /* borrowed; NULL: none */
} glsl_compiler;
void glsl_compiler_end(glsl_compiler *compiler);

typedef enum glsl_stage { GLSL_VERTEX, GLSL_FRAGMENT, GLSL_COMPUTE, GLSL_STAGE_COUNT } glsl_stage;

typedef struct glsl_source {
    const char *name; /* of the pipeline, in messages */
    glsl_stage stage;
    const char *glsl; /* whole */
} glsl_source;

typedef struct fm_spirv {
    uint32_t *words; /* owned */
    size_t bytes;
} fm_spirv;

/* FM_SHADER: what the compiler says, with the line of GLSL that it speaks of; FM_NO_MEMORY.
 * glsl_free also after a failure. */
fm_status glsl_compile(fm_spirv *spirv, glsl_compiler *compiler, const glsl_source *source,
                       fm_error *err);
void glsl_free(fm_spirv *spirv);

#endif
