#include "osmesa.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "context.h"

/* llvmpipe ends all loops of an invocation after LP_MAX_TGSI_LOOP_ITERATIONS, without a word. */
enum { LLVMPIPE_LOOP_LIMIT = 65535 };

osmesa *osmesa_current(fm_device *device)
{
    osmesa *self = (osmesa *)device;
    if (OSMesaGetCurrentContext() != self->context) {
        const bool is_current = OSMesaMakeCurrent(self->context, self->window, GL_UNSIGNED_BYTE,
                                                  OSMESA_WINDOW_PX, OSMESA_WINDOW_PX);
        assert(is_current); /* fails for a wrong window only, and open() has tried this one */
        (void)is_current;
    }
    return self;
}

static fm_status list_devices(fm_device_entry *entries, size_t *count, fm_error *err)
{
    (void)err;
    if (*count > 0) {
        snprintf(entries[0].selector, sizeof entries[0].selector, "osmesa");
        snprintf(entries[0].name, sizeof entries[0].name, "OpenGL by OSMesa (Mesa llvmpipe)");
        *count = 1;
    }
    return FM_OK;
}

static GLint get_integer(const fm_gl *gl, GLenum name)
{
    GLint value = 0;
    gl->GetIntegerv(name, &value);
    return value;
}

static uint32_t find_features(const fm_gl *gl)
{
    static const struct {
        const char *extension;
        uint32_t feature;
    } known[] = {
        { "GL_ARB_shader_stencil_export", FM_FEATURE_STENCIL_EXPORT },
        { "GL_ARB_fragment_shader_interlock", FM_FEATURE_INTERLOCK },
        { "GL_KHR_shader_subgroup", FM_FEATURE_SUBGROUP_BALLOT },
    };
    uint32_t features = 0;
    const GLuint count = (GLuint)get_integer(gl, GL_NUM_EXTENSIONS);
    for (GLuint i = 0; i < count; i++) {
        const char *extension = (const char *)gl->GetStringi(GL_EXTENSIONS, i);
        for (size_t j = 0; j < sizeof known / sizeof known[0]; j++) {
            if (strcmp(extension, known[j].extension) == 0)
                features |= known[j].feature;
        }
    }
    return features;
}

/* Sample counts that textures of all formats from first to last can have. */
static uint32_t find_samples(const fm_gl *gl, fm_format first, fm_format last)
{
    uint32_t common = ~0u;
    for (fm_format format = first; format <= last; format++) {
        GLint samples[16] = { 0 };
        uint32_t bits = 1u << 1;
        gl->GetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, osmesa_format_of(format)->internal,
                                GL_SAMPLES, 16, samples);
        for (size_t i = 0; i < 16; i++) {
            if (samples[i] > 0 && samples[i] < 32)
                bits |= 1u << samples[i];
        }
        common &= bits;
    }
    return common;
}

static void find_limits(osmesa_limits *limits, const fm_gl *gl)
{
    *limits = (osmesa_limits){
        .binding_end = {
            [FM_BINDING_UNIFORM] = get_integer(gl, GL_MAX_UNIFORM_BUFFER_BINDINGS),
            [FM_BINDING_STORAGE] = get_integer(gl, GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS),
            [FM_BINDING_SAMPLED] = get_integer(gl, GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS),
            [FM_BINDING_STORAGE_IMAGE] = get_integer(gl, GL_MAX_IMAGE_UNITS),
        },
        .per_stage = {
            [FM_BINDING_UNIFORM] = get_integer(gl, GL_MAX_FRAGMENT_UNIFORM_BLOCKS),
            [FM_BINDING_STORAGE] = get_integer(gl, GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS),
            [FM_BINDING_SAMPLED] = get_integer(gl, GL_MAX_TEXTURE_IMAGE_UNITS),
            [FM_BINDING_STORAGE_IMAGE] = get_integer(gl, GL_MAX_FRAGMENT_IMAGE_UNIFORMS),
        },
        .texture_px = get_integer(gl, GL_MAX_TEXTURE_SIZE),
        .texture_layers = get_integer(gl, GL_MAX_ARRAY_TEXTURE_LAYERS),
        .uniform_bytes = get_integer(gl, GL_MAX_UNIFORM_BLOCK_SIZE),
    };
}

