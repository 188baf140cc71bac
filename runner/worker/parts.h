/* Where a launch's time goes: the clock of its parts, one of which runs at any time. Part NAME is
 * the metric launch.NAME_ms. */
#ifndef FM_PARTS_H
#define FM_PARTS_H

#include <stddef.h>
#include <stdint.h>

#include "base/clock.h"

typedef enum launch_part {
    PART_START,   /* loading the program, by processor time; plugins, device */
    PART_SCENE,   /* the scene and its truth on the host, and on the device */
    PART_COMPILE, /* GLSL put together and compiled, memory, pipelines; not what a driver compiles
                     at the first frame */
    PART_WARMUP,  /* the method's frames before the timed ones */
    PART_FRAMES,  /* its timed frames */
    PART_FLOOR,   /* the floor's frames, all of them */
    PART_IMAGES,  /* hashes of images, and comparing those that are new */
    PART_CHECK,   /* capturing fragments, and comparing them with truth */
    PART_ERRORS,  /* the checked image's errors */
    PART_END,     /* writing images and what is kept */
    PART_COUNT
} launch_part;

typedef struct launch_parts {
    uint64_t ns[PART_COUNT];
    uint64_t since_ns; /* when the running one was entered */
    launch_part part;
} launch_parts;

/* The process begins, in PART_START. */
static inline void parts_begin(launch_parts *parts)
{
    *parts = (launch_parts){ .since_ns = clock_ns(), .part = PART_START };
    parts->ns[PART_START] = clock_process_ns();
}

/* Returns the part that ran. NULL: nobody asks. */
static inline launch_part parts_enter(launch_parts *parts, launch_part part)
{
    const uint64_t now = clock_ns();
    if (parts == NULL)
        return part;
    const launch_part before = parts->part;
    parts->ns[before] += now - parts->since_ns;
    parts->since_ns = now;
    parts->part = part;
    return before;
}

/* The time of a part so far. */
static inline double part_ms(launch_parts *parts, launch_part part)
{
    parts_enter(parts, parts->part);
    return (double)parts->ns[part] * 1e-6;
}

#endif
