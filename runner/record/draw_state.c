#include "draw_state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    TEXTURE_UNITS = 4,
    ATTRIBUTE_BYTES = 48, /* a corner's position, colour and coordinates, after transformation */
    VERTEX_BYTES = 48,
    SCALARS = 8,
    SOURCE_MAX_BYTES = 1 << 18,
    SHADERS_MAX = 8,
};

static uint32_t mix_word(uint32_t mixed, uint32_t word)
{
    mixed = (mixed ^ word) * 0x9E3779B1u;
    return mixed ^ mixed >> 15;
}

static uint32_t mix_floats(uint32_t mixed, const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t word;
        memcpy(&word, &values[i], sizeof word);
        mixed = mix_word(mixed, word);
    }
    return mixed;
}

static uint32_t get_name(draw_state *state, GLenum what)
{
    GLint value = 0;
    state->gl.glGetIntegerv(what, &value);
    return (uint32_t)value;
}

static texture_note *note_of(draw_state *state, uint32_t texture)
{
    return &state->textures[texture < RECORD_TEXTURES ? texture : RECORD_TEXTURES - 1];
}

/* ---- textures ---- */

static uint32_t level_size(draw_state *state, GLenum what)
{
    GLint size = 0;
    state->gl.glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, what, &size);
    return size > 0 ? (uint32_t)size : 0;
}

/* Of the texture that is bound. */
static bool find_opacity(draw_state *state)
{
    const size_t count =
        (size_t)level_size(state, GL_TEXTURE_WIDTH) * (size_t)level_size(state, GL_TEXTURE_HEIGHT);
    bool is_opaque = true;
    if (level_size(state, GL_TEXTURE_ALPHA_SIZE) == 0 || count == 0)
        return true;
    unsigned char *alpha = malloc(4 * count); /* rows may be padded to four bytes */
    if (alpha == NULL)
        return false;
    memset(alpha, 255, 4 * count);
    state->gl.glGetTexImage(GL_TEXTURE_2D, 0, GL_ALPHA, GL_UNSIGNED_BYTE, alpha);
    for (size_t i = 0; i < 4 * count && is_opaque; i++)
        is_opaque = alpha[i] == 255;
    free(alpha);
    return is_opaque;
}

static bool bound_is_opaque(draw_state *state)
{
    const uint32_t texture = get_name(state, GL_TEXTURE_BINDING_2D);
    texture_note *note = note_of(state, texture);
    if (texture == 0)
        return true;
    if (note->known_version != note->version + 1) {
        note->is_opaque = find_opacity(state);
        note->known_version = note->version + 1;
    }
    return note->is_opaque;
}

void draw_state_uploaded(draw_state *state, GLenum target)
{
    if (target == GL_TEXTURE_2D)
        note_of(state, get_name(state, GL_TEXTURE_BINDING_2D))->version++;
}

void draw_state_rendered(draw_state *state)
{
    GLint type = 0, name = 0;
    state->gl.glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                                    GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
    if (type != GL_TEXTURE)
        return;
    state->gl.glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                                    GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &name);
    note_of(state, (uint32_t)name)->version++;
}

/* Names, versions and number of the textures that the draw call may read. */
static void read_textures(fm_draw_call *draw, draw_state *state)
{
    const uint32_t active = get_name(state, GL_ACTIVE_TEXTURE);
    uint32_t count = 0;
    for (uint32_t unit = 0; unit < TEXTURE_UNITS; unit++) {
        state->gl.glActiveTexture(GL_TEXTURE0 + unit);
        const uint32_t texture = get_name(state, GL_TEXTURE_BINDING_2D);
        const bool is_read = draw->shader != 0 || state->gl.glIsEnabled(GL_TEXTURE_2D);
        if (texture == 0 || !is_read)
            continue;
        draw->texture = count == 0 ? texture : mix_word(draw->texture, texture);
        draw->texture_version += note_of(state, texture)->version;
        count++;
    }
    state->gl.glActiveTexture(active);
    draw->texture_bytes16 = (uint16_t)(16 * count);
}

/* ---- programs ---- */

static void read_source(program_note *note, draw_state *state, uint32_t shader, char *source)
{
    GLsizei length = 0;
    state->gl.glGetShaderSource(shader, SOURCE_MAX_BYTES - 1, &length, source);
    source[length] = '\0';
    note->discards = note->discards || strstr(source, "discard") != NULL;
    note->writes_depth = note->writes_depth || strstr(source, "gl_FragDepth") != NULL;
}

static program_note read_program(draw_state *state, uint32_t program)
{
    program_note *note =
        &state->programs[program < RECORD_PROGRAMS ? program : RECORD_PROGRAMS - 1];
    GLuint shaders[SHADERS_MAX];
    GLsizei count = 0;
    if (program == 0 || note->is_known)
        return *note;
    char *source = malloc(SOURCE_MAX_BYTES);
    state->gl.glGetAttachedShaders(program, SHADERS_MAX, &count, shaders);
    for (GLsizei i = 0; source != NULL && i < count; i++)
        read_source(note, state, shaders[i], source);
    free(source);
    note->is_known = program < RECORD_PROGRAMS - 1;
    return *note;
}