/* llvmpipe runs one invocation in each 32-bit lane of its vectors, and OpenGL has no query for it:
 * "llvmpipe (LLVM 15.0.6, 256 bits)". 0: another renderer. */
static uint32_t find_subgroup_size(const char *renderer)
{
    unsigned bits = 0;
    const char *comma = strrchr(renderer, ',');
    if (comma == NULL || sscanf(comma, ", %u bits", &bits) != 1)
        return 0;
    return bits / 32;
}

static void find_caps(fm_device_caps *caps, const fm_gl *gl)
{
    GLint64 storage_bytes = 0;
    gl->GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &storage_bytes);
    const uint32_t draw_buffers = (uint32_t)get_integer(gl, GL_MAX_DRAW_BUFFERS);
    *caps = (fm_device_caps){
        .features = find_features(gl),
        .is_software = true,
        /* llvmpipe masks helper lanes off before atomics, and its threads share one coherent
         * memory: neither guard nor lock barriers are needed. */
        .needs_helper_guard = false,
        .needs_lock_barriers = false,
        .loop_limit = LLVMPIPE_LOOP_LIMIT,
        .subgroup_size = find_subgroup_size((const char *)gl->GetString(GL_RENDERER)),
        .colour_samples = find_samples(gl, FM_FORMAT_R32UI, FM_FORMAT_RGBA8),
        .depth_samples = find_samples(gl, FM_FORMAT_D32F, FM_FORMAT_D32F_S8),
        .max_targets = draw_buffers < FM_MAX_TARGETS ? draw_buffers : FM_MAX_TARGETS,
        .storage_range_bytes = (uint64_t)storage_bytes,
        .timestamp_ns = 1.0,
    };
    for (GLuint axis = 0; axis < 3; axis++) {
        GLint groups = 0;
        gl->GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, axis, &groups);
        caps->max_groups[axis] = (uint32_t)groups;
    }
    const char *version = (const char *)gl->GetString(GL_VERSION);
    const char *mesa = strstr(version, "Mesa");
    snprintf(caps->name, sizeof caps->name, "%s", (const char *)gl->GetString(GL_RENDERER));
    snprintf(caps->driver, sizeof caps->driver, "%s", mesa != NULL ? mesa : version);
    snprintf(caps->api, sizeof caps->api, "OpenGL %d.%d (core)", get_integer(gl, GL_MAJOR_VERSION),
             get_integer(gl, GL_MINOR_VERSION));
}

static void GLAPIENTRY note_message(GLenum source, GLenum type, GLuint id, GLenum severity,
                                    GLsizei length, const GLchar *message, const void *user)
{
    osmesa *self = NULL;
    (void)source, (void)id, (void)severity, (void)length;
    if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR)
        return;
    memcpy(&self, &user, sizeof self); /* the const is OpenGL's; the object is ours */
    if (self->validation_errors++ == 0)
        snprintf(self->first_validation_error, sizeof self->first_validation_error, "%s", message);
}

/* State that stays for the life of the context. */
static void set_constant_state(osmesa *self, const fm_device_desc *desc)
{
    const fm_gl *gl = &self->gl;
    if (desc->validation) {
        gl->Enable(GL_DEBUG_OUTPUT);
        gl->Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        gl->DebugMessageCallback(note_message, self);
    }
    /* Vulkan's coordinates. Into a framebuffer object, NDC y = -1 is row 0 by itself. */
    gl->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl->ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    /* Without it llvmpipe gives all samples to the first fragment, and stencil routing fails. */
    gl->Enable(GL_MULTISAMPLE);
    gl->Disable(GL_DITHER);
    gl->CreateFramebuffers(1, &self->draw_framebuffer);
    gl->CreateFramebuffers(1, &self->clear_framebuffer);
    gl->CreateQueries(GL_TIMESTAMP, 2, self->timestamps);
    gl->CreateQueries(GL_SAMPLES_PASSED, FM_MAX_QUERIES, self->queries);
}

