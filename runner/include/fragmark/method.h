/* clang-format off: code and lists keep their lines */
/* The plugin interface: a method as data. This file, with resource.h and pass.h, is the manual.
 *
 * A plugin is a shared object that exports one symbol,
 *
 *     const fm_method_desc fm_method = {
 *         .abi = FM_ABI, .size_bytes = sizeof(fm_method_desc), ...
 *     };
 *
 * and lies in a folder of the method's name, beside the GLSL file of each pass:
 * kplus-array/kplus-array.so, kplus-array/store.glsl, ... A process of its own, with limits, loads
 * the plugin to learn what it is, and the whole descriptor is checked; to run, it is loaded by the
 * process that measures. The runner generates every GLSL declaration and every main(), allocates
 * every resource, derives every barrier, and measures every pass.
 *
 *   method.h     what the method is, its options, its hook, and the descriptor itself
 *   resource.h   buffers, images, and numbers read back
 *   pass.h       what a shader is and sees; passes, fixed-function state, loops
 *   technique.h  methods of the simulated tile-based GPU; to be included beside this file
 *
 * In all structs zero means "the default" or "none". Strings are borrowed and live as long as the
 * plugin; the runner writes to none. Lists end at the first entry whose name is NULL, or at their
 * limit. A mistake is refused with a message that names plugin, pass or resource, and field. So is
 * a field that says "not yet": it is there so that the ABI need not change once the runner can do
 * it. */
/* clang-format on */
#ifndef FRAGMARK_METHOD_H
#define FRAGMARK_METHOD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "pass.h"
#include "resource.h"
#include "status.h"

/* Raised whenever a struct changes; CHANGELOG.md says how. A plugin of another number is refused
 * and has to be built again. */
#define FM_ABI 5u

/* Lengths of the lists in fm_method_desc. */
enum {
    FM_MAX_OPTIONS = 8,       /* options of a method */
    FM_MAX_OPTION_VALUES = 8, /* values of an option */
    FM_MAX_RESOURCES = 16,    /* buffers and images */
    FM_MAX_PASSES = 16,       /* culling by an occupancy map needs four of them free */
    FM_MAX_LOOPS = 4,         /* loops, nested ones counted */
    FM_MAX_TOTALS = 8,        /* numbers read back */
};

/* What is true of a method: any of these bits. Tests and reports hold it to them. */
enum {
    FM_TRAIT_EXACT = 1u << 0,        /* hands over exactly the wanted fragments, in order, always,
                                        but for what it declares to lose */
    FM_TRAIT_BOUNDED = 1u << 1,      /* memory does not depend on the scene's fragments */
    FM_TRAIT_SORTED_INPUT = 1u << 2, /* right only if fragments arrive in depth order */
    FM_TRAIT_SORTS_IN_RESOLVE = 1u << 3, /* resolve sorts the fragments of a pixel */
    FM_TRAIT_LOSES_DEPTH_ONE = 1u << 4,  /* fragments at depth exactly 1.0 are lost */
    FM_TRAIT_LOSES_TIES = 1u << 5,       /* of equal depths only one survives */
    FM_TRAIT_RACY = 1u << 6,             /* concurrent fragments of a pixel may damage each other */
    FM_TRAIT_APPROXIMATE = 1u << 7,      /* published as an approximation; never with _EXACT */
    FM_TRAIT_CONTROL = 1u << 8,          /* not a published method */
    FM_TRAIT_FLOOR = 1u << 9,         /* the control whose store time is the floor of all others */
    FM_TRAIT_EMITS_BACK = 1u << 10,   /* calls fm_emit with negative ranks */
    FM_TRAIT_READS_COLOUR = 1u << 11, /* computes with colours (weighs or blends them) before it
                                         emits; others hand their 32 bits on, whatever they mean */
    FM_TRAIT_EMITS_EITHER = 1u << 12, /* takes its ranks from FM_RANK, and so can hand over from
                                         the front or from the back; never with _EMITS_BACK */
    FM_TRAIT_MULTISAMPLED = 1u << 13, /* keeps fragments as samples of an image: at silhouettes and
                                         on slopes samples have others than the pixel's centre */
    FM_TRAIT_PASSES_LOSE_TIES = 1u << 14, /* of equal depths those are lost that a pass over the
                                             scene has no room for: the next one starts behind */
};
#define FM_TRAITS_ALL ((1u << 15) - 1u) /* all of the above */

