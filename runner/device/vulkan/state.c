#include "context.h"

/* FM_COMPARE_OFF is ALWAYS for a depth that is written without a test. */
static const VkCompareOp compare_op[] = {
    [FM_COMPARE_OFF] = VK_COMPARE_OP_ALWAYS,
    [FM_COMPARE_NEVER] = VK_COMPARE_OP_NEVER,
    [FM_COMPARE_LESS] = VK_COMPARE_OP_LESS,
    [FM_COMPARE_EQUAL] = VK_COMPARE_OP_EQUAL,
    [FM_COMPARE_LESS_EQUAL] = VK_COMPARE_OP_LESS_OR_EQUAL,
    [FM_COMPARE_GREATER] = VK_COMPARE_OP_GREATER,
    [FM_COMPARE_NOT_EQUAL] = VK_COMPARE_OP_NOT_EQUAL,
    [FM_COMPARE_GREATER_EQUAL] = VK_COMPARE_OP_GREATER_OR_EQUAL,
    [FM_COMPARE_ALWAYS] = VK_COMPARE_OP_ALWAYS,
};
_Static_assert(sizeof compare_op / sizeof compare_op[0] == FM_COMPARE_COUNT, "each");

static const VkStencilOp stencil_op[] = {
    [FM_STENCIL_KEEP] = VK_STENCIL_OP_KEEP,
    [FM_STENCIL_ZERO] = VK_STENCIL_OP_ZERO,
    [FM_STENCIL_REPLACE] = VK_STENCIL_OP_REPLACE,
    [FM_STENCIL_INCREMENT] = VK_STENCIL_OP_INCREMENT_AND_CLAMP,
    [FM_STENCIL_DECREMENT] = VK_STENCIL_OP_DECREMENT_AND_CLAMP,
    [FM_STENCIL_INVERT] = VK_STENCIL_OP_INVERT,
    [FM_STENCIL_INCREMENT_WRAP] = VK_STENCIL_OP_INCREMENT_AND_WRAP,
    [FM_STENCIL_DECREMENT_WRAP] = VK_STENCIL_OP_DECREMENT_AND_WRAP,
};
_Static_assert(sizeof stencil_op / sizeof stencil_op[0] == FM_STENCIL_OP_COUNT, "each");

typedef struct blend_function {
    VkBlendOp op;
    VkBlendFactor source_rgb, target_rgb, source_alpha, target_alpha;
} blend_function;

#define ONE               VK_BLEND_FACTOR_ONE
#define ZERO              VK_BLEND_FACTOR_ZERO
#define LESS_SOURCE_ALPHA VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA
#define LESS_SOURCE       VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR

static const blend_function blend_functions[] = {
    [FM_BLEND_OFF] = { VK_BLEND_OP_ADD, ONE, ZERO, ONE, ZERO },
    [FM_BLEND_ADD] = { VK_BLEND_OP_ADD, ONE, ONE, ONE, ONE },
    [FM_BLEND_MAX] = { VK_BLEND_OP_MAX, ONE, ONE, ONE, ONE },
    [FM_BLEND_MIN] = { VK_BLEND_OP_MIN, ONE, ONE, ONE, ONE },
    [FM_BLEND_OVER] = { VK_BLEND_OP_ADD, ONE, LESS_SOURCE_ALPHA, ONE, LESS_SOURCE_ALPHA },
    [FM_BLEND_UNDER] = { VK_BLEND_OP_ADD, VK_BLEND_FACTOR_DST_ALPHA, ONE, ZERO, LESS_SOURCE_ALPHA },
    [FM_BLEND_PRODUCT] = { VK_BLEND_OP_ADD, ZERO, LESS_SOURCE, ZERO, LESS_SOURCE_ALPHA },
};
_Static_assert(sizeof blend_functions / sizeof blend_functions[0] == FM_BLEND_COUNT, "each");

static const VkFormat element_format[] = {
    [FM_ELEMENT_UINT] = VK_FORMAT_R32_UINT,
    [FM_ELEMENT_UVEC2] = VK_FORMAT_R32G32_UINT,
    [FM_ELEMENT_UVEC4] = VK_FORMAT_R32G32B32A32_UINT,
    [FM_ELEMENT_FLOAT] = VK_FORMAT_R32_SFLOAT,
    [FM_ELEMENT_VEC2] = VK_FORMAT_R32G32_SFLOAT,
    [FM_ELEMENT_VEC4] = VK_FORMAT_R32G32B32A32_SFLOAT,
    [FM_ELEMENT_UINT64] = VK_FORMAT_R32G32_UINT,
};
_Static_assert(sizeof element_format / sizeof element_format[0] == FM_ELEMENT_COUNT, "each");

VkPipelineDepthStencilStateCreateInfo vulkan_depth_stencil(const fm_pipeline_desc *desc)
{
    const fm_state *state = &desc->state;
    const bool has_depth = desc->depth_stencil != FM_FORMAT_NONE;
    const bool has_stencil = vulkan_format_of(desc->depth_stencil)->has_stencil;
    const VkStencilOpState stencil = {
        .failOp = stencil_op[state->stencil_fail],
        .depthFailOp = stencil_op[state->stencil_depth_fail],
        .passOp = stencil_op[state->stencil_pass],
        .compareOp = compare_op[state->stencil_test],
        .compareMask = 0xFFu,
        .writeMask = 0xFFu,
        .reference =
            (state->stencil_reference + state->stencil_reference_step * desc->iteration) & 0xFFu,
    };
    return (VkPipelineDepthStencilStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        /* depth is written only where it is tested */
        .depthTestEnable = has_depth && (state->depth_test != FM_COMPARE_OFF || state->depth_write),
        .depthWriteEnable = has_depth && state->depth_write,
        .depthCompareOp = compare_op[state->depth_test],
        .stencilTestEnable = has_stencil && state->stencil_test != FM_COMPARE_OFF,
        .front = stencil,
        .back = stencil,
    };
}

VkSampleMask vulkan_sample_mask(const fm_pipeline_desc *desc)
{
    const uint64_t shift = (uint64_t)desc->state.sample_mask_step * desc->iteration;
    if (desc->state.sample_mask == 0)
        return ~0u;
    return shift < 32 ? desc->state.sample_mask << shift : 0;
}

VkPipelineColorBlendAttachmentState vulkan_blend(const fm_target_desc *target)
{
    const blend_function *function = &blend_functions[target->blend];
    return (VkPipelineColorBlendAttachmentState){
        .blendEnable = target->blend != FM_BLEND_OFF,
        .srcColorBlendFactor = function->source_rgb,
        .dstColorBlendFactor = function->target_rgb,
        .colorBlendOp = function->op,
        .srcAlphaBlendFactor = function->source_alpha,
        .dstAlphaBlendFactor = function->target_alpha,
        .alphaBlendOp = function->op,
        .colorWriteMask = target->no_write
                              ? 0u
                              : VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                    VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT,
    };
}

VkFormat vulkan_vertex_format(const fm_vertex_attribute *attribute)
{
    return attribute->is_vec3 ? VK_FORMAT_R32G32B32_SFLOAT : element_format[attribute->element];
}
