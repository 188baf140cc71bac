/* Shaders as modules, and what the driver made of their pipelines before. */
#include <stdlib.h>
#include <string.h>

#include "context.h"

/* Has the shader count its accesses. */
static fm_status rewrite(fm_spirv *spirv, const char *name, const spirv_counting *counting,
                         fm_error *err)
{
    uint32_t *words = NULL;
    size_t count = 0;
    const fm_status status = spirv_count_accesses(&words, &count, spirv->words,
                                                  spirv->bytes / sizeof *words, counting, err);
    if (status != FM_OK) {
        fm_error_prefix(err, "%s", name);
        free(words);
        return status;
    }
    glsl_free(spirv);
    *spirv = (fm_spirv){ words, count * sizeof *words };
    return FM_OK;
}

fm_status vulkan_shader_create(VkShaderModule *module, cache_key *key, vulkan *self,
                               const glsl_source *source, const spirv_counting *counting,
                               fm_error *err)
{
    fm_spirv spirv;
    *module = VK_NULL_HANDLE;
    fm_status status = glsl_compile(&spirv, &self->compiler, source, err);
    if (status == FM_OK && counting != NULL)
        status = rewrite(&spirv, source->name, counting, err);
    if (status != FM_OK) {
        glsl_free(&spirv);
        return status;
    }
    const VkShaderModuleCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
        .codeSize = spirv.bytes,
        .pCode = spirv.words,
    };
    const VkResult result = vkCreateShaderModule(self->device, &info, NULL, module);
    cache_key_add(key, spirv.words, spirv.bytes);
    glsl_free(&spirv);
    if (result == VK_SUCCESS)
        return FM_OK;
    *module = VK_NULL_HANDLE;
    return vulkan_fail(err, result, "%s: shader module", source->name);
}

/* A driver that keeps nothing, as lavapipe, gives this much (VkPipelineCacheHeaderVersionOne). */
enum { HEADER_BYTES = 32 };

cache_key vulkan_pipeline_key(const vulkan *self)
{
    const fm_cache none = { .program = 0 }, *cache = self->compiler.cache;
    cache_key key = cache_key_begin(cache != NULL ? cache : &none, CACHE_PIPELINES);
    cache_key_add_text(&key, self->base.caps.driver_build);
    cache_key_add_text(&key, self->base.caps.name);
    return key;
}

void vulkan_pipelines_recall(vulkan_pipelines *kept, const vulkan *self, const cache_key *key)
{
    *kept = (vulkan_pipelines){ .key = *key };
    if (self->compiler.cache == NULL)
        return;
    if (!cache_read(&kept->bytes, &kept->count, self->compiler.cache, CACHE_PIPELINES, key))
        kept->count = 0;
    const VkPipelineCacheCreateInfo info = { .sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                             .initialDataSize = kept->count,
                                             .pInitialData = kept->bytes };
    if (vkCreatePipelineCache(self->device, &info, NULL, &kept->cache) != VK_SUCCESS)
        kept->cache = VK_NULL_HANDLE;
}

static bool is_new(const vulkan_pipelines *kept, const void *bytes, size_t count)
{
    return count > HEADER_BYTES && (count != kept->count || memcmp(bytes, kept->bytes, count) != 0);
}

void vulkan_pipelines_keep(vulkan_pipelines *kept, const vulkan *self, bool is_made)
{
    size_t count = 0;
    void *bytes = NULL;
    if (is_made && kept->cache != VK_NULL_HANDLE &&
        vkGetPipelineCacheData(self->device, kept->cache, &count, NULL) == VK_SUCCESS &&
        count > HEADER_BYTES)
        bytes = malloc(count);
    if (bytes != NULL &&
        vkGetPipelineCacheData(self->device, kept->cache, &count, bytes) == VK_SUCCESS &&
        is_new(kept, bytes, count))
        cache_write(self->compiler.cache, CACHE_PIPELINES, &kept->key, bytes, count);
    vkDestroyPipelineCache(self->device, kept->cache, NULL);
    free(bytes);
    free(kept->bytes);
}
