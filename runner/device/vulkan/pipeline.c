#include <assert.h>
#include <stdlib.h>

#include "context.h"

static VkDescriptorType descriptor_type(fm_binding_kind kind)
{
    switch (kind) {
    case FM_BINDING_UNIFORM:
        return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case FM_BINDING_STORAGE:
    case FM_BINDING_ADDRESS:
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    case FM_BINDING_SAMPLED:
        return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    case FM_BINDING_STORAGE_IMAGE:
        return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    }
    return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

/* More of a kind than a stage can have is no fault of the shader, only not for here. */
static fm_status check_bindings(const vulkan *self, const fm_pipeline_desc *desc, fm_error *err)
{
    const struct {
        const char *what;
        uint32_t most;
    } limits[] = {
        [FM_BINDING_UNIFORM] = { "uniform buffers",
                                 self->limits.maxPerStageDescriptorUniformBuffers },
        [FM_BINDING_STORAGE] = { "storage buffers",
                                 self->limits.maxPerStageDescriptorStorageBuffers },
        [FM_BINDING_ADDRESS] = { "buffers by address", 0 },
        [FM_BINDING_SAMPLED] = { "sampled images",
                                 self->limits.maxPerStageDescriptorSampledImages },
        [FM_BINDING_STORAGE_IMAGE] = { "storage images",
                                       self->limits.maxPerStageDescriptorStorageImages },
    };
    uint32_t counts[FM_BINDING_STORAGE_IMAGE + 1] = { 0 };
    for (uint32_t i = 0; i < desc->binding_count; i++) {
        const fm_binding_kind kind = desc->bindings[i].kind;
        assert(kind != FM_BINDING_ADDRESS);
        if (++counts[kind] > limits[kind].most)
            return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                             "%s: more than %u %s, the most of a shader here", desc->name,
                             limits[kind].most, limits[kind].what);
    }
    return FM_OK;
}

static fm_status check_targets(const vulkan *self, const fm_pipeline_desc *desc, fm_error *err)
{
    if (desc->target_count > self->base.caps.max_targets)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT, "%s: %u targets, this device's most are %u",
                         desc->name, desc->target_count, self->base.caps.max_targets);
    for (uint32_t i = 0; i < desc->target_count; i++) {
        VkFormatProperties can;
        const fm_target_desc *target = &desc->targets[i];
        vkGetPhysicalDeviceFormatProperties(self->physical,
                                            vulkan_format_of(target->format)->format, &can);
        if (target->blend != FM_BLEND_OFF &&
            (can.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) == 0)
            return fm_refuse(err, FM_REASON_FEATURE,
                             "%s: target %u: its format cannot be blended here", desc->name, i);
    }
    return FM_OK;
}

static fm_status create_layouts(fm_pipeline *pipeline, const vulkan *self,
                                const fm_pipeline_desc *desc, fm_error *err)
{
    VkDescriptorSetLayoutBinding bindings[FM_MAX_BINDINGS];
    for (uint32_t i = 0; i < desc->binding_count; i++) {
        bindings[i] = (VkDescriptorSetLayoutBinding){
            .binding = desc->bindings[i].binding,
            .descriptorType = descriptor_type(desc->bindings[i].kind),
            .descriptorCount = 1,
            .stageFlags = desc->compute != NULL
                              ? VK_SHADER_STAGE_COMPUTE_BIT
                              : VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
        };
    }
    const VkDescriptorSetLayoutCreateInfo set = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = desc->binding_count,
        .pBindings = bindings,
    };
    VkResult result = vkCreateDescriptorSetLayout(self->device, &set, NULL, &pipeline->set_layout);
    if (result != VK_SUCCESS)
        return vulkan_fail(err, result, "%s: bindings", desc->name);
    const VkPipelineLayoutCreateInfo layout = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
        .setLayoutCount = 1,
        .pSetLayouts = &pipeline->set_layout,
    };
    result = vkCreatePipelineLayout(self->device, &layout, NULL, &pipeline->layout);
    return result == VK_SUCCESS ? FM_OK : vulkan_fail(err, result, "%s: layout", desc->name);
}

static VkPipelineShaderStageCreateInfo stage_info(VkShaderStageFlagBits stage,
                                                  VkShaderModule module)
{
    return (VkPipelineShaderStageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
        .stage = stage,
        .module = module,
        .pName = "main",
    };
}

/* A driver's compiler may give up and name no reason (seen on an NVIDIA GPU at a resolve pass with
 * a private array of 2000 records): the device cannot do it, and is not lost. */
