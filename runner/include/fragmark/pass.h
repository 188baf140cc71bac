/* clang-format off: lists keep their lines */
/* The passes of a method, what they draw with, and the loops around them.
 *
 * A plugin includes fragmark/method.h, which includes this file. In all structs zero means "the
 * default" or "none"; strings are the plugin's and live as long as it. What is wrong is refused
 * when the plugin is opened, with pass and field named; a shader that does not compile is refused
 * when it is built, with its line.
 *
 * What a shader is. A pass names a GLSL file that holds functions only (GLSL 4.50, the same text
 * for Vulkan and OpenGL). The runner puts #version, #extension, the parameters and the declarations
 * below before it and main() behind it. It may #include "x.glsl" (beside the plugin),
 * "common/x.glsl" (the runner's) and "METHOD/x.glsl" (another method's).
 *
 *   scene pass    defines  void store(uvec2 pixel, float depth, uint colour), called once for each
 *                 fragment. If the pass is exclusive it also defines
 *                 bool wanted(uvec2 pixel, float depth), the cull, which is called outside the lock
 *                 and only saves work: its answer may be stale, and own_cull=off leaves it out, so
 *                 store() has to be right for fragments that wanted() would refuse
 *   pixel pass    (FM_PASS_PIXELS) defines  void NAME(uvec2 pixel); NAME is the pass's name with
 *                 '-' written as '_'
 *   other passes  define  void NAME(uint index), called with the number of a tile, a triangle or a
 *                 unit of a total, each from 0. If fm_pass.lanes is above 1, several invocations
 *                 share an index, and fm_lane tells them apart
 *   units         pixel: (0, 0) at the upper left. depth: 0 (near) to 1, also where the projection
 *                 is reversed; only attachments have what was rasterised then, and no pass that
 *                 tests it runs. colour: RGBA8, red in the low byte, premultiplied by alpha
 *
 * What a shader sees:
 *   buffers       by their names: fragments[i]. fm_length_NAME is how many elements there are now,
 *                 a uint. Only what stands in `reads` or `writes` is declared. FM_WRITES_NAME, NAME
 *                 in upper case, is 1 where shaders may store into the buffer or image
 *   images        fm_load_NAME(pixel) is the texel, a vec4 or, of integer formats, a uvec4. If the
 *                 pass lists the image in `writes` there is fm_store_NAME(pixel, value) too, and
 *                 fm_image_NAME itself, for imageAtomicAdd and its like on FM_FORMAT_R32UI.
 *                 If the image may have more than one layer, whatever k, n and options are, `uint
 *                 layer` follows `pixel` in both, and fm_image_NAME is an image2DArray, also where
 *                 there is one. If it has more than one sample, fm_load_NAME takes `int sample` as
 *                 its last argument, and shaders cannot store to it
 *   targets       fm_target_NAME, written by a pass that draws: float, vec2 or vec4 by the format's
 *                 channels, or uint, uvec2, uvec4
 *   parameters    K (at least 1), N (the most fragments of a pixel, at least 1), FM_WIDTH,
 *                 FM_HEIGHT and FM_PIXELS of the viewport, and a #define for each option, as
 *                 fm_option says. They are numbers of the preprocessor
 *   a fragment    takes 8 bytes as fm_pack(depth, colour), a uvec2 whose .x compares as the depth
 *                 does; FM_EMPTY_BITS is farther than any depth. fm_pixel_index(pixel) is
 *                 y * FM_WIDTH + x (common/prelude.glsl)
 *   emit          fm_emit(pixel, rank, depth, colour) hands one fragment over. rank counts from the
 *                 front (0, 1, ...), in front-to-back order, or from the back (-1, -2, ...), which
 *                 needs FM_TRAIT_EMITS_BACK. A pass over tiles puts its calls between its own calls
 *                 of fm_emit_begin(pixel) and fm_emit_end(pixel), made once for every pixel of the
 *                 viewport. So does an indirect pass, for every pixel if it is the first that
 *                 emits. FM_RANK(i, count) is the rank of the i-th turn of a loop that has all
 *                 `count` ranks of a pixel: i, or count - 1 - i where the runner's key `composite`
 *                 asks for it. A method that takes its ranks so has FM_TRAIT_EMITS_EITHER.
 *                 fm_blended(pixel, colour) hands over one vec4 (premultiplied) instead, where an
 *                 approximation has a colour and no fragments: its image is then its only error
 *   losses        fm_lost(pixel) counts a fragment that found no room: never lose one in silence
 *   events        fm_culled() and fm_locked() count in the checked build only; so do fm_repaired()
 *                 and fm_unrepaired(), once for a pixel in which the method found damage by racing
 *                 fragments
 *   loops         fm_iteration is the number of the running iteration of the innermost loop, a uint
 *                 from 0. FM_LOOP before a `for` or `while` keeps it from being unrolled, so that
 *                 pipelines compile in less time. FM_LOOP_LIMIT: after so many iterations of all
 *                 loops of an invocation this device ends them all; 0: it never does. The runner
 *                 finds that out behind your function and refuses the case as not_supported; a
 *                 pass may do its work in several runs instead (fm_resumes). A shader that
 *                 counts its loops, and stops before, says so by fm_cut()
 *   locks         an exclusive store() runs alone at its pixel. A spin lock gives up after
 *                 FM_SPIN_MAX tries and counts the fragment as lost. The lock orders accesses to
 *                 the buffers and images in `writes`: what one owner stored the next one loads.
 *                 wanted() runs beside an owner, and may read what is older. Of a pass with a
 *                 lock_word, store() reads and writes the pixel's word by fm_lock_word(pixel) and
 *                 fm_set_lock_word(pixel, value). Where the lock lies in it, whoever took the lock
 *                 has the word already, and frees the lock by storing it: 31 bits, beside one
 *                 that tells that the lock is taken. So whoever tries in vain has the word, too;
 *                 the pass defines bool still_wanted(uint word, float depth), the cull by it
 *   order         fm_fence() between two accesses to buffers or images that others must see in
 *                 this order
 *   devices       FM_SUBGROUP_SIZE; FM_NARROW, 1 where that is below 32; FM_GROUP_LANES; for each
 * of features_optional FM_HAS_x (FM_FEATURE_x), 1 or 0 triangles     in the feed of that name,
 * passes over tiles, triangles, totals and indirect ones see the scene's FM_TRIANGLES triangles in
 * drawing order (common/triangles.glsl: fm_triangle, fm_triangle_colour, fm_triangle_lives), and
 * rasterise as truth does with #include "common/rasterise.glsl". The depths of corners that no
 * plane cuts off lie between FM_NEAREST and FM_FARTHEST: a hint, to be clamped to
 *
 * Not yet; a shader that uses one does not compile: fm_seed, a number that is another one in each
 * frame and the same in each run; FM_NEAR_OVER_FAR, near plane over far plane, 0 where that is not
 * known; the range of depths of the scene's hull in feeds other than triangles (a pass with a cover
 * finds that of each pixel). */