/* What a method needs of the device, beside what every device has. If one is missing, the case is
 * not_supported, with the reason. */
enum {
    FM_FEATURE_INT64_ATOMICS = 1u << 0,   /* uint64_t in shaders, and atomics on it in buffers */
    FM_FEATURE_INTERLOCK = 1u << 1,       /* fragment shader interlock */
    FM_FEATURE_STENCIL_EXPORT = 1u << 2,  /* stencil values from fragment shaders */
    FM_FEATURE_BUFFER_ADDRESS = 1u << 3,  /* buffers reached by address, beyond the bound range */
    FM_FEATURE_SUBGROUP_BALLOT = 1u << 4, /* subgroupBallot() and its relatives */
};
#define FM_FEATURES_ALL ((1u << 5) - 1u) /* all of the above */

/* How fragments reach a method. */
enum {
    FM_FEED_RASTER = 1u << 0,           /* triangles, fragment shader */
    FM_FEED_COMPUTE_LAYER = 1u << 1,    /* one invocation a fragment, layer by layer */
    FM_FEED_COMPUTE_PIXEL = 1u << 2,    /* one invocation a pixel, looping over its fragments */
    FM_FEED_COMPUTE_ADJACENT = 1u << 3, /* one invocation a fragment, a pixel's in adjacent lanes */
    FM_FEED_TRIANGLES = 1u << 4,        /* the method rasterises vertex and index buffers itself */
    FM_FEED_FRAMES = 1u << 5,           /* draw-call sequences, simulated GPU only */
};
#define FM_FEEDS_FRAGMENTS 0xFu  /* the four feeds that call store() */
#define FM_FEEDS_ALL       0x3Fu /* all of the above */

/* Which fragments the method is to hand over: what truth compares it with. */
typedef enum fm_keeps {
    FM_KEEPS_K_NEAREST, /* the min(k, all) nearest; k is an axis */
    FM_KEEPS_ALL,       /* every fragment; k is not used */
    FM_KEEPS_NEAREST,   /* the nearest one; k is not used */
    FM_KEEPS_ALL_IN_K,  /* every fragment, approximated in k places; k is an axis */
    FM_KEEPS_COUNT      /* how many there are; none */
} fm_keeps;

/* Colour in charts. */
typedef enum fm_family {
    FM_FAMILY_CONTROL,       /* not a published method */
    FM_FAMILY_Z_BUFFER,      /* fixed function, one value a pixel */
    FM_FAMILY_PEELING,       /* one layer, or two, a pass over the scene */
    FM_FAMILY_K_BUFFER,      /* fixed arrays of k, as KB, KB-SR, KB-MDT */
    FM_FAMILY_K_PLUS_BUFFER, /* k+-buffer */
    FM_FAMILY_A_BUFFER,      /* all fragments, in arrays */
    FM_FAMILY_LINKED_LIST,   /* fragments in lists */
    FM_FAMILY_RASTERISER,    /* methods that rasterise by themselves */
    FM_FAMILY_COUNT          /* how many there are; none */
} fm_family;

/* Marker in charts: methods of one family differ in it. */
typedef enum fm_marker {
    FM_MARKER_CIRCLE,  /* a disc */
    FM_MARKER_SQUARE,  /* an upright square */
    FM_MARKER_DIAMOND, /* a square on its corner */
    FM_MARKER_PLUS,    /* an upright cross */
    FM_MARKER_CROSS,   /* a diagonal cross */
    FM_MARKER_COUNT    /* how many there are; none */
} fm_marker;

/* A choice that the user may force with -a NAME=VALUE. A shader sees NAME (upper case, '-' as '_')
 * as the index of the chosen value, and NAME_VALUE as the index of each value. If all values are
 * whole numbers, NAME is the number itself. Its value, chosen or not, is part of a case's id and
 * stands in the column `options`.
 * The value `auto` of an option `layout`, `node` or `per_pixel` is the runner's: it means the
 * fastest of the others on the device, and never an image that the device lacks. Of a layout, where
 * arrays of a pixel's fragments lie, these are `image`, `tile`, `layer` and `pixel`, as many as the
 * method has; of a list's node `split` (three words) and `whole` (16 bytes at once); of the words
 * that each pixel has `rows`, `tiles` and `images`. Cases, ids and shaders have what it means. So
 * it is with `published` of a layout, which no method need list: `image`, or `layer` where the
 * device lacks the image. */
