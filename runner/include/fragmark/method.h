/* The plugin interface: a method as data.
 *
 * A plugin is a shared object that exports one symbol,
 *
 *     const fm_method_desc fm_method = { .abi = FM_ABI, .size_bytes = sizeof(fm_method_desc), ...
 * };
 *
 * and lies in a folder of the method's name, beside the GLSL file of each pass:
 * kplus-array/kplus-array.so, kplus-array/store.glsl, ... The runner checks the whole descriptor
 * once when it opens the plugin, generates every GLSL declaration and every main(), allocates every
 * resource, derives every barrier, and measures every pass.
 *
 * In all structs zero means "the default" or "none". Strings are borrowed and live as long as the
 * plugin. Lists end at the first entry whose name is NULL.
 *
 * What a shader sees (GLSL 4.50, the same text for Vulkan and OpenGL):
 *   buffers       by their names: fragments[i]; fm_length_NAME is how many elements there are now
 *   images        fm_load_NAME(pixel[, layer][, sample]), and fm_store_NAME(pixel, value) where the
 *                 pass lists it in `writes`; a target is fm_target_NAME
 *   parameters    K, N (the most fragments of a pixel), FM_WIDTH, FM_HEIGHT, FM_PIXELS, and a
 *                 #define for each option (see fm_option)
 *   scene pass    defines  void store(uvec2 pixel, float depth, uint colour)
 *                 and, if it is exclusive,  bool wanted(uvec2 pixel, float depth), the cull,
 *                 which is called outside the lock. It saves work only: store() is also right for
 *                 fragments that it would refuse (its answer may be stale; own_cull=off)
 *   pixel pass    (FM_PASS_PIXELS) defines  void NAME(uvec2 pixel), NAME being the pass's name
 *                 with '-' written '_'
 *   other passes  define  void NAME(uint index): a tile, a triangle, or a unit of a total; with
 *                 fm_pass.lanes > 1 fm_lane tells the invocations of a unit apart
 *   triangles     in the feed of that name, passes over tiles, triangles, totals and indirect ones
 *                 see the scene's FM_TRIANGLES triangles in drawing order (common/triangles.glsl:
 *                 fm_triangle, fm_triangle_colour, fm_triangle_lives), and rasterise as truth does
 *                 with #include "common/rasterise.glsl". Between FM_NEAREST and FM_FARTHEST lie the
 *                 depths of corners that no plane cuts off: a hint, to be clamped to
 *   emit          fm_emit(pixel, rank, depth, colour) hands over one fragment: rank counts from the
 *                 front (0, 1, ...) in front-to-back order, or from the back (-1, -2, ...).
 *                 A pass over tiles does so between its own calls of fm_emit_begin(pixel) and
 *                 fm_emit_end(pixel), once for every pixel of the viewport; so does an indirect
 *                 one, for every pixel if it is the first that emits
 *                 fm_blended(pixel, colour), instead, hands over one vec4 (premultiplied) where an
 *                 approximation has a colour and no fragments: the image is then its only error
 *   a fragment    in 8 bytes is fm_pack(depth, colour), a uvec2 whose .x compares as the depth
 *                 does; FM_EMPTY_BITS is farther than any (common/prelude.glsl)
 *   losses        fm_lost(pixel) counts a fragment that found no room
 *   events        fm_culled(), fm_locked() count in the checked build only
 *   loops         fm_iteration is the number of the running iteration, from 0. FM_LOOP before a
 *                 for or while keeps it from being unrolled: pipelines compile in less time
 *   order         fm_fence() between two accesses that others must see in this order
 *   devices       FM_SUBGROUP_SIZE, and FM_NARROW, 1 where that is below 32; FM_HAS_FEATURE, 1 or 0
 *                 for each of features_optional; FM_LOOP_LIMIT iterations of all loops of an
 *                 invocation, 0: any
 * colour is RGBA8, red in the low byte, premultiplied by alpha; depth is in [0,1]. */
#ifndef FRAGMARK_METHOD_H
#define FRAGMARK_METHOD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "status.h"

#define FM_ABI 5u