/* clang-format on */
#ifndef FRAGMARK_PASS_H
#define FRAGMARK_PASS_H

#include <stdbool.h>
#include <stdint.h>

/* Limits of one pass. */
enum {
    FM_MAX_TARGETS = 8,   /* colour attachments; a device may have fewer: not_supported */
    FM_MAX_ACCESSES = 16, /* names in `reads`, and in `writes` */
    FM_GROUP_LANES = 64,  /* invocations of a workgroup, of every compute pass */
};

/* What a pass runs for. */
typedef enum fm_pass_kind {
    FM_PASS_SCENE,     /* for each fragment of the scene, through the feed: a draw, or compute */
    FM_PASS_PIXELS,    /* once for each pixel: compute, or a full-screen triangle if the pass has
                          targets or depth and stencil state, or full_screen=fragment is forced */
    FM_PASS_TILES,     /* compute, once for each tile of FM_TILE_PX x FM_TILE_PX pixels */
    FM_PASS_TRIANGLES, /* compute, once for each triangle of the scene */
    FM_PASS_TOTAL,     /* compute, once for each unit of the total `count_total` */
    FM_PASS_INDIRECT,  /* compute; the first 12 bytes of the buffer `indirect` are the workgroups in
                          x, y and z. A workgroup has FM_GROUP_LANES invocations, which are numbered
                          through; fm_lane is the place within it */
    FM_PASS_CLEAR,     /* no shader: fills the buffers in `writes` with clear_word, and the images
                          with their clear values */
    FM_PASS_HOST,      /* no shader: the device finishes and the `after` hook is called, which sees
                          the totals read so far */
    FM_PASS_KIND_COUNT /* how many kinds there are; no kind */
} fm_pass_kind;

/* Depth and stencil tests: the new value compared with the stored one. */
typedef enum fm_compare {
    FM_COMPARE_OFF,           /* no test; nothing is written either */
    FM_COMPARE_NEVER,         /* passes nothing */
    FM_COMPARE_LESS,          /* passes new < stored */
    FM_COMPARE_EQUAL,         /* passes new == stored */
    FM_COMPARE_LESS_EQUAL,    /* passes new <= stored */
    FM_COMPARE_GREATER,       /* passes new > stored */
    FM_COMPARE_NOT_EQUAL,     /* passes new != stored */
    FM_COMPARE_GREATER_EQUAL, /* passes new >= stored */
    FM_COMPARE_ALWAYS,        /* passes everything, so that depth may be written */
    FM_COMPARE_COUNT          /* how many there are; no comparison */
} fm_compare;