static fm_status creation_failed(fm_error *err, VkResult result, const char *name)
{
    if (result == VK_ERROR_UNKNOWN)
        return fm_refuse(err, FM_REASON_DRIVER,
                         "%s: the driver's compiler gives up on this shader (VkResult %d)", name,
                         (int)result);
    return vulkan_fail(err, result, "%s: pipeline", name);
}

static fm_status create_compute(fm_pipeline *pipeline, vulkan *self, const fm_pipeline_desc *desc,
                                fm_error *err)
{
    VkShaderModule module = VK_NULL_HANDLE;
    vulkan_pipelines kept;
    cache_key key = vulkan_pipeline_key(self);
    const glsl_source compute = { desc->name, GLSL_COMPUTE, desc->compute };
    const fm_status status =
        vulkan_shader_create(&module, &key, self, &compute, desc->counting, err);
    if (status != FM_OK)
        return status;
    const VkComputePipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = stage_info(VK_SHADER_STAGE_COMPUTE_BIT, module),
        .layout = pipeline->layout,
    };
    vulkan_pipelines_recall(&kept, self, &key);
    const VkResult result =
        vkCreateComputePipelines(self->device, kept.cache, 1, &info, NULL, &pipeline->pipeline);
    vulkan_pipelines_keep(&kept, self, result == VK_SUCCESS);
    vkDestroyShaderModule(self->device, module, NULL);
    return result == VK_SUCCESS ? FM_OK : creation_failed(err, result, desc->name);
}

/* The parts of a graphics pipeline that depend on its descriptor; they point at one another. */
typedef struct graphics_parts {
    VkVertexInputBindingDescription vertex_buffer;
    VkVertexInputAttributeDescription attributes[FM_MAX_ATTRIBUTES];
    VkPipelineVertexInputStateCreateInfo vertices;
    VkSampleMask sample_mask;
    VkPipelineMultisampleStateCreateInfo samples;
    VkPipelineDepthStencilStateCreateInfo depth_stencil;
    VkPipelineColorBlendAttachmentState blends[FM_MAX_TARGETS];
    VkPipelineColorBlendStateCreateInfo blend;
    VkFormat formats[FM_MAX_TARGETS];
    VkPipelineRenderingCreateInfo rendering;
} graphics_parts;

static void describe_vertices(graphics_parts *parts, const fm_pipeline_desc *desc)
{
    parts->vertex_buffer = (VkVertexInputBindingDescription){ .stride = desc->vertex_stride_bytes };
    for (uint32_t i = 0; i < desc->attribute_count; i++) {
        parts->attributes[i] = (VkVertexInputAttributeDescription){
            .location = desc->attributes[i].location,
            .format = vulkan_vertex_format(&desc->attributes[i]),
            .offset = desc->attributes[i].offset_bytes,
        };
    }
    parts->vertices = (VkPipelineVertexInputStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = desc->vertex_stride_bytes > 0 ? 1 : 0,
        .pVertexBindingDescriptions = &parts->vertex_buffer,
        .vertexAttributeDescriptionCount = desc->attribute_count,
        .pVertexAttributeDescriptions = parts->attributes,
    };
}

static void describe_output(graphics_parts *parts, const fm_pipeline_desc *desc)
{
    const VkFormat depth_stencil = vulkan_format_of(desc->depth_stencil)->format;
    for (uint32_t i = 0; i < desc->target_count; i++) {
        parts->blends[i] = vulkan_blend(&desc->targets[i]);
        parts->formats[i] = vulkan_format_of(desc->targets[i].format)->format;
    }
    parts->blend = (VkPipelineColorBlendStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = desc->target_count,
        .pAttachments = parts->blends,
    };
    parts->rendering = (VkPipelineRenderingCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = desc->target_count,
        .pColorAttachmentFormats = parts->formats,
        .depthAttachmentFormat = depth_stencil,
        .stencilAttachmentFormat = vulkan_format_of(desc->depth_stencil)->has_stencil
                                       ? depth_stencil
                                       : VK_FORMAT_UNDEFINED,
    };
    parts->depth_stencil = vulkan_depth_stencil(desc);
    parts->sample_mask = vulkan_sample_mask(desc);
    parts->samples = (VkPipelineMultisampleStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = (VkSampleCountFlagBits)(desc->samples > 1 ? desc->samples : 1),
        .pSampleMask = &parts->sample_mask,
    };
}

