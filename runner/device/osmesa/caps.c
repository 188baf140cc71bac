#include <stdio.h>
#include <string.h>

#include "context.h"
#include "device/library.h"

/* llvmpipe ends all loops of an invocation after LP_MAX_TGSI_LOOP_ITERATIONS, without a word, and
 * no image is larger than LP_MAX_TEXTURE_SIZE, which nothing reports. */
enum { LLVMPIPE_LOOP_LIMIT = 65535, LLVMPIPE_IMAGE_BYTES = 1 << 30 };

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

void osmesa_limits_find(osmesa_limits *limits, const fm_gl *gl)
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

void osmesa_caps_find(fm_device_caps *caps, const fm_gl *gl, const osmesa_library *library)
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
        .image_layers = (uint32_t)get_integer(gl, GL_MAX_ARRAY_TEXTURE_LAYERS),
        .image_max_bytes = LLVMPIPE_IMAGE_BYTES,
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
    library_build(caps->driver_build, sizeof caps->driver_build, (uintptr_t)library->function);
    snprintf(caps->api, sizeof caps->api, "OpenGL %d.%d (core)", get_integer(gl, GL_MAJOR_VERSION),
             get_integer(gl, GL_MINOR_VERSION));
}
