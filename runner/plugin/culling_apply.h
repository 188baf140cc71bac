/* Occupancy-map culling (Vasilakis, Papaioannou 2015, Improving k-buffer methods via Occupancy
 * Maps, Eurographics short papers) for any method that keeps the k nearest fragments, without a
 * change to it: a transform of its pass list.
 *
 *   cull-clear   the map's words
 *   cull-range   least and greatest depth of a body that holds the scene (section 2; cull_range)
 *   cull-fill    each fragment sets the bit of its bucket: 32 cull_words buckets a pixel
 *   cull-count   per pixel: the far edge of the k-th occupied bucket becomes the depth boundary
 *   ...          the method's own passes; its scene passes test against the boundary, by the depth
 *                test before the shader, or in the shader where a pass owns depth, stencil or
 *                several samples (or cull_test=shader); passes over a cover do not: what they draw
 *                are no fragments of the scene
 *
 * That the k nearest always pass (Lemma 2.1) depends on the body in nothing: a fragment outside its
 * range counts for the first or the last bucket, and a k-th bit in the last bucket, no range, or
 * fewer than k bits cull nothing. cull_bucket.glsl has the rounding. */
#ifndef FM_CULLING_APPLY_H
#define FM_CULLING_APPLY_H

#include "base/error.h"
#include "model/descriptor.h"
#include "model/settings.h"

/* Of a method whose resources are chosen (method_choose). FM_UNSUPPORTED, with the reason: a pass,
 * as culling makes it, cannot be on a reversed projection (depth_check.h); with culling also: the
 * method keeps other fragments than the k nearest or chooses k itself, the feed is not raster,
 * there are fewer buckets than k, the map is to lie where a layout has an image, or the descriptor
 * has no room. */
fm_status culling_check(const fm_method_desc *method, const fm_settings *settings, uint32_t feed,
                        fm_error *err);

/* How a method is to run. All borrowed. */
typedef struct fm_culling_desc {
    const fm_settings *settings;
    const fm_choice *choices; /* of the method's options: they size its buffers */
    size_t choice_count;
    uint32_t n;    /* most fragments of any pixel: some buffers have a place for each */
    uint32_t feed; /* one FM_FEED_* */
} fm_culling_desc;

/* The method as settings and choices want it: its copy, or transformed. Borrows from the method.
 * Fails as culling_check. */
fm_status culling_apply(fm_method_desc *culled, const fm_method_desc *method,
                        const fm_culling_desc *desc, fm_error *err);

/* Of a method that culling_apply made. */
bool culling_is_applied(const fm_method_desc *method);
/* Whether the pass, one of culling's own, builds the map. */
bool culling_is_map_pass(const fm_pass *pass);
/* Whether the pass's shader reads the boundary and tests against it. */
bool culling_tests_in_shader(const fm_pass *pass);

#endif