static uint32_t mix_program_uniforms(draw_state *state, uint32_t program)
{
    GLint count = 0;
    uint32_t mixed = program;
    state->gl.glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; i++) {
        char name[256] = "";
        GLint size = 0;
        GLenum type = 0;
        float values[16] = { 0 };
        state->gl.glGetActiveUniform(program, (GLuint)i, sizeof name, NULL, &size, &type, name);
        const GLint location = state->gl.glGetUniformLocation(program, name);
        if (location >= 0)
            state->gl.glGetUniformfv(program, location, values);
        mixed = mix_floats(mixed, values, 16);
    }
    return mixed;
}

static uint32_t mix_fixed_state(draw_state *state)
{
    GLint mode = 0;
    float colour[4] = { 0 };
    state->gl.glGetTexEnviv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, &mode);
    uint32_t mixed = mix_word(0, (uint32_t)mode);
    if (!state->gl.glIsEnabled(GL_FOG))
        return mixed;
    state->gl.glGetFloatv(GL_FOG_COLOR, colour);
    return mix_floats(mixed, colour, 4);
}

/* ---- the draw call ---- */

static fm_compare read_depth_test(draw_state *state)
{
    if (!state->gl.glIsEnabled(GL_DEPTH_TEST))
        return FM_COMPARE_OFF;
    return (fm_compare)(get_name(state, GL_DEPTH_FUNC) - GL_NEVER + FM_COMPARE_NEVER);
}

static fm_mix read_mix(draw_state *state)
{
    if (!state->gl.glIsEnabled(GL_BLEND))
        return FM_MIX_OFF;
    const uint32_t source = get_name(state, GL_BLEND_SRC_RGB);
    const uint32_t target = get_name(state, GL_BLEND_DST_RGB);
    if (target == GL_ONE)
        return FM_MIX_ADD;
    return source == GL_ONE && target == GL_ZERO ? FM_MIX_OFF : FM_MIX_OVER;
}

static uint32_t read_flags(draw_state *state, uint32_t program)
{
    GLboolean writes_depth = GL_FALSE;
    const program_note shaders = read_program(state, program);
    const bool tests_alpha = program == 0 && state->gl.glIsEnabled(GL_ALPHA_TEST);
    state->gl.glGetBooleanv(GL_DEPTH_WRITEMASK, &writes_depth);
    return (writes_depth ? FM_DRAW_DEPTH_WRITE : 0u) |
           (tests_alpha || shaders.discards ? FM_DRAW_DISCARD : 0u) |
           (shaders.writes_depth ? FM_DRAW_SHADER_DEPTH : 0u) |
           (state->gl.glIsEnabled(GL_STENCIL_TEST) ? FM_DRAW_STENCIL : 0u);
}

fm_draw_call draw_state_read(draw_state *state, uint32_t vertices)
{
    GLboolean mask[4] = { GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE };
    const uint32_t program = get_name(state, GL_CURRENT_PROGRAM);
    fm_draw_call draw = { .flags = read_flags(state, program),
                          .depth_test = read_depth_test(state),
                          .mix = read_mix(state),
                          .alpha = 255,
                          .shader = program,
                          .vertices = vertices,
                          .attribute_bytes = 3 * ATTRIBUTE_BYTES,
                          .scalars = SCALARS,
                          .vertex_bytes = VERTEX_BYTES };
    state->gl.glGetBooleanv(GL_COLOR_WRITEMASK, mask);
    for (unsigned c = 0; c < 4; c++)
        draw.mask |= (uint8_t)((mask[c] ? 1u : 0u) << c);
    draw.uniforms = program != 0 ? mix_program_uniforms(state, program) : mix_fixed_state(state);
    read_textures(&draw, state);
    return draw;
}

void draw_state_alpha(fm_draw_call *draw, draw_state *state, polygon_alpha corners)
{
    const bool is_textured = draw->texture_bytes16 > 0;
    if (draw->mix == FM_MIX_OFF || corners.most < corners.least)
        return;
    const float middle = (corners.least + corners.most) / 2;
    draw->alpha = (uint8_t)lroundf(fminf(fmaxf(middle, 0), 1) * 255);
    if (!is_textured || bound_is_opaque(state))
        return;
    /* Some of its texels are opaque, others are not. */
    if (draw->alpha == 255) {
        draw->flags |= FM_DRAW_TEXTURED_ALPHA;
        draw->alpha = 128;
    }
}

polygon_view draw_state_view(draw_state *state, uint32_t height_px)
{
    GLint box[4] = { 0 };
    polygon_view view = { .height_px = height_px };
    if (get_name(state, GL_TEXTURE_BINDING_2D) != 0) {
        view.texture_width = level_size(state, GL_TEXTURE_WIDTH);
        view.texture_height = level_size(state, GL_TEXTURE_HEIGHT);
    }
    view.has_scissor = state->gl.glIsEnabled(GL_SCISSOR_TEST);
    state->gl.glGetIntegerv(GL_SCISSOR_BOX, box);
    view.left = (float)box[0];
    view.bottom = (float)box[1];
    view.right = (float)(box[0] + box[2]);
    view.top = (float)(box[1] + box[3]);
    return view;
}
