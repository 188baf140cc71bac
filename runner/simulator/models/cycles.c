#include "cycles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STAGE_COUNT = sizeof cycles_stage_names / sizeof cycles_stage_names[0] };
enum { FETCH, RASTERISE, DEPTH, SHADE, BLEND, MEMORY };
const char *const cycles_stage_names[6] = {
    [FETCH] = "fetch", [RASTERISE] = "rasterise", [DEPTH] = "depth",
    [SHADE] = "shade", [BLEND] = "blend",         [MEMORY] = "memory",
};

#define AT(name) offsetof(model_parameters, name)
const cycles_variant_info cycles_variants[CYCLES_VARIANT_COUNT] = {
    [CYCLES_NOMINAL] = { "nominal", 0, false, true },
    [CYCLES_SHORT_SHADERS] = { "fragment_instructions.low", AT(fragment_instructions), false,
                               false },
    [CYCLES_LONG_SHADERS] = { "fragment_instructions.high", AT(fragment_instructions), true,
                              false },
    [CYCLES_LITTLE_TEXTURE] = { "texture_traffic.low", AT(texture_traffic), false, false },
    [CYCLES_MUCH_TEXTURE] = { "texture_traffic.high", AT(texture_traffic), true, false },
    [CYCLES_SHORT_LATENCY] = { "dram_latency_cycles.low", AT(dram_latency_cycles), false, false },
    [CYCLES_LONG_LATENCY] = { "dram_latency_cycles.high", AT(dram_latency_cycles), true, false },
    [CYCLES_FAST_ACCUMULATE] = { "accumulate_cycles.low", AT(accumulate_cycles), false, false },
    [CYCLES_SLOW_ACCUMULATE] = { "accumulate_cycles.high", AT(accumulate_cycles), true, false },
};

/* A tile's own results; each is written by one thread. */
typedef struct tile_cycles {
    double raster[CYCLES_VARIANT_COUNT];
    double stages[STAGE_COUNT];
} tile_cycles;

/* Form B, in a row of tiles: when each stage is done with what it has been given. A stage that
 * works on one primitive passes its quads on at once, and cannot be further ahead than the queue
 * behind it holds; it goes on with the next tile, of whose buffers there are two. */
typedef struct row_clock {
    double fetched, rasterised, shaded, blended;
    double left[MODEL_QUEUE_MAX]; /* when the last primitives left the rasteriser, by number */
    uint32_t primitives;
    double end, previous_end; /* of the last tile, and of the one before */
    double scans;
} row_clock;

struct cycles {
    model_parameters p[CYCLES_VARIANT_COUNT];
    tile_cycles *tiles; /* [tile_count] */
    uint32_t tile_count;
    row_clock *rows; /* each is written by one thread at a time */
    uint32_t row_count, tiles_across;
    double spilled; /* of this frame's parameter buffer */
    double geometry[CYCLES_VARIANT_COUNT], signature_stall;
};

fm_status cycles_create(cycles **made, const model_table *table, uint32_t tile_count,
                        uint32_t tiles_across, fm_error *err)
{
    const uint32_t row_count = (tile_count + tiles_across - 1) / tiles_across;
    cycles *self = calloc(1, sizeof *self);
    *made = NULL;
    if (self != NULL) {
        self->tiles = calloc(tile_count, sizeof *self->tiles);
        self->rows = calloc(row_count, sizeof *self->rows);
    }
    if (self == NULL || self->tiles == NULL || self->rows == NULL) {
        cycles_destroy(self);
        return fm_fail(err, FM_NO_MEMORY, "no memory for the cycles of %u tiles", tile_count);
    }
    self->tile_count = tile_count;
    self->row_count = row_count;
    self->tiles_across = tiles_across;
    for (size_t i = 0; i < CYCLES_VARIANT_COUNT; i++) {
        const cycles_variant_info *info = &cycles_variants[i];
        self->p[i] = table->nominal;
        if (!info->is_nominal)
            memcpy((char *)&self->p[i] + info->offset,
                   (const char *)(info->is_high ? &table->high : &table->low) + info->offset,
                   sizeof(double));
    }
    *made = self;
    return FM_OK;
}

void cycles_destroy(cycles *self)
{
    if (self == NULL)
        return;
    free(self->tiles);
    free(self->rows);
    free(self);
}

double cycles_spilled(const model_parameters *p, const tbr_counters *counters)
{
    const double size =
        (double)(counters->attribute_bytes + counters->list_bytes + counters->layer_bytes);
    return size > p->l2_bytes ? 1 - p->l2_bytes / size : 0;
}

/* ---- geometry ---- */

/* The list builder and the signature unit behind it: a queue of tiles that still wait for a
 * primitive's CRC. */
typedef struct builder_clock {
    double builder;                      /* when it is free */
    double unstalled;                    /* if nothing ever waited */
    double compute, accumulate;          /* when they are free */
    double accumulated[MODEL_QUEUE_MAX]; /* of the last signed pairs, by number */
    uint64_t signed_pairs;
} builder_clock;

