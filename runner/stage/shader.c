#include "shader.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INCLUDE_DEPTH_MAX = 8, SHADER_FILE_MAX_BYTES = 1 << 20 };

static const char *const element_type[] = {
    [FM_ELEMENT_UINT] = "uint",       [FM_ELEMENT_UVEC2] = "uvec2", [FM_ELEMENT_UVEC4] = "uvec4",
    [FM_ELEMENT_FLOAT] = "float",     [FM_ELEMENT_VEC2] = "vec2",   [FM_ELEMENT_VEC4] = "vec4",
    [FM_ELEMENT_UINT64] = "uint64_t",
};
_Static_assert(sizeof element_type / sizeof element_type[0] == FM_ELEMENT_COUNT, "one each");

/* How GLSL names an image format. */
static const struct format_words {
    const char *target, *vector, *prefix, *qualifier;
} format_words[] = {
    [FM_FORMAT_NONE] = { "float", "vec4", "", "" },
    [FM_FORMAT_R32UI] = { "uint", "uvec4", "u", "r32ui" },
    [FM_FORMAT_RG32UI] = { "uvec2", "uvec4", "u", "rg32ui" },
    [FM_FORMAT_RGBA32UI] = { "uvec4", "uvec4", "u", "rgba32ui" },
    [FM_FORMAT_R32F] = { "float", "vec4", "", "r32f" },
    [FM_FORMAT_RG32F] = { "vec2", "vec4", "", "rg32f" },
    [FM_FORMAT_RGBA32F] = { "vec4", "vec4", "", "rgba32f" },
    [FM_FORMAT_RGBA8] = { "vec4", "vec4", "", "rgba8" },
    [FM_FORMAT_D32F] = { "float", "vec4", "", "" },
    [FM_FORMAT_D32F_S8] = { "float", "vec4", "", "" },
    [FM_FORMAT_R8] = { "float", "vec4", "", "r8" },
    [FM_FORMAT_R16] = { "float", "vec4", "", "r16" },
    [FM_FORMAT_RG16] = { "vec2", "vec4", "", "rg16" },
    [FM_FORMAT_RGBA16] = { "vec4", "vec4", "", "rgba16" },
    [FM_FORMAT_R16F] = { "float", "vec4", "", "r16f" },
    [FM_FORMAT_RG16F] = { "vec2", "vec4", "", "rg16f" },
    [FM_FORMAT_RGBA16F] = { "vec4", "vec4", "", "rgba16f" },
};
_Static_assert(sizeof format_words / sizeof format_words[0] == FM_FORMAT_COUNT, "one each");

const char *shader_element_type(fm_element element)
{
    return element_type[element];
}

const char *shader_target_type(fm_format format)
{
    return format_words[format].target;
}

void shader_define(fm_text *text, const char *name, uint64_t value)
{
    text_add(text, "#define %s %" PRIu64 "%s\n", name, value, value > INT32_MAX ? "u" : "");
}

/* What GLSL calls the FM_FEATURE_* bits. */
static const struct feature_words {
    uint32_t feature;
    const char *extension;
} feature_words[] = {
    { FM_FEATURE_INT64_ATOMICS, "GL_EXT_shader_explicit_arithmetic_types_int64" },
    { FM_FEATURE_INT64_ATOMICS, "GL_EXT_shader_atomic_int64" },
    { FM_FEATURE_INTERLOCK, "GL_ARB_fragment_shader_interlock" },
    { FM_FEATURE_STENCIL_EXPORT, "GL_ARB_shader_stencil_export" },
    { FM_FEATURE_BUFFER_ADDRESS, "GL_EXT_buffer_reference" },
    { FM_FEATURE_SUBGROUP_BALLOT, "GL_KHR_shader_subgroup_basic" },
    { FM_FEATURE_SUBGROUP_BALLOT, "GL_KHR_shader_subgroup_ballot" },
};

static const struct feature_define {
    uint32_t feature;
    const char *name;
} feature_defines[] = {
    { FM_FEATURE_INT64_ATOMICS, "FM_HAS_INT64_ATOMICS" },
    { FM_FEATURE_INTERLOCK, "FM_HAS_INTERLOCK" },
    { FM_FEATURE_STENCIL_EXPORT, "FM_HAS_STENCIL_EXPORT" },
    { FM_FEATURE_BUFFER_ADDRESS, "FM_HAS_BUFFER_ADDRESS" },
    { FM_FEATURE_SUBGROUP_BALLOT, "FM_HAS_SUBGROUP_BALLOT" },
};

