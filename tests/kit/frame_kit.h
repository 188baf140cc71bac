/* Frames of a method that a test writes by hand: a descriptor and the text of each GLSL file. It
 * has a buffer `result`, whose first word the test looks at; it is zero before the first frame.
 * Tests that use it are registered with fm_add_scene_test, and name frame_kit.c beside. */
#ifndef FM_TESTS_FRAME_KIT_H
#define FM_TESTS_FRAME_KIT_H

#include "instance/instance.h"
#include "scene_kit.h"

/* One GLSL file beside the method. */
typedef struct kit_file {
    const char *name, *text;
} kit_file;

/* What runs, and how. Zero is the default. */
typedef struct kit_frames {
    const fm_method_desc *method;
    const kit_file *files;
    size_t file_count;
    const char *scene; /* texts as of kit_scene_open; NULL: 3 x 2 pixels without a fragment */
    fm_buffers buffers;
    int frames;  /* 0 is 1 */
    bool counts; /* accesses */
} kit_frames;

/* What the last frame left. */
typedef struct frames_seen {
    uint32_t result; /* result[0] */
    uint32_t redos;
    uint64_t length; /* elements of the last resource, which is a buffer of words */
    uint32_t last;   /* its last element */
    fm_accesses
        accesses[FM_MAX_RESOURCES]; /* of each resource; with `counts`, where it has_counts */
    bool has_counts;
} frames_seen;

/* Runs the frames; fails as instance_create and instance_frame do. */
fm_status frames_try(frames_seen *seen, fm_device *device, const kit_frames *frames, fm_error *err);
/* result[0] of one frame; a failure fails the test. */
uint32_t frames_run(fm_device *device, const kit_frames *frames);

#endif