enum {
    FM_MAX_OPTIONS = 8,
    FM_MAX_OPTION_VALUES = 8,
    FM_MAX_RESOURCES = 16,
    FM_MAX_PASSES = 16,
    FM_MAX_LOOPS = 4,
    FM_MAX_TOTALS = 8,
    FM_MAX_TARGETS = 8,
    FM_MAX_ACCESSES = 16,
    FM_GROUP_LANES = 64, /* invocations of a workgroup, of every compute pass */
    FM_TILE_PX = 8,      /* side of the tiles that FM_PASS_TILES and per_tile count */
};

/* What is true of a method. */
enum {
    FM_TRAIT_EXACT = 1u << 0,        /* hands over exactly the wanted fragments, in order, always */
    FM_TRAIT_BOUNDED = 1u << 1,      /* memory does not depend on the scene's fragments */
    FM_TRAIT_SORTED_INPUT = 1u << 2, /* right only if fragments arrive in depth order */
    FM_TRAIT_SORTS_IN_RESOLVE = 1u << 3,
    FM_TRAIT_LOSES_DEPTH_ONE = 1u << 4, /* a fragment at depth 1.0 is lost */
    FM_TRAIT_LOSES_TIES = 1u << 5,      /* of equal depths only one survives */
    FM_TRAIT_RACY = 1u << 6,            /* concurrent fragments of a pixel may damage each other */
    FM_TRAIT_APPROXIMATE = 1u << 7,     /* published as an approximation */
    FM_TRAIT_CONTROL = 1u << 8,         /* not a published method */
    FM_TRAIT_FLOOR = 1u << 9,         /* the control whose store time is the floor of all others */
    FM_TRAIT_EMITS_BACK = 1u << 10,   /* calls fm_emit with negative ranks */
    FM_TRAIT_READS_COLOUR = 1u << 11, /* computes with colours (weighs or blends them) before it
                                         emits; others hand their 32 bits on, whatever they mean */
};
#define FM_TRAITS_ALL ((1u << 12) - 1u)

/* What a method needs of the device, beside what every device has. */
enum {
    FM_FEATURE_INT64_ATOMICS = 1u << 0,
    FM_FEATURE_INTERLOCK = 1u << 1,
    FM_FEATURE_STENCIL_EXPORT = 1u << 2,
    FM_FEATURE_BUFFER_ADDRESS = 1u << 3,
    FM_FEATURE_SUBGROUP_BALLOT = 1u << 4,
};
#define FM_FEATURES_ALL ((1u << 5) - 1u)

/* How fragments reach a method. */
enum {
    FM_FEED_RASTER = 1u << 0,           /* triangles, fragment shader */
    FM_FEED_COMPUTE_LAYER = 1u << 1,    /* one invocation a fragment, layer by layer */
    FM_FEED_COMPUTE_PIXEL = 1u << 2,    /* one invocation a pixel, looping over its fragments */
    FM_FEED_COMPUTE_ADJACENT = 1u << 3, /* one invocation a fragment, a pixel's in adjacent lanes */
    FM_FEED_TRIANGLES = 1u << 4,        /* the method rasterises vertex and index buffers itself */
    FM_FEED_FRAMES = 1u << 5,           /* draw-call sequences, simulated GPU only */
};
#define FM_FEEDS_FRAGMENTS 0xFu /* the four feeds that call store() */
#define FM_FEEDS_ALL       0x3Fu

/* Which fragments the method is to hand over: what truth compares it with. */
typedef enum fm_keeps {
    FM_KEEPS_K_NEAREST, /* min(k, all) nearest; k is an axis */
    FM_KEEPS_ALL,       /* every fragment; k is not used */
    FM_KEEPS_NEAREST,   /* one; k is not used */
    FM_KEEPS_ALL_IN_K,  /* every fragment, approximated in k places; k is an axis */
    FM_KEEPS_COUNT
} fm_keeps;

