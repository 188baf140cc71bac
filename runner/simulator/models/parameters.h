/* The models' parameters: one list of names, their values from parameters.yml. */
#ifndef FM_TBR_PARAMETERS_H
#define FM_TBR_PARAMETERS_H

#include <stddef.h>

#include "base/error.h"

#define MODEL_PARAMETERS(X)                                                                        \
    X(clock_mhz)                                                                                   \
    X(dram_bytes_per_cycle)                                                                        \
    X(dram_latency_cycles)                                                                         \
    X(misses_in_flight)                                                                            \
    X(line_bytes)                                                                                  \
    X(l2_bytes)                                                                                    \
    X(compute_bytes_per_cycle)                                                                     \
    X(accumulate_cycles)                                                                           \
    X(overlapped_tiles_queue)                                                                      \
    X(tile_queue)                                                                                  \
    X(fragment_queue)                                                                              \
    X(setup_cycles)                                                                                \
    X(scalars_per_cycle)                                                                           \
    X(fragment_processors)                                                                         \
    X(fragment_instructions)                                                                       \
    X(texture_traffic)                                                                             \
    X(scan_cycles)                                                                                 \
    X(compare_cycles)                                                                              \
    X(quad_read_pj)                                                                                \
    X(quad_write_pj)                                                                               \
    X(lut_read_pj)                                                                                 \
    X(vertex_line_pj)                                                                              \
    X(texture_access_pj)                                                                           \
    X(tile_cache_line_pj)                                                                          \
    X(l2_read_line_pj)                                                                             \
    X(l2_write_line_pj)                                                                            \
    X(table_read_pj)                                                                               \
    X(table_write_pj)                                                                              \
    X(signature_read_pj)                                                                           \
    X(signature_write_pj)                                                                          \
    X(dram_pj_per_byte)                                                                            \
    X(fragment_instruction_pj)                                                                     \
    X(vertex_instruction_pj)                                                                       \
    X(scalar_quad_pj)                                                                              \
    X(blend_pj)                                                                                    \
    X(compare_pj)                                                                                  \
    X(logic_mw)                                                                                    \
    X(dram_standby_mw)                                                                             \
    X(caches_mw)                                                                                   \
    X(tile_buffers_mw)                                                                             \
    X(visibility_mw)                                                                               \
    X(signature_mw)

typedef struct model_parameters {
#define MODEL_FIELD(name) double name;
    MODEL_PARAMETERS(MODEL_FIELD)
#undef MODEL_FIELD
} model_parameters;

enum { MODEL_PARAMETER_COUNT = sizeof(model_parameters) / sizeof(double) };
/* Bounds of the queues' lengths, which are kept in arrays. */
enum { MODEL_QUEUE_MAX = 256 };

typedef struct model_table {
    model_parameters nominal;
    model_parameters low, high; /* the nominal value where no sweep goes */
    model_parameters hp;        /* with high-performance SRAM cells */
} model_table;

/* The built-in table, with overrides "NAME=VALUE NAME=VALUE" put in place of nominal values (and of
 * their hp). FM_INVALID: an unknown name, with the nearest; a value that is no positive number, or
 * a queue longer than MODEL_QUEUE_MAX. */
fm_status model_table_read(model_table *table, const char *overrides, fm_error *err);
/* Parameters by number, in the order of the list. */
double *model_parameter(model_parameters *parameters, size_t index);

#endif
