#include "glsl.h"

#include <shaderc/shaderc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/shader_fault.h"

#define SOURCE_NAME "glsl" /* messages begin with it: "glsl:LINE: error: ..." */

static const uint32_t spirv_magic = 0x07230203;

static const struct stage_traits {
    shaderc_shader_kind kind;
    const char *name;
} stage_traits[] = {
    [GLSL_VERTEX] = { shaderc_glsl_vertex_shader, "vertex" },
    [GLSL_FRAGMENT] = { shaderc_glsl_fragment_shader, "fragment" },
    [GLSL_COMPUTE] = { shaderc_glsl_compute_shader, "compute" },
};
_Static_assert(sizeof stage_traits / sizeof stage_traits[0] == GLSL_STAGE_COUNT, "one each");

/* The line of the first error; 0: none says. */
static unsigned find_error_line(const char *log)
{
    for (const char *at = log; at != NULL && *at != '\0';) {
        unsigned line = 0;
        int end = 0; /* stays 0 if the word is not "error": a warning */
        if (sscanf(at, SOURCE_NAME ":%u: error%n", &line, &end) == 1 && end > 0)
            return line;
        at = strchr(at, '\n');
        at = at != NULL ? at + 1 : NULL;
    }
    return 0;
}

void glsl_compiler_end(glsl_compiler *compiler)
{
    shaderc_compiler_release(compiler->started);
    compiler->started = NULL;
}

static bool start(glsl_compiler *compiler)
{
    if (compiler->started == NULL)
        compiler->started = shaderc_compiler_initialize();
    return compiler->started != NULL;
}

static fm_status take(fm_spirv *spirv, const char *name, shaderc_compilation_result_t result,
                      fm_error *err)
{
    const size_t bytes = shaderc_result_get_length(result);
    spirv->words = malloc(bytes);
    if (spirv->words == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu bytes of SPIR-V", name, bytes);
    memcpy(spirv->words, shaderc_result_get_bytes(result), bytes);
    spirv->bytes = bytes;
    return FM_OK;
}

/* SPIR-V is not optimised: drivers do that themselves, and compiling takes half the time. */
static fm_status compile(fm_spirv *spirv, glsl_compiler *compiler, const glsl_source *source,
                         fm_error *err)
{
    const struct stage_traits *traits = &stage_traits[source->stage];
    fm_status status = FM_OK;
    shaderc_compilation_result_t result = NULL;
    shaderc_compile_options_t options = shaderc_compile_options_initialize();
    if (options == NULL || !start(compiler)) {
        status = fm_fail(err, FM_NO_MEMORY, "%s: no memory to compile shaders", source->name);
        goto out;
    }
    shaderc_compile_options_set_target_env(options, shaderc_target_env_vulkan,
                                           shaderc_env_version_vulkan_1_3);
    shaderc_compile_options_set_optimization_level(options, shaderc_optimization_level_zero);
    result = shaderc_compile_into_spv(compiler->started, source->glsl, strlen(source->glsl),
                                      traits->kind, SOURCE_NAME, "main", options);
    if (result == NULL ||
        shaderc_result_get_compilation_status(result) != shaderc_compilation_status_success) {
        const char *log = result != NULL ? shaderc_result_get_error_message(result) : "";
        status = device_fail_shader(err, &(fm_shader_fault){ .pipeline = source->name,
                                                             .stage = traits->name,
                                                             .source = source->glsl,
                                                             .log = log,
                                                             .line = find_error_line(log) });
        goto out;
    }
    status = take(spirv, source->name, result, err);
out:
    shaderc_result_release(result);
    shaderc_compile_options_release(options);
    return status;
}

static cache_key key_of(const fm_cache *cache, const glsl_source *source)
{
    cache_key key = cache_key_begin(cache, CACHE_SPIRV);
    cache_key_add_text(&key, stage_traits[source->stage].name);
    cache_key_add_text(&key, source->glsl);
    return key;
}

static bool recall(fm_spirv *spirv, const fm_cache *cache, const cache_key *key)
{
    void *bytes;
    if (!cache_read(&bytes, &spirv->bytes, cache, CACHE_SPIRV, key))
        return false;
    spirv->words = bytes;
    if (spirv->bytes % sizeof *spirv->words == 0 && spirv->words[0] == spirv_magic)
        return true;
    glsl_free(spirv);
    return false;
}

fm_status glsl_compile(fm_spirv *spirv, glsl_compiler *compiler, const glsl_source *source,
                       fm_error *err)
{
    *spirv = (fm_spirv){ .words = NULL };
    if (compiler->cache == NULL)
        return compile(spirv, compiler, source, err);
    const cache_key key = key_of(compiler->cache, source);
    if (recall(spirv, compiler->cache, &key))
        return FM_OK;
    const fm_status status = compile(spirv, compiler, source, err);
    if (status == FM_OK)
        cache_write(compiler->cache, CACHE_SPIRV, &key, spirv->words, spirv->bytes);
    return status;
}

void glsl_free(fm_spirv *spirv)
{
    free(spirv->words);
    *spirv = (fm_spirv){ .words = NULL };
}