/* Colour in charts. */
typedef enum fm_family {
    FM_FAMILY_CONTROL,
    FM_FAMILY_Z_BUFFER,
    FM_FAMILY_PEELING,
    FM_FAMILY_K_BUFFER,      /* fixed arrays of k, as KB, KB-SR, KB-MDT */
    FM_FAMILY_K_PLUS_BUFFER, /* k+-buffer */
    FM_FAMILY_A_BUFFER,
    FM_FAMILY_LINKED_LIST,
    FM_FAMILY_RASTERISER, /* methods that rasterise by themselves */
    FM_FAMILY_COUNT
} fm_family;

/* Marker in charts. */
typedef enum fm_marker {
    FM_MARKER_CIRCLE,
    FM_MARKER_SQUARE,
    FM_MARKER_DIAMOND,
    FM_MARKER_PLUS,
    FM_MARKER_CROSS,
    FM_MARKER_COUNT
} fm_marker;

/* A choice that the user may force with -a NAME=VALUE. The first value is the default.
 * A shader sees NAME (upper case, '-' as '_') as the index of the chosen value, and NAME_VALUE as
 * each value's index; if all values are numbers, NAME is the number itself. */
typedef struct fm_option {
    const char *name;
    const char *values[FM_MAX_OPTION_VALUES];
    const char *help; /* one line */
} fm_option;

/* How many elements, as data: the sum of all terms. A term with a name counts once for each unit of
 * that total or (numeric) option. All terms zero is refused; constant is 2^40 at most, each factor
 * 4096. */
typedef struct fm_extent {
    uint64_t constant;
    uint64_t per_pixel;
    uint64_t per_pixel_k;
    uint64_t per_pixel_n;
    uint64_t per_fragment; /* F, all fragments of the frame; fm_resource.grown only */
    uint64_t per_tile;     /* FM_TILE_PX squares of the viewport, border tiles counted */
    uint64_t per_triangle; /* of the scene, instances counted */
    uint64_t per_total;
    const char *total;
    uint64_t per_option;
    const char *option;
    uint64_t per_pixel_option; /* times the pixels, for each unit of `option` */
    uint32_t k_step;           /* per_pixel_k counts ceil(k / k_step); 0 is 1 */
} fm_extent;

/* How many of a resource's elements hold something in a frame: bytes_used, never more than there
 * are. */
typedef struct fm_used {
    uint64_t per_pixel;
    uint64_t per_fragment; /* F: all fragments of the scene */
    uint64_t per_kept;     /* F_k: min(f, k) summed over pixels */
} fm_used;

typedef enum fm_resource_kind {
    FM_RESOURCE_BUFFER,
    FM_RESOURCE_IMAGE, /* of the viewport's size */
    FM_RESOURCE_KIND_COUNT
} fm_resource_kind;

typedef enum fm_element {
    FM_ELEMENT_UINT,
    FM_ELEMENT_UVEC2,
    FM_ELEMENT_UVEC4,
    FM_ELEMENT_FLOAT,
    FM_ELEMENT_VEC2,
    FM_ELEMENT_VEC4,
    FM_ELEMENT_UINT64, /* needs FM_FEATURE_INT64_ATOMICS */
    FM_ELEMENT_COUNT
} fm_element;

typedef enum fm_format {
    FM_FORMAT_NONE,
    FM_FORMAT_R32UI,
    FM_FORMAT_RG32UI,
    FM_FORMAT_RGBA32UI,
    FM_FORMAT_R32F,
    FM_FORMAT_RG32F,
    FM_FORMAT_RGBA32F,
    FM_FORMAT_RGBA8,
    FM_FORMAT_D32F,
    FM_FORMAT_D32F_S8,
    FM_FORMAT_R8, /* normalised, as Vulkan's UNORM: 0..255 is read as 0..1 */
    FM_FORMAT_R16,
    FM_FORMAT_RG16,
    FM_FORMAT_RGBA16,
    FM_FORMAT_R16F,
    FM_FORMAT_RG16F,
    FM_FORMAT_RGBA16F,
    FM_FORMAT_COUNT
} fm_format;