void shader_define_features(fm_text *text, uint32_t wanted, uint32_t there)
{
    for (size_t i = 0; i < sizeof feature_defines / sizeof feature_defines[0]; i++)
        if ((wanted & feature_defines[i].feature) != 0)
            shader_define(text, feature_defines[i].name, (there & feature_defines[i].feature) != 0);
}

void shader_begin(fm_text *text, const fm_device_caps *caps, uint32_t features)
{
    text_add(text, "#version 450\n");
    for (size_t i = 0; i < sizeof feature_words / sizeof feature_words[0]; i++)
        if ((features & feature_words[i].feature) != 0)
            text_add(text, "#extension %s : require\n", feature_words[i].extension);
    text_add(text,
             "#ifdef VULKAN\n"
             "#extension GL_EXT_control_flow_attributes : require\n"
             "#define FM_LOOP [[dont_unroll]]\n" /* compile time falls, run time does not rise */
             "#define FM_VERTEX_ID gl_VertexIndex\n"
             "#define FM_INSTANCE_ID gl_InstanceIndex\n"
             "#else\n"
             "#define FM_LOOP\n"
             "#define FM_VERTEX_ID gl_VertexID\n"
             "#define FM_INSTANCE_ID gl_InstanceID\n"
             "#endif\n");
    shader_define(text, "FM_HELPER_GUARD", caps->needs_helper_guard);
    shader_define(text, "FM_LOCK_BARRIERS", caps->needs_lock_barriers);
}

static const char *qualifier(const fm_use *use)
{
    if ((use->access & FM_ACCESS_WRITE) == 0)
        return "readonly ";
    return use->is_coherent ? "coherent " : "";
}

static void declare_buffer(fm_text *text, const fm_use *use)
{
    const fm_slot *slot = use->slot;
    if (slot->by_address)
        text_add(text, "#define %s fm_pointer_%s.items\n", slot->name, slot->name);
    else
        text_add(text, "layout(std430, binding = %u) %sbuffer fm_block_%s { %s %s[]; };\n",
                 use->binding, qualifier(use), slot->name, slot->type, slot->name);
}

static void declare_sampled(fm_text *text, const fm_use *use)
{
    const fm_slot *slot = use->slot;
    const struct format_words *words = &format_words[slot->format];
    const bool is_array = slot->is_array, is_multisampled = slot->samples > 1;
    text_add(text, "layout(binding = %u) uniform %ssampler2D%s%s fm_image_%s;\n", use->binding,
             words->prefix, is_multisampled ? "MS" : "", is_array ? "Array" : "", slot->name);
    text_add(text, "%s fm_load_%s(uvec2 pixel%s%s) { return texelFetch(fm_image_%s, %s, %s); }\n",
             words->vector, slot->name, is_array ? ", uint layer" : "",
             is_multisampled ? ", int samp" : "", slot->name,
             is_array ? "ivec3(pixel, layer)" : "ivec2(pixel)", is_multisampled ? "samp" : "0");
}

static void declare_storage_image(fm_text *text, const fm_use *use)
{
    const fm_slot *slot = use->slot;
    const struct format_words *words = &format_words[slot->format];
    const bool is_array = slot->is_array;
    const char *at = is_array ? "ivec3(pixel, layer)" : "ivec2(pixel)";
    const char *extra = is_array ? ", uint layer" : "";
    text_add(text, "layout(binding = %u, %s) uniform %s%simage2D%s fm_image_%s;\n", use->binding,
             words->qualifier, use->is_coherent ? "coherent " : "", words->prefix,
             is_array ? "Array" : "", slot->name);
    text_add(text, "%s fm_load_%s(uvec2 pixel%s) { return imageLoad(fm_image_%s, %s); }\n",
             words->vector, slot->name, extra, slot->name, at);
    text_add(text,
             "void fm_store_%s(uvec2 pixel%s, %s value) { imageStore(fm_image_%s, %s, value); }\n",
             slot->name, extra, words->vector, slot->name, at);
}

/* Lines of the table that the pass needs, in order: std140 wants rising offsets. */
static void declare_table(fm_text *text, const fm_use *uses, size_t count, const char *part)
{
    fm_text lines = { 0 };
    for (uint32_t line = 0; line < SHADER_TABLE_LINES; line++) {
        for (size_t i = 0; i < count; i++) {
            const fm_slot *slot = uses[i].slot;
            if (slot->format != FM_FORMAT_NONE || !slot->in_table || slot->table_index != line)
                continue;
            if (slot->by_address)
                text_add(&lines, "    layout(offset = %u) fm_reference_%s fm_pointer_%s;\n",
                         line * SHADER_TABLE_STRIDE, slot->name, slot->name);
            text_add(&lines, "    layout(offset = %u) uint fm_length_%s;\n",
                     line * SHADER_TABLE_STRIDE + 8u, slot->name);
        }
    }
    if (lines.length > 0)
        text_add(text, "layout(std140, binding = %d) uniform fm_table_%s {\n%s};\n",
                 SHADER_BINDING_TABLE, part, lines.bytes);
    text_free(&lines);
}