/* What becomes of the stored stencil value, of 8 bits. */
typedef enum fm_stencil_op {
    FM_STENCIL_KEEP,           /* it stays */
    FM_STENCIL_ZERO,           /* 0 */
    FM_STENCIL_REPLACE,        /* the reference */
    FM_STENCIL_INCREMENT,      /* one more, 255 at most */
    FM_STENCIL_DECREMENT,      /* one less, 0 at least */
    FM_STENCIL_INVERT,         /* every bit the other way */
    FM_STENCIL_INCREMENT_WRAP, /* one more; 0 after 255 */
    FM_STENCIL_DECREMENT_WRAP, /* one less; 255 after 0 */
    FM_STENCIL_OP_COUNT        /* how many there are; no operation */
} fm_stencil_op;

/* How what a shader writes (src) joins what a target holds (dst), channel by channel. Integer
 * formats do not blend. */
typedef enum fm_blend {
    FM_BLEND_OFF,     /* src */
    FM_BLEND_ADD,     /* dst + src */
    FM_BLEND_MAX,     /* the greater one */
    FM_BLEND_MIN,     /* the lesser one */
    FM_BLEND_OVER,    /* src + dst (1 - src.a): src premultiplied, back to front */
    FM_BLEND_UNDER,   /* rgb: dst + src dst.a; a: dst.a (1 - src.a): front to back, dst.a from 1 */
    FM_BLEND_PRODUCT, /* dst (1 - src) */
    FM_BLEND_COUNT    /* how many there are; no blending */
} fm_blend;

/* What an attachment holds when a pass begins. */
typedef enum fm_load {
    FM_LOAD_KEEP,  /* what it held */
    FM_LOAD_CLEAR, /* its resource's clear value */
    FM_LOAD_COUNT  /* how many there are; no load */
} fm_load;

/* What a scene pass draws instead of the scene: a body that holds it, to learn at little cost
 * between which depths the fragments of a pixel lie. Its colour is 0. Where the near plane cuts the
 * body its front is missing, and rounding may leave a fragment a few ulp outside. */
typedef enum fm_cover {
    FM_COVER_NONE, /* the scene itself */
    FM_COVER_HULL, /* convex hull of the mesh; of layers the nearest and farthest at each corner */
    FM_COVER_BOX,  /* bounding box */
    FM_COVER_COUNT /* how many there are; no cover */
} fm_cover;

/* A colour attachment. The shader writes fm_target_NAME. All attachments of a pass, its depth image
 * among them, have the same number of samples. */
typedef struct fm_target {
    const char *resource; /* an image of a colour format; needed */
    fm_load load;         /* what it holds at first */
    fm_blend blend;       /* how it takes a value */
    bool no_write;        /* the colour mask is off: only load and tests matter */
} fm_target;

/* Fixed-function state of a pass that draws. Two values depend on the iteration i of the pass's
 * innermost loop, which then needs a known count. */
typedef struct fm_state {
    const char *depth_stencil;  /* the image that is tested; needed by any test */
    fm_load depth_stencil_load; /* what it holds at first */
    fm_compare depth_test;      /* of the fragment's depth */
    bool depth_write;           /* a fragment that passes writes its depth; needs depth_test */
    bool early_tests;           /* tests come before the shader, whatever it does */
    fm_compare stencil_test;    /* of the reference; needs FM_FORMAT_D32F_S8 */
    fm_stencil_op stencil_fail; /* the stencil test failed */
    fm_stencil_op stencil_depth_fail; /* it passed, and the depth test failed */
    fm_stencil_op stencil_pass;       /* both passed */
    uint32_t stencil_reference;       /* 0..255 */
    uint32_t stencil_reference_step;  /* i times this is added; the low 8 bits count */
    uint32_t sample_mask;             /* bit s: sample s is written; 0 is all samples */
    uint32_t sample_mask_step;        /* the mask is shifted left by i times this */
} fm_state;

/* By which number the loops of a pass grow so far that a device ends them (FM_LOOP_LIMIT). Where n
 * or k is beyond the bound below, FM_RESUMES is 1 in the pass's shader: it does a part of the work,
 * in FM_RUN_ITERATIONS at most, and calls fm_go_on() if there is more. As long as some invocation
 * does, the pass runs again with fm_run one higher: 0, 1, 2, ... What has to outlive a run lies in
 * buffers and images; those in `reads` may be written, too (of images: of colour, one sample).
 * Elsewhere, so on a device without a limit, FM_RESUMES is 0 and the pass runs once. */