typedef enum fm_sizing {
    FM_SIZE_FIXED,       /* known before the frame */
    FM_SIZE_AFTER_TOTAL, /* allocated when extent.total has been read back */
    FM_SIZE_GROW,        /* starts at the extent; when the total `overflow` counts what found no
                            room, it grows by that many elements and the frame is done again */
    FM_SIZE_COUNT
} fm_sizing;

typedef struct fm_resource {
    const char *name; /* a GLSL identifier */
    fm_resource_kind kind;

    fm_element element; /* buffers */
    fm_extent extent;   /* buffers, in elements */
    fm_sizing sizing;   /* buffers */
    const char *overflow;
    fm_extent grown;    /* FM_SIZE_GROW: elements that a frame needs in the end. The larger of this
                           and `extent` is booked; all zero is `extent` */
    const char *shares; /* fixed buffers: lies in the memory of this other fixed buffer, which gets
                           the larger of both sizes; what the one holds is gone once a pass writes
                           the other, and a clear pass fills all of it */

    fm_format format;        /* images */
    uint32_t samples;        /* images; 0 is 1 */
    uint32_t samples_per_k;  /* images; added: samples_per_k * k */
    uint32_t layers;         /* images; 0 is 1 */
    uint32_t layers_per_k;   /* images; added: layers_per_k * k */
    float clear_colour[4];   /* images; of integer formats its bits, unless clear_words is set */
    uint32_t clear_words[4]; /* images of integer formats */
    float clear_depth;       /* images */
    uint32_t clear_stencil;  /* images */

    bool ping_pong; /* two copies, swapped after each iteration of a loop: NAME is written,
                       NAME_previous (a name to use in `reads`) is what the last one wrote */
    fm_used used;
    const char *samples_option; /* images; added: the number that this option is */

    /* Not yet: the resource is there only where the option has this value. */
    const char *when_option, *when_value;
} fm_resource;

/* A number that the runner reads back. Exactly one source is set. */
typedef struct fm_total {
    const char *name;
    const char *resource; /* element `index` of this FM_ELEMENT_UINT buffer, after pass `pass` */
    uint64_t index;
    bool sum;         /* instead: the sum of all elements of `resource` */
    const char *pass; /* with no resource: the samples that passed in this scene pass */
    bool late; /* only sizes resources, and who writes those checks fm_length_NAME: a frame does
                  not wait for it once they are there, but is run again if they were too
                  small. The element keeps its value to the frame's end; no loops */
} fm_total;

typedef enum fm_pass_kind {
    FM_PASS_SCENE,     /* all fragments of the scene, through the feed */
    FM_PASS_PIXELS,    /* once for each pixel: compute, or a full-screen triangle when the pass has
                          targets or depth/stencil state, or when full_screen=fragment is forced */
    FM_PASS_TILES,     /* compute, once for each tile of the viewport */
    FM_PASS_TRIANGLES, /* compute, once for each triangle of the scene */
    FM_PASS_TOTAL,     /* compute, once for each unit of the total `count_total` */
    FM_PASS_INDIRECT,  /* compute, workgroup counts from the first 12 bytes of `indirect`; a
                          workgroup has 64 invocations, numbered through */
    FM_PASS_CLEAR,     /* fills the resources in `writes` with clear_word, or images with their
                          clear values */
    FM_PASS_HOST,      /* reads totals back and calls the `after` hook */
    FM_PASS_KIND_COUNT
} fm_pass_kind;

typedef enum fm_compare {
    FM_COMPARE_OFF, /* no test */
    FM_COMPARE_NEVER,
    FM_COMPARE_LESS,
    FM_COMPARE_EQUAL,
    FM_COMPARE_LESS_EQUAL,
    FM_COMPARE_GREATER,
    FM_COMPARE_NOT_EQUAL,
    FM_COMPARE_GREATER_EQUAL,
    FM_COMPARE_ALWAYS,
    FM_COMPARE_COUNT
} fm_compare;