/* FM_WRITES_NAME: shaders may store into it. */
static void define_written(fm_text *text, const fm_slot *slot)
{
    text_add(text, "#define FM_WRITES_");
    for (const char *at = slot->name; *at != '\0'; at++)
        text_add(text, "%c", toupper((unsigned char)*at));
    text_add(text, " 1\n");
}

void shader_declare(fm_text *text, const fm_use *uses, size_t count, const char *part)
{
    text_add(
        text,
        "layout(std140, binding = %d) uniform fm_params_block {\n"
        "    uint fm_iteration, fm_band_first, fm_band_pixels, fm_units, fm_two, fm_run;\n};\n",
        SHADER_BINDING_PARAMS);
    for (size_t i = 0; i < count; i++)
        if (uses[i].slot->by_address)
            text_add(text,
                     "layout(buffer_reference, std430, buffer_reference_align = 16) %sbuffer "
                     "fm_reference_%s { %s items[]; };\n",
                     qualifier(&uses[i]), uses[i].slot->name, uses[i].slot->type);
    declare_table(text, uses, count, part);
    for (size_t i = 0; i < count; i++) {
        if ((uses[i].access & FM_ACCESS_WRITE) != 0)
            define_written(text, uses[i].slot);
        if (uses[i].slot->format == FM_FORMAT_NONE)
            declare_buffer(text, &uses[i]);
        else if ((uses[i].access & FM_ACCESS_WRITE) != 0)
            declare_storage_image(text, &uses[i]);
        else
            declare_sampled(text, &uses[i]);
    }
}

/* The file named in a line `#include "file"`, or false. Blanks of sscanf would take empty lines and
 * then find the next line's include. */
static bool include_of(char file[128], const char *line)
{
    return sscanf(line + strspn(line, " \t"), "#include%*[ \t] \"%127[^\"]\"", file) == 1;
}

/* The runner's files are the same ones from whatever folder they are seen. */
static fm_code_owner owner_of(const fm_shader_folders *folders, const char *file)
{
    return strncmp(file, "common/", 7) == 0 ? FM_CODE_OF_METHOD : folders->owner;
}

static fm_status add_file(fm_text *text, const fm_shader_folders *folders, const char *file,
                          int depth, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], included[128];
    char *bytes = NULL;
    size_t count = 0;
    if (depth > INCLUDE_DEPTH_MAX)
        return fm_fail(err, FM_INVALID, "%s: includes nest deeper than %d", file,
                       INCLUDE_DEPTH_MAX);
    if (strstr(file, "..") != NULL || file[0] == '/')
        return fm_fail(err, FM_INVALID, "%s: shader files are named by METHOD/FILE or FILE", file);
    fm_status status = shader_file_find(path, folders, file, err);
    if (status == FM_OK)
        status = text_read_file(&bytes, &count, path, SHADER_FILE_MAX_BYTES, err);
    if (status != FM_OK) {
        if (err != NULL)
            err->is_own = strncmp(file, "common/", 7) == 0;
        return status;
    }
    if (folders->code != NULL)
        code_add(folders->code, owner_of(folders, file), file, code_hash(bytes, count));
    for (char *line = bytes; status == FM_OK && *line != '\0';) {
        char *end = strchr(line, '\n');
        const size_t length = end != NULL ? (size_t)(end - line) + 1 : strlen(line);
        if (include_of(included, line))
            status = add_file(text, folders, included, depth + 1, err);
        else
            text_add_raw(text, line, length);
        line += length;
    }
    text_add(text, "\n");
    free(bytes);
    return status;
}

fm_status shader_add_file(fm_text *text, const fm_shader_folders *folders, const char *file,
                          fm_error *err)
{
    return add_file(text, folders, file, 0, err);
}

void shader_name(char name[SHADER_NAME_BYTES], const char *text)
{
    size_t i = 0;
    for (; text[i] != '\0' && i < SHADER_NAME_BYTES - 1; i++)
        name[i] = isalnum((unsigned char)text[i]) ? text[i] : '_';
    name[i] = '\0';
}
