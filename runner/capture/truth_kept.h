/* Truths that another run captured, in the user's cache. */
#ifndef FM_TRUTH_KEPT_H
#define FM_TRUTH_KEPT_H

#include "cache/cache.h"
#include "code/code.h"
#include "device/device.h"
#include "model/settings.h"

/* All that a truth hangs on, beside the program; borrowed. */
typedef struct truth_origin {
    const fm_settings *settings; /* finished, and settings_for_truth: the scene's keys and its
                                    generator's version count, and what is in its mesh file */
    const char *feed;            /* feeds of one rasteriser share a truth */
    const fm_device_caps *caps;
    uint64_t driver;    /* hash of its build */
    const char *common; /* folder of the runner's GLSL, all of which counts */
} truth_origin;

/* glsl: starts as {0}; gets the files of `common`, for whoever notes what a truth was made by. */
cache_key truth_key(fm_code *glsl, const fm_cache *cache, const truth_origin *origin);

#endif
