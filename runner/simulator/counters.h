/* What is counted: one list, from which the struct, its sum and the names of metrics follow. */
#ifndef FM_TBR_COUNTERS_H
#define FM_TBR_COUNTERS_H

#include <stddef.h>
#include <stdint.h>

/* X(name, unit): events of one frame. Quads are 2x2 pixels with at least one of theirs. */
#define TBR_COUNTERS(X)                                                                            \
    X(vertices, "")     /* shaded */                                                               \
    X(vertex_lines, "") /* 64-byte lines of the vertex cache */                                    \
    X(vertex_instructions_run, "")                                                                 \
    X(primitives, "")       /* assembled */                                                        \
    X(pairs, "")            /* primitive, tile: entries of lists */                                \
    X(attribute_bytes, "B") /* of primitives, into the parameter buffer */                         \
    X(list_bytes, "B")      /* pointers of the lists */                                            \
    X(layer_bytes, "B")     /* layers beside the pointers */                                       \
    X(layer_lookups, "")    /* layer generator table: read and written */                          \
    X(fvp_reads, "")        /* FVP table */                                                        \
    X(fvp_writes, "")                                                                              \
    X(fvp_changes, "")     /* of its entries: flicker */                                           \
    X(hidden_by_layer, "") /* pairs predicted hidden */                                            \
    X(hidden_by_depth, "")                                                                         \
    X(hidden_but_seen, "") /* entries predicted hidden of which a fragment passed */               \
    X(signed_bytes, "B")   /* through the CRC compute unit */                                      \
    X(signed_pairs, "")    /* accumulated into a signature */                                      \
    X(signature_compares, "")                                                                      \
    X(tiles_rendered, "")                                                                          \
    X(tiles_skipped, "")                                                                           \
    X(tiles_kept, "")   /* rendered, not flushed */                                                \
    X(entries_read, "") /* of the lists of rendered tiles */                                       \
    X(read_bytes, "B")  /* of lists and attributes, for rendered tiles */                          \
    X(scalar_quads, "") /* quads rasterised, times scalars interpolated */                         \
    X(quads_rasterised, "")                                                                        \
    X(fragments_rasterised, "")                                                                    \
    X(quads_prepassed, "") /* of them, depth only */                                               \
    X(quads_shaded, "")                                                                            \
    X(fragments_shaded, "")                                                                        \
    X(fragment_instructions_run, "") /* four lanes of a quad count, used or not */                 \
    X(texture_bytes16, "B/16")       /* from DRAM */                                               \
    X(depth_quad_reads, "")                                                                        \
    X(depth_quad_writes, "")                                                                       \
    X(colour_quad_reads, "")                                                                       \
    X(colour_quad_writes, "")                                                                      \
    X(fragments_blended, "")                                                                       \
    X(layer_quad_writes, "")                                                                       \
    X(visibility_scans, "") /* tiles whose depth and layer buffers are read at their end */        \
    X(flush_bytes, "B")     /* colours to memory */

typedef struct tbr_counters {
#define TBR_FIELD(name, unit) uint64_t name;
    TBR_COUNTERS(TBR_FIELD)
#undef TBR_FIELD
} tbr_counters;

enum { TBR_COUNTER_COUNT = sizeof(tbr_counters) / sizeof(uint64_t) };

typedef struct tbr_counter_info {
    const char *name, *unit;
    size_t offset;
} tbr_counter_info;
extern const tbr_counter_info tbr_counter_infos[TBR_COUNTER_COUNT];

/* NULL: no counter has this name. */
const tbr_counter_info *counter_find(const char *name);
void counters_add(tbr_counters *sum, const tbr_counters *more);
uint64_t counters_get(const tbr_counters *counters, size_t index);

#endif
