#include <shaderc/shaderc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "context.h"
#include "device/shader_fault.h"

#define SOURCE_NAME "glsl" /* messages begin with it: "glsl:LINE: error: ..." */

typedef struct stage_traits {
    shaderc_shader_kind kind;
    const char *name;
} stage_traits;

static stage_traits traits_of(VkShaderStageFlagBits stage)
{
    if (stage == VK_SHADER_STAGE_COMPUTE_BIT)
        return (stage_traits){ shaderc_glsl_compute_shader, "compute" };
    if (stage == VK_SHADER_STAGE_VERTEX_BIT)
        return (stage_traits){ shaderc_glsl_vertex_shader, "vertex" };
    return (stage_traits){ shaderc_glsl_fragment_shader, "fragment" };
}

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

static fm_status create_module(VkShaderModule *module, const vulkan *self, const char *name,
                               const uint32_t *words, size_t count, fm_error *err)
{
    const VkShaderModuleCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
        .codeSize = count * sizeof *words,
        .pCode = words,
    };
    const VkResult result = vkCreateShaderModule(self->device, &info, NULL, module);
    if (result == VK_SUCCESS)
        return FM_OK;
    *module = VK_NULL_HANDLE;
    return vulkan_fail(err, result, "%s: shader module", name);
}

/* The shader as it was compiled, or as it counts its accesses. */
static fm_status use_words(VkShaderModule *module, const vulkan *self,
                           const vulkan_shader_desc *desc, const uint32_t *words, size_t count,
                           fm_error *err)
{
    uint32_t *counted = NULL;
    size_t counted_words = 0;
    if (desc->counting == NULL)
        return create_module(module, self, desc->name, words, count, err);
    fm_status status =
        spirv_count_accesses(&counted, &counted_words, words, count, desc->counting, err);
    if (status == FM_OK)
        status = create_module(module, self, desc->name, counted, counted_words, err);
    else
        fm_error_prefix(err, "%s", desc->name);
    free(counted);
    return status;
}

fm_status vulkan_compiler_create(vulkan *self, fm_error *err)
{
    self->compiler = shaderc_compiler_initialize();
    return self->compiler != NULL
               ? FM_OK
               : fm_fail(err, FM_NO_MEMORY, "vulkan: the shader compiler does not start");
}

void vulkan_compiler_destroy(vulkan *self)
{
    shaderc_compiler_release(self->compiler);
}

/* SPIR-V is not optimised: drivers do that themselves, and compiling takes half the time. */
fm_status vulkan_shader_create(VkShaderModule *module, const vulkan *self,
                               const vulkan_shader_desc *desc, fm_error *err)
{
    fm_status status = FM_OK;
    const char *source = desc->source;
    const stage_traits traits = traits_of(desc->stage);
    shaderc_compilation_result_t result = NULL;
    shaderc_compile_options_t options = shaderc_compile_options_initialize();
    *module = VK_NULL_HANDLE;
    if (options == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "%s: no memory to compile shaders", desc->name);
        goto out;
    }
    shaderc_compile_options_set_target_env(options, shaderc_target_env_vulkan,
                                           shaderc_env_version_vulkan_1_3);
    shaderc_compile_options_set_optimization_level(options, shaderc_optimization_level_zero);
    result = shaderc_compile_into_spv(self->compiler, source, strlen(source), traits.kind,
                                      SOURCE_NAME, "main", options);
    if (result == NULL ||
        shaderc_result_get_compilation_status(result) != shaderc_compilation_status_success) {
        const char *log = result != NULL ? shaderc_result_get_error_message(result) : "";
        status = device_fail_shader(err, &(fm_shader_fault){ .pipeline = desc->name,
                                                             .stage = traits.name,
                                                             .source = source,
                                                             .log = log,
                                                             .line = find_error_line(log) });
        goto out;
    }
    /* shaderc promises words: its bytes are aligned for them. */
    status = use_words(module, self, desc,
                       (const uint32_t *)(const void *)shaderc_result_get_bytes(result),
                       shaderc_result_get_length(result) / sizeof(uint32_t), err);
out:
    shaderc_result_release(result);
    shaderc_compile_options_release(options);
    return status;
}
