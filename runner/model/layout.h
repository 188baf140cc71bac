/* layout=auto and layout=published: which of a method's other layouts that is.
 *
 * Where the arrays of a pixel's fragments lie decides much of a method's time, and what is fastest
 * differs between devices. So the value `auto` of an option `layout` (fragmark/method.h) is worked
 * out before anything is measured: cases, ids, tables and shaders have the layout that it means.
 * `published` is any method's too: a layered image, as the code of the k+-buffer papers has for
 * arrays of a pixel's fragments, or the i-th of all pixels side by side where the device has no
 * such image. */
#ifndef FM_LAYOUT_H
#define FM_LAYOUT_H

#include "model/descriptor.h"
#include "model/settings.h"

#define LAYOUT_OPTION    "layout"
#define LAYOUT_AUTO      "auto"
#define LAYOUT_PUBLISHED "published"

/* What it hangs on of a device. */
typedef struct fm_layout_device {
    bool is_software;         /* its processors are the host's */
    uint32_t image_layers;    /* most layers of an image */
    uint64_t image_max_bytes; /* largest image */
} fm_layout_device;

/* What it hangs on of a case. */
typedef struct fm_layout_case {
    const fm_method_desc *method;
    uint32_t width_px, height_px, k, n; /* n 0: not known before a device has counted */
    bool needs_buffers; /* culling's map is to lie in the memory of one: no images */
} fm_layout_case;

/* All of the method's options, each with what is given or its first value, the layout worked out.
 * Returns how many they are. */
size_t layout_choices(fm_choice all[FM_MAX_OPTIONS], const fm_choice *given, size_t given_count,
                      const fm_layout_case *of, const fm_layout_device *device);
/* The case with these settings. */
fm_layout_case layout_case(const fm_method_desc *method, const fm_settings *settings, uint32_t n);
/* Whether this is the published layout of an option, which need not list it. */
bool layout_is_published(const char *option, const char *value);
/* Whether this choice is one that layout_resolve works out. */
bool layout_is_open(const fm_choice *choice);
/* Replaces the value of an open choice among choices[count], which are all of the method's options,
 * by the fastest layout, or the published one, that the method has and whose images the device has;
 * other choices stay. */
void layout_resolve(fm_choice *choices, size_t count, const fm_layout_case *of,
                    const fm_layout_device *device);

#endif
