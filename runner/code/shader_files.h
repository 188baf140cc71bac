/* Where the GLSL of a pass lies: the one rule, for the check of a plugin and for its shaders. */
#ifndef FM_SHADER_FILES_H
#define FM_SHADER_FILES_H

#include "base/error.h"
#include "base/path.h"
#include "code.h"

/* Folders that shader files come from; borrowed. */
typedef struct fm_shader_folders {
    const char *method;  /* the plugin's folder */
    const char *common;  /* the runner's GLSL, beside which the methods lie that come with it; NULL
                            or "": not known */
    fm_code *code;       /* each file that is read is noted here; NULL: nobody asks */
    fm_code_owner owner; /* whose `method` is */
} fm_shader_folders;

/* The path of a file as a descriptor or an #include names it:
 *   "x.glsl"         beside the plugin
 *   "common/x.glsl"  the runner's
 *   "other/x.glsl"   another method's: beside the plugin's folder or, if no such file can be read
 *                    there, of the methods that come with the runner
 * Whether the file is there is for the caller to see. FM_INVALID: the path is too long. */
fm_status shader_file_find(char path[FM_PATH_MAX_BYTES], const fm_shader_folders *folders,
                           const char *file, fm_error *err);

#endif
