/* How long a frame takes, in cycles: geometry, then raster.
 *
 * Geometry is the slowest of its stages' totals; the queue between list builder and signature unit,
 * which may stall the builder, is followed pair by pair. Raster is, for each rendered tile, the
 * slowest stage (form A), summed over tiles. Form B follows the primitives of a row of tiles
 * through the queues between the stages instead, with two buffers a tile; ratios of techniques must
 * not depend on the form, and do not by over 0.3 points, but for a depth prepass: 2.5 at most.
 *
 * Not modelled, since they slow all techniques' tiles alike: contents of caches, DRAM banks and
 * rows, scheduling of threads, other queues, the order of tiles. */
#ifndef FM_TBR_CYCLES_H
#define FM_TBR_CYCLES_H

#include <stdint.h>

#include "parameters.h"
#include "simulator/tbr.h"

/* One parameter at another value; the first is the nominal set. */
typedef enum cycles_variant {
    CYCLES_NOMINAL,
    CYCLES_SHORT_SHADERS,
    CYCLES_LONG_SHADERS,
    CYCLES_LITTLE_TEXTURE,
    CYCLES_MUCH_TEXTURE,
    CYCLES_SHORT_LATENCY,
    CYCLES_LONG_LATENCY,
    CYCLES_FAST_ACCUMULATE,
    CYCLES_SLOW_ACCUMULATE,
    CYCLES_VARIANT_COUNT
} cycles_variant;

typedef struct cycles_variant_info {
    const char *name; /* "fragment_instructions.low" */
    size_t offset;    /* of the parameter */
    bool is_high, is_nominal;
} cycles_variant_info;
extern const cycles_variant_info cycles_variants[CYCLES_VARIANT_COUNT];

/* Of one frame. */
typedef struct cycles_frame {
    double geometry[CYCLES_VARIANT_COUNT];
    double raster[CYCLES_VARIANT_COUNT]; /* form A */
    double raster_b;                     /* form B, nominal */
    double signature_stall;              /* in geometry, nominal */
    double stages[6];                    /* of raster, nominal: busy cycles of each stage */
} cycles_frame;
extern const char *const cycles_stage_names[6];

typedef struct cycles cycles;

fm_status cycles_create(cycles **made, const model_table *table, uint32_t tile_count,
                        uint32_t tiles_across, fm_error *err);
void cycles_destroy(cycles *self);
/* tbr_desc.binned and tbr_desc.rendered, with the model for context. */
void cycles_binned(void *context, const tbr_geometry *geometry, const tbr_counters *counters);
void cycles_rendered(void *context, const tbr_tile_work *work);
/* After the frame. */
cycles_frame cycles_of_frame(const cycles *self, const tbr_counters *counters);
/* The part of a parameter buffer of that size that does not stay in the L2 cache. */
double cycles_spilled(const model_parameters *p, const tbr_counters *counters);

#endif
