/* GLSL from parts: parameters, declarations of resources, the runner's files, the method's file. */
#ifndef FM_SHADER_H
#define FM_SHADER_H

#include "base/error.h"
#include "base/text.h"
#include "code/shader_files.h"
#include "device/device.h"
#include "model/settings.h"

/* A resource as shaders see it. */
typedef struct fm_slot {
    const char *name; /* GLSL identifier */
    const char *type; /* GLSL type of a buffer's elements */
    uint64_t length;  /* elements */
    fm_buffer *buffer;
    bool by_address;
    uint32_t table_index; /* of its line in the table, for buffers with an address or a length */
    bool in_table;
    fm_image_resource *image;
    fm_format format;
    uint32_t samples, layers;
    bool is_array; /* shaders name a layer */
} fm_slot;

/* A slot in a pass. */
typedef struct fm_use {
    fm_slot *slot;
    uint32_t access; /* FM_ACCESS_* */
    uint32_t binding;
    bool is_coherent; /* other invocations of the pass write what this one reads */
} fm_use;

enum {
    SHADER_BINDING_PARAMS = 0, /* uniform: fm_params */
    SHADER_BINDING_TABLE = 1,  /* uniform: address and length of each resource */
    SHADER_BINDING_FIRST = 2,
    SHADER_TABLE_STRIDE = 16,
    SHADER_TABLE_LINES = 64, /* at most */
    SHADER_NAME_BYTES = 64,
};

/* What std140 block fm_params holds: fm_iteration, fm_band_first, ... in shaders. */
typedef struct fm_params {
    uint32_t iteration;               /* of the pass's innermost loop, from 0 */
    uint32_t band_first, band_pixels; /* the pixels whose fragments a checked frame writes down */
    uint32_t units;                   /* FM_PASS_TOTAL: what its total counts; else 0 */
    uint32_t two;                     /* always 2, which no compiler knows */
    uint32_t run;                     /* of a pass that resumes, from 0 */
    uint32_t unused[2];
} fm_params;
_Static_assert(sizeof(fm_params) == 32, "std140 block fm_params");

/* One line of std140 block fm_table. */
typedef struct fm_table_line {
    uint64_t address;
    uint32_t length, unused;
} fm_table_line;
_Static_assert(sizeof(fm_table_line) == SHADER_TABLE_STRIDE, "std140 block fm_table");

/* #version, the extensions of the features that this shader uses (FM_FEATURE_*, all of which the
 * device has), and what depends on the device alone. */
void shader_begin(fm_text *text, const fm_device_caps *caps, uint32_t features);
void shader_define(fm_text *text, const char *name, uint64_t value);
/* FM_HAS_NAME 1 or 0 for each of the wanted FM_FEATURE_NAME. */
void shader_define_features(fm_text *text, uint32_t wanted, uint32_t there);
/* Parameter block, table block and the declaration of each used resource. part names the shader's
 * stage: OpenGL takes blocks of one name in two stages for one block, which must then be equal. */
void shader_declare(fm_text *text, const fm_use *uses, size_t count, const char *part);
/* Adds a file with its #include "file" lines expanded. "common/x.glsl" is the runner's, "x.glsl"
 * the method's, "other/x.glsl" another method's. FM_IO, FM_INVALID: missing, too large, nested too
 * deep. */
fm_status shader_add_file(fm_text *text, const fm_shader_folders *folders, const char *file,
                          fm_error *err);
/* `text` as a GLSL identifier: what is no letter or digit becomes '_'; cut at 63 bytes. */
void shader_name(char name[SHADER_NAME_BYTES], const char *text);
/* Name of an element type in GLSL. */
const char *shader_element_type(fm_element element);
/* GLSL type of what a fragment shader writes to a target of this format. */
const char *shader_target_type(fm_format format);

#endif