typedef enum fm_resumes {
    FM_RESUMES_NEVER,  /* beyond the limit the case is not_supported */
    FM_RESUMES_BY_N,   /* it sorts n fragments: n above FM_LOOP_LIMIT / 32 */
    FM_RESUMES_BY_K,   /* it sorts k: k above FM_LOOP_LIMIT / 64 */
    FM_RESUMES_BY_N_K, /* it compares each of n with k: n (k + 2) above 3/4 of FM_LOOP_LIMIT, or the
                          bound of k */
    FM_RESUMES_COUNT   /* how many there are; none */
} fm_resumes;

/* One step of a method. Each pass has its own time in samples.csv; `clear`, `count`, `reference`,
 * `store` and `resolve` have columns in summary.csv. Barriers follow from reads, writes and
 * attachments: a plugin says nothing else of order. */
typedef struct fm_pass {
    const char *name;  /* lower-case letters, digits and hyphens, under 64 bytes, not beginning with
                          cull-; its function must be no word of GLSL and no resource's name */
    fm_pass_kind kind; /* a scene pass unless it says otherwise */
    const char *shader; /* "file.glsl" beside the plugin, "common/file.glsl" of the runner, or
                           "METHOD/file.glsl" of another method: beside the plugin's folder or, if
                           there is none, of the methods that come with fragmark */
    const char *reads[FM_MAX_ACCESSES];  /* resources that are only read */
    const char *writes[FM_MAX_ACCESSES]; /* resources that are written, or read and written; images
                                            of a colour format and one sample, but for a clear */
    fm_target targets[FM_MAX_TARGETS];   /* FM_PASS_SCENE, _PIXELS */
    fm_state state;                      /* FM_PASS_SCENE, _PIXELS */
    bool exclusive; /* FM_PASS_SCENE: store() runs alone at its pixel, under a spin lock or an
                       interlock, as the runner's key `lock` says */
    const char *lock_word; /* exclusive: a resource of `writes` with one word a pixel (a buffer of
                              FM_ELEMENT_UINT, or an image of FM_FORMAT_R32UI), in which the spin
                              lock lies, too: see locks above */
    const char *lock_word_option; /* it lies in there only where this option is "lock" */
    bool emits;              /* FM_PASS_PIXELS, _TILES, _INDIRECT: calls fm_emit. The last such pass
                                completes the image. Every method has one, but for a floor */
    bool flat_tessellation;  /* FM_PASS_SCENE: what it does with fragments does not depend on the
                                tessellation, so layers are drawn with t = 1 */
    const char *count_total; /* FM_PASS_TOTAL: the total whose units it runs for */
    const char *indirect;    /* FM_PASS_INDIRECT: a buffer of FM_ELEMENT_UINT */
    uint32_t clear_word;     /* FM_PASS_CLEAR: each word of the buffers */
    const char *flat_option; /* flat_tessellation holds only where this option is "flat" */
    fm_cover cover;          /* FM_PASS_SCENE of methods that take the raster feed only */
    uint32_t lanes; /* FM_PASS_TILES, _TRIANGLES, _TOTAL: invocations of each unit, side by side in
                       a workgroup: a power of two up to FM_GROUP_LANES; 0 is 1. With
                       FM_GROUP_LANES a unit has a workgroup of its own, and may use shared memory
                       and barriers */
    uint32_t lanes_narrow; /* replaces lanes where subgroups have fewer than 32; 0 is lanes */
    bool narrow_only;      /* the pass is left out where subgroups have 32 lanes or more */
    fm_resumes resumes;    /* FM_PASS_PIXELS: see above */

    /* Not yet, each refused where it is set. */
    bool ordered_interlock;  /* exclusive: fragments of a pixel enter store() in drawing order */
    bool targets_after_lock; /* exclusive, with targets: a function of its own writes fm_target_NAME
                                behind the lock, where it is blended */
    bool writes_sample_mask; /* FM_PASS_SCENE: store() says which samples the fragment covers */
    bool shared_sort;        /* FM_PASS_PIXELS: the runner's key `sort` says how the fragments of a
                                pixel are sorted */
} fm_pass;

/* Passes first..last run again and again, and ping-pong resources swap after each iteration. A loop
 * ends after its count, or when a total is zero, which is read after each iteration; with both,
 * whichever comes first. With neither it needs a host pass inside, whose hook answers FM_REPEAT as
 * long as it goes on. Loops nest and do not overlap otherwise. */
typedef struct fm_loop {
    const char *first, *last; /* names of passes; last is the same pass or a later one */
    uint32_t count;           /* iterations: a constant, plus */
    uint32_t count_per_k;     /* so many for each k, plus */
    uint32_t count_per_n;     /* so many for each n, the most fragments of any pixel, plus */
    const char *until_zero;   /* a total; the first iteration always runs */
    uint32_t max;             /* never more iterations than this; 0 is 65536, after which a total
                                 that is not zero makes the case not_supported */
    const char *count_option; /* the whole number that this option is */
} fm_loop;

#endif
