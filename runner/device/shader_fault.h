/* GLSL that does not compile, as all devices report it, so that the author of a method reads the
 * same message whatever the compiler. For implementations of devices. */
#ifndef FM_DEVICE_SHADER_FAULT_H
#define FM_DEVICE_SHADER_FAULT_H

#include "base/error.h"

/* What a device knows of the fault. All texts are borrowed for the call and end with NUL. */
typedef struct fm_shader_fault {
    const char *pipeline; /* fm_pipeline_desc.name: "kplus-array: store" */
    const char *stage;    /* "compute", "vertex" or "fragment" */
    const char *source;   /* the stage's GLSL as the caller handed it in, from #version on */
    const char *log;      /* the compiler's words, of which the first 1024 bytes are kept */
    unsigned line;        /* of `source`, from 1, that the log speaks of; 0: it names none */
} fm_shader_fault;

/* Fills *err (which may be NULL) and returns FM_SHADER. The message is
 *   PIPELINE: STAGE shader, line LINE: 'that line, without its indentation'
 *   LOG
 * and, where the line is 0, "PIPELINE: STAGE shader: LOG". */
fm_status device_fail_shader(fm_error *err, const fm_shader_fault *fault);

#endif