static VkResult build_graphics(fm_pipeline *pipeline, const vulkan *self, graphics_parts *parts,
                               const VkPipelineShaderStageCreateInfo stages[2],
                               VkPipelineCache cache)
{
    static const VkPipelineInputAssemblyStateCreateInfo assembly = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
    };
    static const VkPipelineViewportStateCreateInfo viewport = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1,
    };
    static const VkPipelineRasterizationStateCreateInfo raster = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .lineWidth = 1.0f,
    };
    static const VkDynamicState dynamic_states[] = { VK_DYNAMIC_STATE_VIEWPORT,
                                                     VK_DYNAMIC_STATE_SCISSOR };
    static const VkPipelineDynamicStateCreateInfo dynamic = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = 2,
        .pDynamicStates = dynamic_states,
    };
    const VkGraphicsPipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pNext = &parts->rendering,
        .stageCount = 2,
        .pStages = stages,
        .pVertexInputState = &parts->vertices,
        .pInputAssemblyState = &assembly,
        .pViewportState = &viewport,
        .pRasterizationState = &raster,
        .pMultisampleState = &parts->samples,
        .pDepthStencilState = &parts->depth_stencil,
        .pColorBlendState = &parts->blend,
        .pDynamicState = &dynamic,
        .layout = pipeline->layout,
    };
    return vkCreateGraphicsPipelines(self->device, cache, 1, &info, NULL, &pipeline->pipeline);
}

static fm_status create_graphics(fm_pipeline *pipeline, vulkan *self, const fm_pipeline_desc *desc,
                                 fm_error *err)
{
    VkShaderModule vertex = VK_NULL_HANDLE, fragment = VK_NULL_HANDLE;
    graphics_parts parts;
    vulkan_pipelines kept;
    cache_key key = vulkan_pipeline_key(self);
    const glsl_source shaders[] = {
        { desc->name, GLSL_VERTEX, desc->vertex },
        { desc->name, GLSL_FRAGMENT, desc->fragment },
    };
    fm_status status = check_targets(self, desc, err);
    if (status == FM_OK)
        status = vulkan_shader_create(&vertex, &key, self, &shaders[0], NULL, err);
    if (status == FM_OK)
        status = vulkan_shader_create(&fragment, &key, self, &shaders[1], desc->counting, err);
    if (status != FM_OK)
        goto out;
    const VkPipelineShaderStageCreateInfo stages[] = {
        stage_info(VK_SHADER_STAGE_VERTEX_BIT, vertex),
        stage_info(VK_SHADER_STAGE_FRAGMENT_BIT, fragment),
    };
    describe_vertices(&parts, desc);
    describe_output(&parts, desc);
    vulkan_pipelines_recall(&kept, self, &key);
    const VkResult result = build_graphics(pipeline, self, &parts, stages, kept.cache);
    vulkan_pipelines_keep(&kept, self, result == VK_SUCCESS);
    if (result != VK_SUCCESS)
        status = creation_failed(err, result, desc->name);
out:
    vkDestroyShaderModule(self->device, vertex, NULL);
    vkDestroyShaderModule(self->device, fragment, NULL);
    return status;
}

fm_status vulkan_pipeline_create(fm_pipeline **pipeline, fm_device *device,
                                 const fm_pipeline_desc *desc, fm_error *err)
{
    vulkan *self = (vulkan *)device;
    *pipeline = NULL;
    fm_status status = check_bindings(self, desc, err);
    if (status != FM_OK)
        return status;
    fm_pipeline *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu bytes", desc->name, sizeof *made);
    made->bind_point =
        desc->compute != NULL ? VK_PIPELINE_BIND_POINT_COMPUTE : VK_PIPELINE_BIND_POINT_GRAPHICS;
    status = create_layouts(made, self, desc, err);
    if (status != FM_OK)
        goto out;
    status = desc->compute != NULL ? create_compute(made, self, desc, err)
                                   : create_graphics(made, self, desc, err);
    if (status != FM_OK)
        goto out;
    *pipeline = made;
    made = NULL;
out:
    vulkan_pipeline_destroy(device, made);
    return status;
}

void vulkan_pipeline_destroy(fm_device *device, fm_pipeline *pipeline)
{
    const vulkan *self = (const vulkan *)device;
    if (pipeline != NULL && !self->has_hung) {
        vkDestroyPipeline(self->device, pipeline->pipeline, NULL);
        vkDestroyPipelineLayout(self->device, pipeline->layout, NULL);
        vkDestroyDescriptorSetLayout(self->device, pipeline->set_layout, NULL);
    }
    free(pipeline);
}
