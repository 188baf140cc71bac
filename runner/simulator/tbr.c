#include "tbr.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "internal.h"

static uint32_t choose_threads(uint32_t wanted)
{
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    const uint32_t count = wanted != 0 ? wanted : online > 0 ? (uint32_t)online : 1;
    return count < TBR_MAX_THREADS ? count : TBR_MAX_THREADS;
}

static fm_status allocate(tbr *gpu, fm_error *err)
{
    const size_t pixels = (size_t)gpu->desc.width_px * gpu->desc.height_px;
    gpu->image = calloc(pixels, sizeof *gpu->image);
    gpu->bins = calloc(gpu->tile_count, sizeof *gpu->bins);
    gpu->memory = calloc(gpu->tile_count, sizeof *gpu->memory);
    gpu->threads = calloc(gpu->desc.threads, sizeof *gpu->threads);
    if (tbr_has(gpu, FM_PART_TWO_BUFFERS)) {
        gpu->other_image = calloc(pixels, sizeof *gpu->image);
        gpu->other_memory = calloc(gpu->tile_count, sizeof *gpu->memory);
        if (gpu->other_image == NULL || gpu->other_memory == NULL)
            return fm_fail(err, FM_NO_MEMORY, "no memory for %zu pixels twice", pixels);
    }
    if (gpu->image == NULL || gpu->bins == NULL || gpu->memory == NULL || gpu->threads == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu pixels", pixels);
    for (uint32_t i = 0; i < gpu->tile_count; i++)
        gpu->memory[i].fvp = FM_FVP_UNKNOWN;
    if (gpu->other_memory != NULL)
        memcpy(gpu->other_memory, gpu->memory, gpu->tile_count * sizeof *gpu->memory);
    const bool has_history = tbr_has(gpu, FM_PART_OBJECT_ORDER | FM_PART_UPLOADS);
    const fm_status status = has_history ? history_create(&gpu->history, err) : FM_OK;
    return status == FM_OK ? pool_create(&gpu->pool, gpu->desc.threads, err) : status;
}

fm_status tbr_create(tbr **made, const tbr_desc *desc, fm_error *err)
{
    *made = NULL;
    if (desc->width_px == 0 || desc->height_px == 0 || desc->width_px > FRAMES_SIDE_MAX ||
        desc->height_px > FRAMES_SIDE_MAX)
        return fm_fail(err, FM_INVALID, "%u x %u px: each side has 1 to %d", desc->width_px,
                       desc->height_px, FRAMES_SIDE_MAX);
    tbr *gpu = calloc(1, sizeof *gpu);
    if (gpu == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the simulated GPU");
    gpu->desc = *desc;
    gpu->desc.threads = choose_threads(desc->threads);
    if (desc->technique != NULL)
        gpu->technique = *desc->technique;
    gpu->span = span_function(desc->no_vectors);
    gpu->tiles_x = (desc->width_px + FM_TILE_SIDE - 1) / FM_TILE_SIDE;
    gpu->tiles_y = (desc->height_px + FM_TILE_SIDE - 1) / FM_TILE_SIDE;
    gpu->tile_count = gpu->tiles_x * gpu->tiles_y;
    crc_table_fill(&gpu->crc);
    crc_shift_fill(&gpu->shift_state, &gpu->crc, TBR_STATE_BYTES);
    crc_shift_fill(&gpu->shift_primitive, &gpu->crc, sizeof(fm_triangle));
    const fm_status status = allocate(gpu, err);
    if (status == FM_OK)
        *made = gpu;
    else
        tbr_destroy(gpu);
    return status;
}

void tbr_destroy(tbr *gpu)
{
    if (gpu == NULL)
        return;
    pool_destroy(gpu->pool);
    for (uint32_t i = 0; gpu->threads != NULL && i < gpu->desc.threads; i++)
        free(gpu->threads[i].work);
    free(gpu->threads);
    history_destroy(gpu->history);
    free(gpu->image);
    free(gpu->other_image);
    free(gpu->bins);
    free(gpu->memory);
    free(gpu->other_memory);
    free(gpu->draws);
    free(gpu->draw_is_prepassed);
    free(gpu->draw_may_move);
    free(gpu->draw_order);
    free(gpu->setups);
    free(gpu->primitive_draw);
    free(gpu->pair_counts);
    free(gpu->entries);
    free(gpu->pair_is_signed);
    free(gpu);
}

/* Rows of tiles are handed out one by one; what a row is does not depend on who draws it. */
static void raster_work(void *context, uint32_t thread)
{
    tbr *gpu = context;
    for (;;) {
        const uint32_t row = atomic_fetch_add(&gpu->next_row, 1);
        if (row >= gpu->tiles_y)
            return;
        for (uint32_t x = 0; x < gpu->tiles_x; x++)
            tile_run(gpu, &gpu->threads[thread], row * gpu->tiles_x + x);
    }
}

static void tell_binned(const tbr *gpu)
{
    const tbr_geometry geometry = {
        .frame = gpu->frame,
        .primitive_count = gpu->primitive_count,
        .pair_counts = gpu->pair_counts,
        .primitive_draw = gpu->primitive_draw,
        .draw_is_prepassed = gpu->draw_is_prepassed,
        .pair_is_signed = tbr_has(gpu, FM_PART_SIGNATURES) ? gpu->pair_is_signed : NULL,
    };
    if (gpu->desc.binned != NULL)
        gpu->desc.binned(gpu->desc.context, &geometry, &gpu->counters);
}

static void swap_buffers(tbr *gpu)
{
    uint32_t *image = gpu->image;
    tbr_memory *memory = gpu->memory;
    if (!tbr_has(gpu, FM_PART_TWO_BUFFERS))
        return;
    gpu->image = gpu->other_image;
    gpu->memory = gpu->other_memory;
    gpu->other_image = image;
    gpu->other_memory = memory;
}

/* Of several threads the one with the lowest tile speaks. */
static fm_status judge_hooks(const tbr *gpu, fm_error *err)
{
    const tbr_thread *wrong = NULL;
    for (uint32_t i = 0; i < gpu->desc.threads; i++)
        if (gpu->threads[i].is_wrong &&
            (wrong == NULL || gpu->threads[i].wrong_tile < wrong->wrong_tile))
            wrong = &gpu->threads[i];
    if (wrong == NULL)
        return FM_OK;
    return fm_fail(err, FM_INVALID, "technique: tile_end: %s: %u in tile %u, no such value",
                   wrong->wrong_field, wrong->wrong_value, wrong->wrong_tile);
}

fm_status tbr_frame(tbr *gpu, const fm_frame *frame, fm_error *err)
{
    bool failed = false;
    swap_buffers(gpu);
    gpu->frame = frame;
    gpu->counters = (tbr_counters){ 0 };
    const fm_status status = bin_frame(gpu, err);
    if (status != FM_OK)
        return status;
    tell_binned(gpu);
    for (uint32_t i = 0; i < gpu->desc.threads; i++)
        gpu->threads[i].counters = (tbr_counters){ 0 };
    atomic_store(&gpu->next_row, 0);
    pool_run(gpu->pool, raster_work, gpu);
    for (uint32_t i = 0; i < gpu->desc.threads; i++) {
        counters_add(&gpu->counters, &gpu->threads[i].counters);
        failed = failed || gpu->threads[i].failed;
    }
    gpu->frame_index++;
    const fm_status status_of_hooks = judge_hooks(gpu, err);
    if (status_of_hooks != FM_OK)
        return status_of_hooks;
    return failed ? fm_fail(err, FM_NO_MEMORY, "no memory for the work of a tile") : FM_OK;
}

const uint32_t *tbr_image(const tbr *gpu)
{
    return gpu->image;
}

const tbr_counters *tbr_counts(const tbr *gpu)
{
    return &gpu->counters;
}

uint32_t tbr_tile_count(const tbr *gpu)
{
    return gpu->tile_count;
}

uint32_t tbr_tiles_across(const tbr *gpu)
{
    return gpu->tiles_x;
}

uint32_t tbr_thread_count(const tbr *gpu)
{
    return gpu->desc.threads;
}

tbr_tile_info tbr_tile(const tbr *gpu, uint32_t tile)
{
    return (tbr_tile_info){ .is_skipped = gpu->bins[tile].is_skipped,
                            .signature_valid = gpu->memory[tile].signature_valid,
                            .signature = gpu->bins[tile].signature,
                            .fvp = gpu->memory[tile].fvp };
}

uint32_t tbr_list(const tbr *gpu, uint32_t tile, tbr_list_entry *entries, uint32_t room)
{
    uint32_t count = 0;
    for (uint32_t i = gpu->bins[tile].first.head; i != TBR_NO_ENTRY; i = gpu->entries[i].next) {
        const tbr_entry *entry = &gpu->entries[i];
        if (count < room)
            entries[count] = (tbr_list_entry){ entry->primitive, entry->draw, entry->layer,
                                               (fm_prediction)entry->prediction, entry->is_signed };
        count++;
    }
    return count;
}
