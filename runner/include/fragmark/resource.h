/* The buffers and images of a method, and the numbers that the runner reads back from them.
 *
 * A plugin includes fragmark/method.h, which includes this file. The runner allocates what is
 * declared here, generates the GLSL declarations, clears, books the bytes and frees. Every size is
 * data, so that the runner knows what a method asks for before it runs, and compares that with what
 * was allocated.
 *
 * In all structs zero means "the default" or "none". Strings are the plugin's and live as long as
 * it. What is wrong is refused when the plugin is opened, with resource and field named. */
#ifndef FRAGMARK_RESOURCE_H
#define FRAGMARK_RESOURCE_H

#include <stdbool.h>
#include <stdint.h>

/* Side of the square tiles that fm_extent.per_tile and FM_PASS_TILES count, in pixels. */
enum { FM_TILE_PX = 8 };

/* How many elements a buffer has, as data: the sum of all terms. Each `per_` term is a factor, 4096
 * at most, times a count that the scene, the options or a frame gives. A sum beyond 64 bits stays
 * at 2^64 - 1, which no device has. Refused: all terms zero. */
typedef struct fm_extent {
    uint64_t constant;         /* elements whatever the scene is; 2^40 at most */
    uint64_t per_pixel;        /* times the pixels of the viewport */
    uint64_t per_pixel_k;      /* times pixels times k; see k_step */
    uint64_t per_pixel_n;      /* times pixels times n, the most fragments of any pixel */
    uint64_t per_fragment;     /* times F, all fragments of the frame. Only fm_resource.grown may
                                  have it: nobody knows F before a frame */
    uint64_t per_tile;         /* times the tiles of the viewport; those cut by its border count */
    uint64_t per_triangle;     /* times the scene's triangles, of all its instances */
    uint64_t per_total;        /* times the value of the total named `total` */
    const char *total;         /* needed by per_total, and by nothing else */
    uint64_t per_option;       /* times the number that the option named `option` is */
    const char *option;        /* needed by per_option and per_pixel_option; its values are whole
                                  numbers up to 2^20 */
    uint64_t per_pixel_option; /* times pixels times that number */
    uint32_t k_step;           /* per_pixel_k counts ceil(k / k_step) instead of k; 0 is 1 */
} fm_extent;

/* How many elements of a buffer hold something in a frame: what bytes_used reports. Each factor is
 * 4096 at most. The sum is cut at the resource's length. */
typedef struct fm_used {
    uint64_t per_pixel;    /* times the pixels of the viewport */
    uint64_t per_fragment; /* times F, all fragments of the frame */
    uint64_t per_kept;     /* times F_k, the sum of min(fragments, k) over all pixels */
} fm_used;

typedef enum fm_resource_kind {
    FM_RESOURCE_BUFFER,    /* elements of one type; shaders write NAME[i] */
    FM_RESOURCE_IMAGE,     /* texels over the viewport's pixels */
    FM_RESOURCE_KIND_COUNT /* how many kinds there are; no kind */
} fm_resource_kind;

/* What one element of a buffer is in GLSL (std430), and its size. */
typedef enum fm_element {
    FM_ELEMENT_UINT,   /* 4 bytes */
    FM_ELEMENT_UVEC2,  /* 8 bytes: a fragment as fm_pack() makes it */
    FM_ELEMENT_UVEC4,  /* 16 bytes */
    FM_ELEMENT_FLOAT,  /* 4 bytes */
    FM_ELEMENT_VEC2,   /* 8 bytes */
    FM_ELEMENT_VEC4,   /* 16 bytes */
    FM_ELEMENT_UINT64, /* 8 bytes; needs FM_FEATURE_INT64_ATOMICS */
    FM_ELEMENT_COUNT   /* how many types there are; no type */
} fm_element;

/* What one texel of an image is, and the bytes that are booked for each of its samples. Formats
 * without UI or F are normalised, as Vulkan's UNORM: shaders see 0..1. A device that lacks one
 * answers not_supported. */
typedef enum fm_format {
    FM_FORMAT_NONE,     /* of buffers; an image needs another one */
    FM_FORMAT_R32UI,    /* 4 bytes; the only one that takes image atomics on every device */
    FM_FORMAT_RG32UI,   /* 8 bytes */
    FM_FORMAT_RGBA32UI, /* 16 bytes */
    FM_FORMAT_R32F,     /* 4 bytes */
    FM_FORMAT_RG32F,    /* 8 bytes */
    FM_FORMAT_RGBA32F,  /* 16 bytes */
    FM_FORMAT_RGBA8,    /* 4 bytes, normalised */
    FM_FORMAT_D32F,     /* 4 bytes: depth */
    FM_FORMAT_D32F_S8,  /* 5 bytes: depth and an 8-bit stencil, whatever a device pads them to */
    FM_FORMAT_R8,       /* 1 byte, normalised */
    FM_FORMAT_R16,      /* 2 bytes, normalised */
    FM_FORMAT_RG16,     /* 4 bytes, normalised */
    FM_FORMAT_RGBA16,   /* 8 bytes, normalised */
    FM_FORMAT_R16F,     /* 2 bytes: a half */
    FM_FORMAT_RG16F,    /* 4 bytes: halves */
    FM_FORMAT_RGBA16F,  /* 8 bytes: halves */
    FM_FORMAT_COUNT     /* how many formats there are; no format */
} fm_format;

