/* What a method asks for, by its descriptor alone: extents, formats and counts for a workload. No
 * device and no allocation. Sizes beyond 64 bits stay at UINT64_MAX, which no device has. */
#ifndef FM_FORMULA_H
#define FM_FORMULA_H

#include "fragmark/method.h"

/* Elements of an extent: the sum of its terms. A named total counts as workload->totals has it, an
 * option as the whole number that workload->option answers. */
uint64_t formula_elements(const fm_method_desc *method, const fm_extent *extent,
                          const fm_workload *workload);
/* Array layers of an image: 1 at least. */
uint32_t formula_layers(const fm_resource *resource, const fm_workload *workload);
/* Whether shaders name a layer of the image, though it may be the only one. */
bool image_is_array(const fm_resource *resource);
/* Samples of each of its texels: 1 at least, not necessarily a number that a device has. */
uint32_t formula_samples(const fm_resource *resource, const fm_workload *workload);
/* Bytes of one copy of an image, as formats book them. */
uint64_t formula_image_bytes(const fm_resource *resource, const fm_workload *workload);
/* Bytes of the elements that hold something in a frame (fm_used), however long the buffer is. Of an
 * image at most all, and all where fm_used says nothing. */
uint64_t formula_used_bytes(const fm_resource *resource, const fm_workload *workload);
/* Bytes of a buffer that shares no other's memory: of its own extent, or of the largest that shares
 * its. */
uint64_t formula_buffer_bytes(const fm_method_desc *method, const fm_resource *resource,
                              const fm_workload *workload);
/* Bytes of all resources of a method once a frame has sized them, pools as grown as they get: what
 * the column bytes_predicted says. The runner's spin locks are not in it. */
uint64_t formula_bytes(const fm_method_desc *method, const fm_workload *workload);

/* Whether a loop has a count, though it be 0 for a workload; else a total or a hook ends it. */
bool loop_is_counted(const fm_loop *loop);
/* Iterations of a loop that is counted; fewer run if a total ends it or its max is less. */
uint32_t formula_count(const fm_loop *loop, const fm_workload *workload);

/* Squares of FM_TILE_PX in the viewport, border tiles counted. */
uint64_t workload_tiles(const fm_workload *workload);
/* Index of the total of this name, or -1. */
int total_index(const fm_method_desc *method, const char *name);

/* a + b, or UINT64_MAX. */
uint64_t formula_sum(uint64_t a, uint64_t b);

#endif
