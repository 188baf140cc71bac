/* Truth of the feed `triangles`: the host rasterises (rasterise.h), no device takes part. */
#ifndef FM_TRUTH_TRIANGLES_H
#define FM_TRUTH_TRIANGLES_H

#include "scene/scene.h"

/* A fragment before its pixel's are sorted, as truth_store.glsl writes it. */
typedef struct truth_record {
    uint32_t depth_bits, colour, primitive, unused;
} truth_record;

/* Pixels first..first + pixels - 1 and where their records go. */
typedef struct truth_band {
    uint64_t first, pixels;
    truth_record *records;
    uint32_t *cursors; /* [pixels of the scene]: the next record of each pixel of the band */
} truth_band;

/* Adds each pixel's fragments to counts. */
void truth_count_triangles(uint32_t *counts, const fm_scene *scene);
void truth_store_triangles(const truth_band *band, const fm_scene *scene);

#endif
