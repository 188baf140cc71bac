/* layout=auto, node=auto, per_pixel=auto, and layout=published: which of the option's other values
 * that is.
 *
 * Where and in what form a pixel's fragments lie decides much of a method's time, and what is
 * fastest differs between devices. So the value `auto` of some options (fragmark/method.h names
 * them) is worked out before anything is measured: cases, ids, tables and shaders have the value
 * that it means. `published` is any method's layout too: a layered image, as the code of the
 * k+-buffer papers has for arrays of a pixel's fragments, or the i-th of all pixels side by side
 * where the device has no such image. */
#ifndef FM_AUTO_OPTION_H
#define FM_AUTO_OPTION_H

#include "model/descriptor.h"
#include "model/settings.h"

#define AUTO_VALUE "auto"

/* An option whose value `auto` is the runner's. */
typedef struct fm_auto_option {
    const char *name;
    const char *before; /* what its methods had before there was the option, to join their rows with
                           those of now; "": they always had it */
} fm_auto_option;
enum { AUTO_OPTION_COUNT = 3 };
extern const fm_auto_option auto_options[AUTO_OPTION_COUNT];

/* What it hangs on of a device. */
typedef struct fm_auto_device {
    bool is_software;         /* its processors are the host's */
    uint32_t image_layers;    /* most layers of an image */
    uint64_t image_max_bytes; /* largest image */
} fm_auto_device;

/* What it hangs on of a case. */
typedef struct fm_auto_case {
    const fm_method_desc *method;
    uint32_t width_px, height_px, k, n; /* n 0: not known before a device has counted */
    bool needs_buffers; /* culling's map is to lie in the memory of one: no images */
} fm_auto_case;

/* All of the method's options, each with what is given or its first value, `auto` worked out.
 * Returns how many they are. */
size_t auto_choices(fm_choice all[FM_MAX_OPTIONS], const fm_choice *given, size_t given_count,
                    const fm_auto_case *of, const fm_auto_device *device);
/* The case with these settings. */
fm_auto_case auto_case(const fm_method_desc *method, const fm_settings *settings, uint32_t n);
/* Whether this is the published layout of an option, which need not list it. */
bool auto_is_published(const char *option, const char *value);
/* Whether this choice is one that auto_resolve works out. */
bool auto_is_open(const fm_choice *choice);
/* Replaces the value of each open choice among choices[count], which are all of the method's
 * options, by the fastest, or the published one, that the method has and whose images the device
 * has; other choices stay.
 */
void auto_resolve(fm_choice *choices, size_t count, const fm_auto_case *of,
                  const fm_auto_device *device);

#endif