typedef enum fm_stencil_op {
    FM_STENCIL_KEEP,
    FM_STENCIL_ZERO,
    FM_STENCIL_REPLACE,
    FM_STENCIL_INCREMENT, /* saturating */
    FM_STENCIL_DECREMENT, /* saturating */
    FM_STENCIL_INVERT,
    FM_STENCIL_INCREMENT_WRAP,
    FM_STENCIL_DECREMENT_WRAP,
    FM_STENCIL_OP_COUNT
} fm_stencil_op;

typedef enum fm_blend {
    FM_BLEND_OFF,
    FM_BLEND_ADD, /* dst + src */
    FM_BLEND_MAX,
    FM_BLEND_MIN,
    FM_BLEND_OVER,    /* src + dst (1 - src.a), premultiplied */
    FM_BLEND_UNDER,   /* rgb: dst + src dst.a; a: dst.a (1 - src.a): front to back, dst.a from 1 */
    FM_BLEND_PRODUCT, /* dst (1 - src) */
    FM_BLEND_COUNT
} fm_blend;

typedef enum fm_load {
    FM_LOAD_KEEP,
    FM_LOAD_CLEAR, /* to the resource's clear value */
    FM_LOAD_COUNT
} fm_load;

/* What a scene pass draws instead of the scene: a body that holds it, to learn at little cost
 * between which depths a pixel's fragments lie. Its colour is 0. Where the near plane cuts the body
 * its front is missing, and rounding may leave a fragment a few ulp outside. */
typedef enum fm_cover {
    FM_COVER_NONE, /* the scene itself */
    FM_COVER_HULL, /* convex hull of the mesh; of layers the nearest and farthest at each corner */
    FM_COVER_BOX,  /* bounding box */
    FM_COVER_COUNT
} fm_cover;

/* A colour attachment. The shader writes fm_target_NAME. */
typedef struct fm_target {
    const char *resource;
    fm_load load;
    fm_blend blend;
    bool no_write; /* colour mask off */
} fm_target;

/* Fixed-function state. Values that depend on the iteration i of the pass's innermost loop:
 * stencil_reference + stencil_reference_step * i, and sample_mask << (sample_mask_step * i). */
typedef struct fm_state {
    const char *depth_stencil; /* the image that is tested */
    fm_load depth_stencil_load;
    fm_compare depth_test;
    bool depth_write;
    bool early_tests; /* the shader forces tests before itself */
    fm_compare stencil_test;
    fm_stencil_op stencil_fail, stencil_depth_fail, stencil_pass;
    uint32_t stencil_reference, stencil_reference_step;
    uint32_t sample_mask; /* 0 is all samples */
    uint32_t sample_mask_step;
} fm_state;

typedef struct fm_pass {
    const char *name; /* clear, count, reference, store, resolve, or the method's own, which does
                         not begin with cull- */
    fm_pass_kind kind;
    const char *shader;                  /* file beside the plugin, or "OTHER-METHOD/file.glsl" */
    const char *reads[FM_MAX_ACCESSES];  /* resources; barriers follow from these two lists */
    const char *writes[FM_MAX_ACCESSES]; /* resources read and written, or only written */
    fm_target targets[FM_MAX_TARGETS];
    fm_state state;
    bool exclusive; /* store() runs alone at its pixel: spin lock or interlock */
    bool emits; /* FM_PASS_PIXELS, _TILES, _INDIRECT: calls fm_emit; the last such pass completes
                   the image */
    bool flat_tessellation;  /* a scene pass whose fragments do not depend on the tessellation is
                                drawn with t = 1 */
    const char *count_total; /* FM_PASS_TOTAL */
    const char *indirect;    /* FM_PASS_INDIRECT */
    uint32_t clear_word;     /* FM_PASS_CLEAR */
    const char *flat_option; /* flat_tessellation holds only where this option is "flat" */
    fm_cover cover;          /* FM_PASS_SCENE of methods that take the raster feed only */
    uint32_t lanes; /* FM_PASS_TILES, _TRIANGLES, _TOTAL: invocations of each unit, side by side in
                       a workgroup: a power of two; 0 is 1. With FM_GROUP_LANES a unit has a
                       workgroup of its own, and may use shared memory and barriers */
    uint32_t lanes_narrow; /* instead of lanes, where subgroups have fewer than 32; 0: lanes */
    bool narrow_only;      /* left out where subgroups have 32 lanes or more (!FM_NARROW) */

    /* Not yet, each refused where it is set: */
    bool ordered_interlock;  /* exclusive: an interlock lets fragments of a pixel in as they were
                                drawn, so that store() sees them in that order */
    bool targets_after_lock; /* exclusive, with targets: fm_target_NAME is written, and blended,
                                behind the lock, by a function of its own */
    bool writes_sample_mask; /* FM_PASS_SCENE: store() says which samples the fragment covers */
    bool shared_sort;        /* FM_PASS_PIXELS: the runner's key `sort` says how the fragments of a
                                pixel are sorted */
} fm_pass;