static void sign_pair(builder_clock *clock, const model_parameters *p)
{
    const uint64_t queue = (uint64_t)p->overlapped_tiles_queue;
    const double start = clock->accumulate > clock->compute ? clock->accumulate : clock->compute;
    double *place = &clock->accumulated[clock->signed_pairs % queue];
    /* The place in the queue is free when the pair that held it before is done. */
    if (clock->signed_pairs >= queue && *place > clock->builder)
        clock->builder = *place;
    clock->accumulate = (start > clock->builder ? start : clock->builder) + p->accumulate_cycles;
    *place = clock->accumulate;
    clock->signed_pairs++;
}

static double build_lists(double *stall, const tbr_geometry *geometry, const model_parameters *p)
{
    builder_clock clock = { 0 };
    uint64_t pair = 0;
    for (uint32_t i = 0; i < geometry->primitive_count; i++) {
        const fm_draw_call *draw = &geometry->frame->draws[geometry->primitive_draw[i]];
        const uint32_t pairs = geometry->pair_counts[i];
        const double lines = ceil(draw->attribute_bytes / p->line_bytes);
        if (pairs == 0)
            continue;
        const double times = geometry->draw_is_prepassed[geometry->primitive_draw[i]] ? 2 : 1;
        clock.builder += times * lines;
        clock.unstalled += times * (lines + pairs);
        if (geometry->pair_is_signed == NULL) {
            clock.builder += times * pairs;
            continue;
        }
        clock.compute = (clock.compute > clock.builder ? clock.compute : clock.builder) +
                        ceil(draw->attribute_bytes / p->compute_bytes_per_cycle);
        for (uint32_t k = 0; k < pairs; k++) {
            clock.builder += 1;
            if (geometry->pair_is_signed[pair + k])
                sign_pair(&clock, p);
        }
        pair += pairs;
    }
    *stall = clock.builder - clock.unstalled;
    return clock.builder > clock.accumulate ? clock.builder : clock.accumulate;
}

static double largest(const double *values, size_t count)
{
    double most = 0;
    for (size_t i = 0; i < count; i++)
        most = values[i] > most ? values[i] : most;
    return most;
}

static double memory_cycles(const cycles *self, const tbr_counters *counters)
{
    const model_parameters *p = &self->p[CYCLES_NOMINAL];
    const double written =
        (double)(counters->attribute_bytes + counters->list_bytes + counters->layer_bytes);
    return ((double)counters->vertex_lines * p->line_bytes + self->spilled * written) /
           p->dram_bytes_per_cycle;
}

void cycles_binned(void *context, const tbr_geometry *geometry, const tbr_counters *counters)
{
    cycles *self = context;
    double stall = 0;
    self->spilled = cycles_spilled(&self->p[CYCLES_NOMINAL], counters);
    memset(self->tiles, 0, self->tile_count * sizeof *self->tiles);
    memset(self->rows, 0, self->row_count * sizeof *self->rows);
    double stages[] = { (double)counters->vertex_lines, (double)counters->vertex_instructions_run,
                        (double)counters->primitives, memory_cycles(self, counters), 0 };
    for (size_t i = 0; i < CYCLES_VARIANT_COUNT; i++) {
        const bool differs = i == CYCLES_FAST_ACCUMULATE || i == CYCLES_SLOW_ACCUMULATE;
        if (i == CYCLES_NOMINAL)
            stages[4] = build_lists(&self->signature_stall, geometry, &self->p[i]);
        else if (differs && geometry->pair_is_signed != NULL)
            stages[4] = build_lists(&stall, geometry, &self->p[i]);
        else {
            self->geometry[i] = self->geometry[CYCLES_NOMINAL];
            continue;
        }
        self->geometry[i] = largest(stages, sizeof stages / sizeof stages[0]);
    }
}

/* ---- raster ---- */

/* What a tile's list adds up to. */
typedef struct tile_sums {
    double entries, lines, bytes;
    double scalar_cycles, quads, shaded;
    double instructions; /* cycles of one processor */
    double texture_bytes;
} tile_sums;

static double interpolation_cycles(const fm_draw_call *draw, bool is_prepass,
                                   const model_parameters *p)
{
    const double scalars = is_prepass ? 1 : draw->scalars;
    return ceil(4 * scalars / p->scalars_per_cycle);
}

static tile_sums sum_tile(const tbr_tile_work *tile, const model_parameters *p)
{
    tile_sums sums = { .entries = tile->count };
    for (uint32_t i = 0; i < tile->count; i++) {
        const tbr_work *work = &tile->work[i];
        const fm_draw_call *draw = &tile->frame->draws[work->draw];
        sums.lines += ceil(draw->attribute_bytes / p->line_bytes);
        sums.bytes += draw->attribute_bytes;
        sums.scalar_cycles += work->quads * interpolation_cycles(draw, work->is_prepass, p);
        sums.quads += work->quads;
        sums.shaded += work->shaded_quads;
        sums.instructions += 4.0 * work->shaded_quads * draw->fragment_instructions;
        sums.texture_bytes += 4.0 * work->shaded_quads * draw->texture_bytes16 / 16;
    }
    return sums;
}

