/* What a method asks for, by its descriptor alone: extents and formats, for a workload. No device.
 */
#ifndef FM_FORMULA_H
#define FM_FORMULA_H

#include "fragmark/method.h"

/* Elements of an extent; a named total counts as workload->totals has it. Sizes beyond 64 bits stay
 * at UINT64_MAX, which no device has. */
uint64_t formula_elements(const fm_method_desc *method, const fm_extent *extent,
                          const fm_workload *workload);
uint32_t formula_layers(const fm_resource *resource, const fm_workload *workload);
uint32_t formula_samples(const fm_resource *resource, const fm_workload *workload);
uint64_t formula_image_bytes(const fm_resource *resource, const fm_workload *workload);
/* Elements that a frame uses of it, in bytes; images whole. */
uint64_t formula_used_bytes(const fm_resource *resource, const fm_workload *workload);
/* Bytes of a buffer that shares no other's memory: of its own extent, or of the largest that shares
 * its. */
uint64_t formula_buffer_bytes(const fm_method_desc *method, const fm_resource *resource,
                              const fm_workload *workload);
/* Bytes of all resources of a method once a frame has sized them, pools as grown as they get: what
 * the column bytes_predicted says. The runner's spin locks are not in it. */
uint64_t formula_bytes(const fm_method_desc *method, const fm_workload *workload);

bool loop_is_counted(const fm_loop *loop);
/* Iterations of a loop that is counted. */
uint32_t formula_count(const fm_loop *loop, const fm_workload *workload);

/* Squares of FM_TILE_PX in the viewport, border tiles counted. */
uint64_t workload_tiles(const fm_workload *workload);
/* Index of the total of this name, or -1. */
int total_index(const fm_method_desc *method, const char *name);

/* a + b, or UINT64_MAX. */
uint64_t formula_sum(uint64_t a, uint64_t b);

#endif
