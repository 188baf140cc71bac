/* Counts what a shader does with memory: a compute or fragment shader is rewritten so that it adds
 * up, for each resource that is asked for, bytes loaded and stored, atomics, and elements beyond a
 * resource's end, and does otherwise what it did.
 *
 * Each invocation counts for itself, in private variables, and adds them to a buffer where it ends:
 * that costs an atomic for each number that is not 0. What a helper invocation does is not counted,
 * for its atomics do nothing. An atomic loads and stores its operand, and counts as both. Not
 * counted is what no shader does: fills, clears, attachments, and what caches and compression make
 * of it. */
#ifndef FM_SPIRV_ACCESSES_H
#define FM_SPIRV_ACCESSES_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

typedef enum spirv_count {
    SPIRV_LOADED,  /* bytes */
    SPIRV_STORED,  /* bytes */
    SPIRV_ATOMICS, /* accesses; their bytes are loaded and stored, too */
    SPIRV_OUTSIDE, /* accesses of an element that the resource does not have */
    SPIRV_COUNT_KINDS
} spirv_count;

/* A resource whose accesses are counted. */
typedef struct spirv_resource {
    uint32_t binding;        /* of a buffer or an image; not read if by_address */
    bool by_address;         /* its address lies in the table, at: */
    uint32_t address_offset; /* bytes */
    uint32_t length_offset;  /* of a buffer: where its elements' number lies in the table */
    uint32_t texel_bytes;    /* of an image; 0: a buffer */
} spirv_resource;

typedef struct spirv_counting {
    const spirv_resource *resources; /* [resource_count]; borrowed */
    uint32_t resource_count;
    uint32_t table_binding;    /* uniform block with lengths and addresses */
    uint32_t counters_binding; /* of no other resource: a storage buffer of
                                  uint [resource_count][SPIRV_COUNT_KINDS][2], low word first */
} spirv_counting;

/* Words that the buffer of counters has for so many resources. */
#define SPIRV_COUNTER_WORDS(resources) ((resources)*SPIRV_COUNT_KINDS * 2u)

/* *counted: the rewritten module, which the caller frees; NULL on failure. Both modules are valid
 * where the given one is. FM_INVALID: the words are no module. FM_UNSUPPORTED, with the reason: it
 * reaches memory in a way that cannot be told to belong to a resource. */
fm_status spirv_count_accesses(uint32_t **counted, size_t *counted_words, const uint32_t *words,
                               size_t count, const spirv_counting *counting, fm_error *err);

#endif
