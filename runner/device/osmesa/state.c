#include "context.h"

/* FM_COMPARE_OFF is GL_ALWAYS for a depth that is written without a test. */
static const GLenum compare_function[] = {
    [FM_COMPARE_OFF] = GL_ALWAYS,         [FM_COMPARE_NEVER] = GL_NEVER,
    [FM_COMPARE_LESS] = GL_LESS,          [FM_COMPARE_EQUAL] = GL_EQUAL,
    [FM_COMPARE_LESS_EQUAL] = GL_LEQUAL,  [FM_COMPARE_GREATER] = GL_GREATER,
    [FM_COMPARE_NOT_EQUAL] = GL_NOTEQUAL, [FM_COMPARE_GREATER_EQUAL] = GL_GEQUAL,
    [FM_COMPARE_ALWAYS] = GL_ALWAYS,
};
_Static_assert(sizeof compare_function / sizeof compare_function[0] == FM_COMPARE_COUNT, "each");

static const GLenum stencil_operation[] = {
    [FM_STENCIL_KEEP] = GL_KEEP,
    [FM_STENCIL_ZERO] = GL_ZERO,
    [FM_STENCIL_REPLACE] = GL_REPLACE,
    [FM_STENCIL_INCREMENT] = GL_INCR,
    [FM_STENCIL_DECREMENT] = GL_DECR,
    [FM_STENCIL_INVERT] = GL_INVERT,
    [FM_STENCIL_INCREMENT_WRAP] = GL_INCR_WRAP,
    [FM_STENCIL_DECREMENT_WRAP] = GL_DECR_WRAP,
};
_Static_assert(sizeof stencil_operation / sizeof stencil_operation[0] == FM_STENCIL_OP_COUNT,
               "each");

static const struct {
    GLenum equation, source_rgb, target_rgb, source_alpha, target_alpha;
} blend_function[] = {
    [FM_BLEND_OFF] = { GL_FUNC_ADD, GL_ONE, GL_ZERO, GL_ONE, GL_ZERO },
    [FM_BLEND_ADD] = { GL_FUNC_ADD, GL_ONE, GL_ONE, GL_ONE, GL_ONE },
    [FM_BLEND_MAX] = { GL_MAX, GL_ONE, GL_ONE, GL_ONE, GL_ONE },
    [FM_BLEND_MIN] = { GL_MIN, GL_ONE, GL_ONE, GL_ONE, GL_ONE },
    [FM_BLEND_OVER] = { GL_FUNC_ADD, GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE,
                        GL_ONE_MINUS_SRC_ALPHA },
    [FM_BLEND_UNDER] = { GL_FUNC_ADD, GL_DST_ALPHA, GL_ONE, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA },
    [FM_BLEND_PRODUCT] = { GL_FUNC_ADD, GL_ZERO, GL_ONE_MINUS_SRC_COLOR, GL_ZERO,
                           GL_ONE_MINUS_SRC_ALPHA },
};
_Static_assert(sizeof blend_function / sizeof blend_function[0] == FM_BLEND_COUNT, "each");

static void apply_depth(const fm_gl *gl, const fm_state *state)
{
    if (state->depth_test == FM_COMPARE_OFF && !state->depth_write) {
        gl->Disable(GL_DEPTH_TEST);
        return;
    }
    gl->Enable(GL_DEPTH_TEST); /* OpenGL writes no depth without it */
    gl->DepthFunc(compare_function[state->depth_test]);
    gl->DepthMask(state->depth_write);
}

static void apply_stencil(const fm_gl *gl, const fm_state *state, uint32_t iteration)
{
    const uint32_t reference = state->stencil_reference + state->stencil_reference_step * iteration;
    if (state->stencil_test == FM_COMPARE_OFF) {
        gl->Disable(GL_STENCIL_TEST);
        return;
    }
    gl->Enable(GL_STENCIL_TEST);
    gl->StencilFunc(compare_function[state->stencil_test], (GLint)(reference & 0xFFu), 0xFFu);
    gl->StencilOp(stencil_operation[state->stencil_fail],
                  stencil_operation[state->stencil_depth_fail],
                  stencil_operation[state->stencil_pass]);
}

static void apply_samples(const fm_gl *gl, const fm_state *state, uint32_t iteration)
{
    const uint64_t shift = (uint64_t)state->sample_mask_step * iteration;
    if (state->sample_mask == 0) {
        gl->Disable(GL_SAMPLE_MASK);
        return;
    }
    gl->Enable(GL_SAMPLE_MASK);
    gl->SampleMaski(0, shift < 32 ? state->sample_mask << shift : 0);
}

static void apply_target(const fm_gl *gl, GLuint index, const fm_target_desc *target)
{
    const GLboolean is_written = !target->no_write;
    gl->ColorMaski(index, is_written, is_written, is_written, is_written);
    if (target->blend == FM_BLEND_OFF) {
        gl->Disablei(GL_BLEND, index);
        return;
    }
    gl->Enablei(GL_BLEND, index);
    gl->BlendEquationi(index, blend_function[target->blend].equation);
    gl->BlendFuncSeparatei(
        index, blend_function[target->blend].source_rgb, blend_function[target->blend].target_rgb,
        blend_function[target->blend].source_alpha, blend_function[target->blend].target_alpha);
}

void osmesa_state_apply(const fm_gl *gl, const fm_pipeline *pipeline)
{
    apply_depth(gl, &pipeline->state);
    apply_stencil(gl, &pipeline->state, pipeline->iteration);
    apply_samples(gl, &pipeline->state, pipeline->iteration);
    for (uint32_t i = 0; i < pipeline->target_count; i++)
        apply_target(gl, i, &pipeline->targets[i]);
}

void osmesa_state_allow_clears(const fm_gl *gl)
{
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->DepthMask(GL_TRUE);
    gl->StencilMask(0xFFu);
}