/* When the length of a buffer is known. */
typedef enum fm_sizing {
    FM_SIZE_FIXED,       /* before the frame */
    FM_SIZE_AFTER_TOTAL, /* once extent.total was read back within the frame. A buffer that is there
                            and long enough stays */
    FM_SIZE_GROW,        /* it starts at the extent. If the total named `overflow` counts elements
                            that found no room, it grows by so many and the frame is done again */
    FM_SIZE_COUNT        /* how many ways there are; no way */
} fm_sizing;

/* One buffer or image. Fields of the other kind have to be zero. */
typedef struct fm_resource {
    const char *name;      /* a GLSL identifier: lower-case letters, digits and '_', under 64
                              bytes; no word of GLSL, and not fm_x, gl_x or a__b */
    fm_resource_kind kind; /* a buffer unless it says otherwise */

    /* Of buffers. */
    fm_element element;   /* type of an element */
    fm_extent extent;     /* its length, in elements; a length of 0 is allocated as 1. Of an image
                             instead of `layers`: see there */
    fm_sizing sizing;     /* when that is known */
    const char *overflow; /* FM_SIZE_GROW: the total that counts elements without room */
    fm_extent grown;      /* FM_SIZE_GROW: elements that a frame needs in the end. bytes_predicted
                             books the larger of this and `extent`; all zero is `extent` */
    const char *shares;   /* this fixed buffer lies in the memory of that other fixed buffer, which
                             gets the larger of both sizes. What one of them holds is lost as soon as
                             a pass writes the other; a clear pass fills all of the memory */

    /* Of images. */
    fm_format format;        /* of a texel; needed */
    uint32_t samples;        /* samples of a texel: a power of two up to 16; 0 is 1 */
    uint32_t samples_per_k;  /* added to them: this times k; 16 at most */
    uint32_t layers;         /* array layers, 2048 at most; 0 is 1 */
    uint32_t layers_per_k;   /* added to them: this times k; 2048 at most. Shaders name the layer
                                where there may be more than one: see pass.h. Instead of both,
                                `extent` may say how many elements a pixel has, each on a layer of
                                its own, by per_pixel, per_pixel_k, per_pixel_n and
                                per_pixel_option: as the buffer has it that the image stands in for
                                (when_option) */
    float clear_colour[4];   /* what a clear pass, or a target with FM_LOAD_CLEAR, writes: R G B A
                                in the format's range. Integer formats take its bits, if
                                clear_words is zero */
    uint32_t clear_words[4]; /* the same for integer formats, which take any words */
    float clear_depth;       /* the same for depth formats: 0..1 */
    uint32_t clear_stencil;  /* the same for the stencil: 0..255 */

    /* Of both. */
    bool ping_pong; /* there are two copies, and after each iteration of a loop they swap: NAME is
                       the copy that is written, NAME_previous (a name for `reads`) the one that the
                       last iteration wrote. Both copies are booked */
    fm_used used;   /* elements that hold something, or texels; an image with none counts whole */
    const char *samples_option; /* images; samples added to the others: the whole number that this
                                   option is */

    /* The resource is there only where option `when_option` has the value `when_value`, and then
     * takes the place of the one of the same name that has no condition, which has to be declared,
     * too: a layered image for a buffer, say. Passes name either by that name, and what they do
     * with it must suit both. The macro of the option tells shaders which one it is. Stand-ins of
     * one name hang on one option. Neither they nor what they replace are ping-pong, sized after a
     * total or shared, and no total, target, depth or indirect pass names them. If one of them
     * grows, so does the other, by the same `overflow`; what that counts are elements of the one
     * that is there. */
    const char *when_option, *when_value;
} fm_resource;

/* A number that the runner reads back after a pass, 64 bits wide. Reading it splits the frame: the
 * device finishes, and the wait counts in frame_wall_ms only. Exactly one of three sources is set:
 *   resource, index   one word of a buffer
 *   resource, sum     the sum of all its words, added up on the host
 *   neither           the samples that passed all tests in the scene pass `pass` */
typedef struct fm_total {
    const char *name;     /* lower-case letters, digits, '-' and '_' */
    const char *resource; /* a buffer of FM_ELEMENT_UINT */
    uint64_t index;       /* which element of it */
    bool sum;             /* all of its elements instead */
    const char *pass;     /* the total is read after this pass, which runs on every device */
    bool late;            /* this total only sizes resources. Once they are there a frame does not
                             wait for it: they may be too small, so whoever writes to them checks
                             fm_length_NAME, and the frame is done again if the total, read at its
                             end, is larger. The element keeps its value until then; methods with
                             loops have none */
} fm_total;

#endif