typedef struct fm_option {
    const char *name; /* lower-case letters, digits, '-' and '_'; no key of the runner */
    const char *values[FM_MAX_OPTION_VALUES]; /* the first is the default; letters as in a name, or
                                                 numbers. A fraction has a macro as a word has one,
                                                 with '_' for its point */
    const char *help;                         /* one line of UTF-8 for `list methods` */
} fm_option;

/* What is known when a frame starts, for the hook. Everything is the runner's and lives until the
 * hook returns. */
typedef struct fm_workload {
    uint32_t width_px, height_px; /* of the viewport */
    uint32_t k;                   /* as the method uses it; 0 if it has no k */
    uint32_t n;                   /* the most fragments of any pixel */
    uint64_t triangles;           /* of the scene, of all its instances */
    uint64_t fragments;           /* F: all that reach the method */
    uint64_t fragments_kept;      /* F_k: the sum of min(fragments, k) over all pixels */
    const uint64_t *totals;       /* in the order of the descriptor; 0 until read */
    const char *(*option)(const struct fm_workload *, const char *name); /* the chosen value; NULL:
                                                                            no such option */
    const void *runner;                                                  /* the runner's own */
} fm_workload;

/* What the hook answers. */
typedef enum fm_next {
    FM_NEXT,   /* go on with the next pass */
    FM_REPEAT, /* run the innermost loop that holds this pass once more; refused where there is
                  none, and after the last iteration that fm_loop.max allows */
    FM_REDO,   /* start the frame again, 8 times at most: then the case is refused */
} fm_next;

/* Defined in technique.h. */
struct fm_technique;

/* A method. */
typedef struct fm_method_desc {
    uint32_t abi;         /* FM_ABI; the first field, so that any version can read it */
    uint32_t size_bytes;  /* sizeof(fm_method_desc) */
    const char *id;       /* lower-case letters, digits and hyphens, under 64 bytes; the name of its
                             folder and of its .so; not "common" */
    const char *title;    /* as the paper writes it, UTF-8: "K+B-Array"; needed, as the next two */
    const char *citation; /* authors, year, title, DOI */
    const char *version;  /* changes whenever results or defaults may; a column of summary.csv */
    uint32_t traits;      /* FM_TRAIT_* */
    uint32_t features;    /* FM_FEATURE_* without which it does not run */
    uint32_t feeds;       /* FM_FEED_*; 0 is FM_FEEDS_FRAGMENTS. FM_FEED_TRIANGLES stands alone, and
                             has no scene passes */
    fm_keeps keeps;       /* which fragments it hands over */
    uint32_t k_max;       /* the largest k; a larger one is not_supported; 0 is no limit */
    fm_family family;     /* its colour in charts */
    fm_marker marker;     /* its marker in charts */
    bool dashed;          /* its line in charts */

    fm_option options[FM_MAX_OPTIONS];       /* what users may choose */
    fm_resource resources[FM_MAX_RESOURCES]; /* what it allocates */
    fm_total totals[FM_MAX_TOTALS];          /* what is read back */
    fm_pass passes[FM_MAX_PASSES];           /* a frame, in order; at least one */
    fm_loop loops[FM_MAX_LOOPS];             /* which passes run again */

    /* The one hook, for what data cannot say; NULL: FM_NEXT. Called after each host pass, in the
     * process that measures, by one thread; `pass` is its name. It keeps no state, and what it is
     * handed is a copy: a hook that writes to it, or answers anything else, is a plugin_error. */
    fm_next (*after)(const fm_workload *, const char *pass);

    /* FM_KEEPS_K_NEAREST only: the total that is the frame's k, where the method chooses it, from 1
     * to the axis k. Truth wants so many, and samples.csv tells them as k_chosen. NULL: k itself.
     */
    const char *k_total;

    /* Methods of the simulated tile-based GPU have this in place of resources, totals, passes,
     * loops and the hook, and FM_FEED_FRAMES for their only feed (fragmark/technique.h). */
    const struct fm_technique *technique;

    uint32_t features_optional; /* FM_FEATURE_* that shaders use where the device has them:
                                   FM_HAS_x tells them */

    bool needs_interlock; /* not yet, refused where it is set: the method is right under an
                             interlock only, and with lock=spin it is not_supported */
} fm_method_desc;

/* The one symbol of a plugin: constant data, found by dlsym(). Compile plugins with hidden
 * visibility. */
#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
extern const fm_method_desc fm_method;

#endif