static void close_device(fm_device *device)
{
    if (device == NULL)
        return;
    osmesa *self = (osmesa *)device;
    if (self->context != NULL) /* its framebuffers and queries go with it */
        OSMesaDestroyContext(self->context);
    free(self);
}

static fm_status open_context(osmesa *self, fm_error *err)
{
    static const int attributes[] = {
        OSMESA_FORMAT,
        OSMESA_RGBA,
        OSMESA_PROFILE,
        OSMESA_CORE_PROFILE,
        OSMESA_CONTEXT_MAJOR_VERSION,
        4,
        OSMESA_CONTEXT_MINOR_VERSION,
        5,
        0,
        0,
    };
    self->context = OSMesaCreateContextAttribs(attributes, NULL);
    if (self->context == NULL)
        return fm_fail(err, FM_UNSUPPORTED,
                       "osmesa: no OpenGL 4.5 core context; install libosmesa6 with llvmpipe");
    if (!OSMesaMakeCurrent(self->context, self->window, GL_UNSIGNED_BYTE, OSMESA_WINDOW_PX,
                           OSMESA_WINDOW_PX))
        return fm_fail(err, FM_UNSUPPORTED, "osmesa: the context cannot be made current");
    return gl_load(&self->gl, err);
}

static fm_status open_device(fm_device **device, const fm_device_desc *desc, fm_error *err)
{
    fm_status status = FM_OK;
    *device = NULL;
    if (desc->selector != NULL && desc->selector[0] != '\0')
        return fm_fail(err, FM_INVALID, "osmesa:%s: there is one such device; write 'osmesa'",
                       desc->selector);
    osmesa *self = calloc(1, sizeof *self);
    if (self == NULL)
        return fm_fail(err, FM_NO_MEMORY, "osmesa: %zu bytes", sizeof *self);
    status = open_context(self, err);
    if (status != FM_OK)
        goto out;
    self->base.ops = &osmesa_device;
    self->no_timers = desc->no_timers;
    find_limits(&self->limits, &self->gl);
    find_caps(&self->base.caps, &self->gl);
    set_constant_state(self, desc);
    *device = &self->base;
    self = NULL;
out:
    close_device(self != NULL ? &self->base : NULL);
    return status;
}

static uint32_t validation_errors(const fm_device *device, const char **first)
{
    const osmesa *self = (const osmesa *)device;
    *first = self->first_validation_error;
    return self->validation_errors;
}

const fm_device_ops osmesa_device = {
    .name = "osmesa",
    .list = list_devices,
    .open = open_device,
    .close = close_device,
    .validation_errors = validation_errors,
    .buffer_create = osmesa_buffer_create,
    .buffer_destroy = osmesa_buffer_destroy,
    .buffer_address = osmesa_buffer_address,
    .buffer_write = osmesa_buffer_write,
    .buffer_read = osmesa_buffer_read,
    .image_create = osmesa_image_create,
    .image_destroy = osmesa_image_destroy,
    .pipeline_create = osmesa_pipeline_create,
    .pipeline_destroy = osmesa_pipeline_destroy,
    .frame_begin = osmesa_frame_begin,
    .frame_end = osmesa_frame_end,
    .timer_begin = osmesa_timer_begin,
    .timer_end = osmesa_timer_end,
    .fill = osmesa_fill,
    .update = osmesa_update,
    .image_clear = osmesa_image_clear,
    .dispatch = osmesa_dispatch,
    .draw = osmesa_draw,
};