/* Cycles of one processor that wait for textures. */
static double texture_stall(double texture_bytes, const model_parameters *p)
{
    return texture_bytes * p->texture_traffic / p->line_bytes * p->dram_latency_cycles /
           p->misses_in_flight;
}

static void fill_stages(double stages[STAGE_COUNT], const tile_sums *sums,
                        const tbr_tile_work *tile, double spilled, const model_parameters *p)
{
    const double list_bytes = 4 * sums->entries;
    stages[FETCH] = list_bytes / p->line_bytes + sums->lines;
    stages[RASTERISE] = sums->entries * p->setup_cycles + sums->scalar_cycles;
    stages[DEPTH] = sums->quads;
    stages[SHADE] =
        (sums->instructions * p->fragment_instructions + texture_stall(sums->texture_bytes, p)) /
        p->fragment_processors;
    stages[BLEND] = sums->shaded;
    stages[MEMORY] = (sums->texture_bytes * p->texture_traffic +
                      spilled * (list_bytes + sums->bytes) + tile->flush_bytes) /
                     p->dram_bytes_per_cycle;
}

static double later(double a, double b)
{
    return a > b ? a : b;
}

static void follow(row_clock *clock, const tbr_work *work, const fm_draw_call *draw,
                   const model_parameters *p)
{
    const uint32_t index = clock->primitives++;
    const uint32_t queue = (uint32_t)p->tile_queue;
    const double lines = ceil(draw->attribute_bytes / p->line_bytes) + 4 / p->line_bytes;
    const double shading =
        (4.0 * work->shaded_quads * draw->fragment_instructions * p->fragment_instructions +
         texture_stall(4.0 * work->shaded_quads * draw->texture_bytes16 / 16, p)) /
        p->fragment_processors;
    const double per_quad = work->shaded_quads > 0 ? shading / work->shaded_quads : 0;
    if (index >= queue)
        clock->fetched = later(clock->fetched, clock->left[index % queue]);
    clock->fetched += lines;
    const double begin = later(clock->rasterised, clock->fetched);
    const double raster =
        p->setup_cycles + work->quads * later(1, interpolation_cycles(draw, work->is_prepass, p));
    const double first_quad = begin + p->setup_cycles;
    clock->rasterised = begin + raster;
    if (work->shaded_quads > 0) {
        clock->shaded =
            later(later(clock->shaded, first_quad) + shading, begin + raster + per_quad);
        /* What is hidden waits for no place in the queue: it is rejected before. */
        clock->rasterised = later(clock->rasterised, clock->shaded - p->fragment_queue * per_quad);
    }
    clock->left[index % queue] = clock->rasterised;
    clock->blended = later(clock->blended + work->shaded_quads, clock->shaded);
}

/* A tile takes as long as memory needs for it, and waits for the buffer of the one before the last.
 */
static void follow_tile(row_clock *clock, const tbr_tile_work *tile, double memory_cycles_needed,
                        const model_parameters *p)
{
    clock->shaded = later(clock->shaded, clock->previous_end);
    for (uint32_t i = 0; i < tile->count; i++)
        follow(clock, &tile->work[i], &tile->frame->draws[tile->work[i].draw], p);
    clock->previous_end = clock->end;
    clock->end = later(later(clock->rasterised, clock->blended), clock->end + memory_cycles_needed);
    clock->scans += tile->scans ? p->scan_cycles : 0;
}

void cycles_rendered(void *context, const tbr_tile_work *work)
{
    const cycles *self = context;
    tile_cycles *tile = &self->tiles[work->tile];
    const tile_sums sums = sum_tile(work, &self->p[CYCLES_NOMINAL]);
    double stages[STAGE_COUNT];
    for (size_t i = CYCLES_VARIANT_COUNT; i-- > 0;) { /* the nominal one last */
        const double end = work->scans ? self->p[i].scan_cycles : 0;
        fill_stages(stages, &sums, work, self->spilled, &self->p[i]);
        tile->raster[i] = largest(stages, STAGE_COUNT) + end;
    }
    memcpy(tile->stages, stages, sizeof stages);
    follow_tile(&self->rows[work->tile / self->tiles_across], work, stages[MEMORY],
                &self->p[CYCLES_NOMINAL]);
}

cycles_frame cycles_of_frame(const cycles *self, const tbr_counters *counters)
{
    cycles_frame frame = { .signature_stall = self->signature_stall };
    memcpy(frame.geometry, self->geometry, sizeof frame.geometry);
    for (size_t i = 0; i < CYCLES_VARIANT_COUNT; i++)
        frame.raster[i] = (double)counters->signature_compares * self->p[i].compare_cycles;
    frame.raster_b = frame.raster[CYCLES_NOMINAL];
    for (uint32_t t = 0; t < self->tile_count; t++) {
        for (size_t i = 0; i < CYCLES_VARIANT_COUNT; i++)
            frame.raster[i] += self->tiles[t].raster[i];
        for (size_t i = 0; i < STAGE_COUNT; i++)
            frame.stages[i] += self->tiles[t].stages[i];
    }
    for (uint32_t i = 0; i < self->row_count; i++)
        frame.raster_b += self->rows[i].end + self->rows[i].scans;
    return frame;
}