/* Passes first..last (by name) run again and again: `count` times (constant + per k + per n + the
 * number that an option is), or until a total is zero, which is read after each iteration; with
 * both, whichever comes first; never more than `max`. Ping-pong resources swap after each
 * iteration. */
typedef struct fm_loop {
    const char *first, *last;
    uint32_t count, count_per_k, count_per_n;
    const char *until_zero;
    uint32_t max; /* 0 is 65536 */
    const char *count_option;
} fm_loop;

/* What is known when a frame starts; what after() is told. */
typedef struct fm_workload {
    uint32_t width_px, height_px;
    uint32_t k; /* as the method uses it */
    uint32_t n; /* most fragments of any pixel */
    uint64_t triangles;
    uint64_t fragments;      /* F */
    uint64_t fragments_kept; /* F_k */
    const uint64_t *totals;  /* in the order of the descriptor; 0 until read */
    const char *(*option)(const struct fm_workload *, const char *name); /* the chosen value */
    const void *runner;                                                  /* the runner's own */
} fm_workload;

typedef enum fm_next {
    FM_NEXT,   /* go on */
    FM_REPEAT, /* run the loop that holds this pass again */
    FM_REDO,   /* start the frame again */
} fm_next;

typedef struct fm_method_desc {
    uint32_t abi;        /* FM_ABI */
    uint32_t size_bytes; /* sizeof(fm_method_desc) */
    const char *id;      /* lower case with hyphens; the folder's name */
    const char *title;   /* as the paper writes it: "K+B-Array" */
    const char *citation;
    const char *version; /* changes whenever results may */
    uint32_t traits;     /* FM_TRAIT_* */
    uint32_t features;   /* FM_FEATURE_* */
    uint32_t feeds;      /* FM_FEED_*; 0 is FM_FEEDS_FRAGMENTS; FM_FEED_TRIANGLES stands alone and
                            has no scene passes */
    fm_keeps keeps;
    uint32_t k_max; /* largest k; 0 is no limit */
    fm_family family;
    fm_marker marker;
    bool dashed; /* line in charts */

    fm_option options[FM_MAX_OPTIONS];
    fm_resource resources[FM_MAX_RESOURCES];
    fm_total totals[FM_MAX_TOTALS];
    fm_pass passes[FM_MAX_PASSES];
    fm_loop loops[FM_MAX_LOOPS];

    /* Hooks, for what data cannot say. */
    fm_next (*after)(const fm_workload *, const char *pass); /* NULL: FM_NEXT */

    /* FM_KEEPS_K_NEAREST only: the total that is the frame's k where the method chooses it, from 1
     * to the axis k. Truth wants that many, samples.csv tells them as k_chosen. NULL: k itself. */
    const char *k_total;

    /* Techniques of the simulated tile-based GPU have this in place of resources, totals, passes,
     * loops and the hooks above, and FM_FEED_FRAMES for their only feed (fragmark/technique.h). */
    const struct fm_technique *technique;

    uint32_t features_optional; /* FM_FEATURE_* that shaders use where the device has them */

    bool needs_interlock; /* not yet, refused where it is set: right under an interlock only, so
                             that lock=spin is not supported */
} fm_method_desc;

/* The one symbol of a plugin. Compile plugins with hidden visibility. */
#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
extern const fm_method_desc fm_method;

#endif
