/* One tile in the raster phase.
 *
 * FM_PART_FINAL_DEPTH and FM_PART_PREPASS put depths into the buffer before the primitives that own
 * them are drawn. They lie half a step behind the true ones, so that the owner still passes,
 * whether it tests for LESS or LEQUAL, and so that of equal depths that one wins which wins
 * without. Whatever fails against such a depth and passed without it is covered by the owner later
 * on. That is no longer so where a primitive between them blends, tests the other way round, or
 * clears: there a new stretch of the list begins. */
#include <stdlib.h>
#include <string.h>

#include "internal.h"

/* A tile as it is drawn. */
typedef struct tile_state {
    tbr *gpu;
    tbr_thread *thread;
    tbr_counters counters;
    uint32_t tile;
    int32_t x, y, width, height; /* px: first pixel, size on the screen */
    uint32_t zr;
    bool unsigned_passed, met_taint, depth_cleared;
    uint32_t unsigned_layer; /* highest of an unsigned fragment that passed */
    uint32_t work_count;
} tile_state;

/* Bits of 16, in arithmetic that loops over rows can be vectors of; a processor's own instruction
 * is not in what we are built for. */
static inline uint32_t count_bits(uint32_t bits)
{
    bits -= bits >> 1 & 0x5555u;
    bits = (bits & 0x3333u) + (bits >> 2 & 0x3333u);
    bits = (bits + (bits >> 4)) & 0x0F0Fu;
    return (bits + (bits >> 8)) & 31u;
}

static uint32_t count_fragments(const uint16_t rows[FM_TILE_SIDE])
{
    uint32_t sum = 0;
    for (int y = 0; y < FM_TILE_SIDE; y++)
        sum += count_bits(rows[y]);
    return sum;
}

static uint32_t count_quads(const uint16_t rows[FM_TILE_SIDE])
{
    uint32_t sum = 0, pairs[FM_TILE_SIDE / 2];
    memcpy(pairs, rows, sizeof pairs); /* two rows in each */
    for (int i = 0; i < FM_TILE_SIDE / 2; i++) {
        const uint32_t either = pairs[i] | pairs[i] >> 16;
        sum += count_bits((either | either >> 1) & 0x5555u);
    }
    return sum;
}

static void clear_depth(tile_state *tile, uint32_t depth)
{
    tbr_buffers *buffers = &tile->thread->buffers;
    for (int i = 0; i < FM_TILE_PIXELS; i++)
        buffers->depth[i] = 2 * depth;
    memset(buffers->owner, 0, sizeof buffers->owner);
    memset(buffers->is_tainted, 0, sizeof buffers->is_tainted);
}

static void clear_tile(tile_state *tile)
{
    tbr_buffers *buffers = &tile->thread->buffers;
    for (int i = 0; i < FM_TILE_PIXELS; i++)
        buffers->colour[i] = tile->gpu->frame->clear_colour;
    clear_depth(tile, tile->gpu->frame->clear_depth);
    memset(buffers->layer, 0, sizeof buffers->layer);
    memset(buffers->is_woz, 0, sizeof buffers->is_woz);
}

/* ---- one entry ---- */

static int32_t clamp(int32_t value, int32_t low, int32_t high)
{
    return value < low ? low : value > high ? high : value;
}

/* An edge that all pixels of the tile are inside of stays zero, which is inside; of any other the
 * values in the tile fit 32 bits, since setup_overlaps found both signs. */
static void place_edges(tbr_span *span, const tbr_setup *setup, const tile_state *tile)
{
    const int64_t last = FM_TILE_SIDE - 1;
    for (int i = 0; i < 3; i++) {
        const tbr_edge *edge = &setup->edges[i];
        const int64_t e = edge->c + (int64_t)edge->a * tile->x + (int64_t)edge->b * tile->y;
        const int64_t least =
            e + (edge->a < 0 ? edge->a * last : 0) + (edge->b < 0 ? edge->b * last : 0);
        if (least >= 0)
            continue;
        span->edges[i].e = (int32_t)e;
        span->edges[i].a = edge->a;
        span->edges[i].b = edge->b;
    }
}

static uint32_t plane_at(const tbr_plane *plane, const tile_state *tile)
{
    return plane->base + (uint32_t)tile->x * plane->gx + (uint32_t)tile->y * plane->gy;
}

static tbr_span make_span(const tile_state *tile, const tbr_entry *entry)
{
    const tbr *gpu = tile->gpu;
    const tbr_setup *setup = &gpu->setups[entry->primitive];
    const tbr_draw *ready = &gpu->draws[entry->draw];
    const fm_draw_call *draw = &gpu->frame->draws[entry->draw];
    tbr_span span = {
        .z = { plane_at(&setup->z, tile), setup->z.gx, setup->z.gy },
        .u = { plane_at(&setup->u, tile), setup->u.gx, setup->u.gy },
        .v = { plane_at(&setup->v, tile), setup->v.gx, setup->v.gy },
        .y0 = clamp(setup->y0 - tile->y, 0, tile->height),
        .y1 = clamp(setup->y1 - tile->y, 0, tile->height),
        .width = tile->width,
        .z_min = (int32_t)setup->z_min,
        .z_max = (int32_t)setup->z_max,
        .draw = draw,
        .digest = ready->digest,
        .writes_depth = ready->writes_depth,
        .late_test = (draw->flags & (FM_DRAW_DISCARD | FM_DRAW_SHADER_DEPTH)) != 0,
        .tracks_layers = gpu->tracks_layers,
        .tracks_owner = gpu->tracks_layers && tbr_has(gpu, FM_PART_OWNER),
        .tracks_taint = tbr_has(gpu, FM_PART_TAINT),
        .tracks_order = tbr_has(gpu, FM_PART_EXACT_TIES),
        .exact_ties = tbr_has(gpu, FM_PART_EXACT_TIES) && ready->type == FM_TYPE_WOZ,
        .is_signed = entry->is_signed,
        .layer = entry->layer,
        .order = entry->primitive - ready->binned_first + ready->submitted_first + 1,
    };
    place_edges(&span, setup, tile);
    return span;
}

static void add_work(tile_state *tile, const tbr_work *work)
{
    tbr_thread *thread = tile->thread;
    if (tile->work_count == thread->work_room) {
        const uint32_t room = thread->work_room > 0 ? 2 * thread->work_room : 256;
        void *grown = reallocarray(thread->work, room, sizeof *thread->work);
        thread->failed = thread->failed || grown == NULL;
        if (grown == NULL)
            return;
        thread->work = grown;
        thread->work_room = room;
    }
    thread->work[tile->work_count++] = *work;
}

/* What every entry costs before its first quad, and its rasterised quads. */
static uint32_t count_raster(tile_state *tile, const tbr_entry *entry,
                             const tbr_span_result *result)
{
    tbr_counters *count = &tile->counters;
    const fm_draw_call *draw = &tile->gpu->frame->draws[entry->draw];
    const uint32_t quads = count_quads(result->covered);
    count->entries_read++;
    count->read_bytes += draw->attribute_bytes + TBR_POINTER_BYTES +
                         (tile->gpu->tracks_layers ? TBR_LAYER_BYTES : 0u);
    count->quads_rasterised += quads;
    count->fragments_rasterised += count_fragments(result->covered);
    return quads;
}

static void count_pixels(tile_state *tile, const tbr_entry *entry, const tbr_span_result *result,
                         uint32_t shaded)
{
    tbr_counters *count = &tile->counters;
    const tbr_draw *ready = &tile->gpu->draws[entry->draw];
    const fm_draw_call *draw = &tile->gpu->frame->draws[entry->draw];
    const uint64_t fragments = count_fragments(result->shaded);
    const uint64_t passed = count_quads(result->passed);
    count->quads_shaded += shaded;
    count->fragments_shaded += fragments;
    count->fragment_instructions_run += 4ull * shaded * draw->fragment_instructions;
    count->texture_bytes16 += fragments * draw->texture_bytes16;
    count->depth_quad_writes += ready->writes_depth ? passed : 0;
    count->colour_quad_writes += draw->mask != 0 ? passed : 0;
    if (draw->mix != FM_MIX_OFF) {
        count->colour_quad_reads += passed;
        count->fragments_blended += count_fragments(result->passed);
    }
    if (tile->gpu->tracks_layers && draw->mask == 15 && draw->mix != FM_MIX_ADD &&
        (draw->mix == FM_MIX_OFF || draw->alpha == 255 ||
         (draw->flags & FM_DRAW_TEXTURED_ALPHA) != 0))
        count->layer_quad_writes += passed;
}

/* What the end of the tile has to know. */
static void note_passed(tile_state *tile, const tbr_entry *entry, const tbr_span_result *result)
{
    uint32_t passed = 0;
    for (int y = 0; y < FM_TILE_SIDE; y++)
        passed |= result->passed[y];
    tile->met_taint = tile->met_taint || result->failed_tainted != 0;
    if (passed == 0)
        return;
    if (tile->gpu->draws[entry->draw].writes_depth)
        tile->zr = entry->layer;
    if (entry->prediction != FM_VISIBLE)
        tile->counters.hidden_but_seen++;
    if (!entry->is_signed) {
        tile->unsigned_layer = tile->unsigned_passed && tile->unsigned_layer > entry->layer
                                   ? tile->unsigned_layer
                                   : entry->layer;
        tile->unsigned_passed = true;
    }
}

static void draw_entry(tile_state *tile, const tbr_entry *entry)
{
    tbr_span_result result;
    const tbr_span span = make_span(tile, entry);
    tile->gpu->span(&tile->thread->buffers, &result, &span);
    const uint32_t quads = count_raster(tile, entry, &result);
    const uint32_t shaded = count_quads(result.shaded);
    tile->counters.scalar_quads += (uint64_t)quads * span.draw->scalars;
    tile->counters.depth_quad_reads += span.draw->depth_test == FM_COMPARE_OFF ? 0
                                       : span.late_test                        ? shaded
                                                                               : quads;
    count_pixels(tile, entry, &result, shaded);
    note_passed(tile, entry, &result);
    if (tile->gpu->desc.rendered != NULL)
        add_work(tile, &(tbr_work){ entry->draw, (uint8_t)quads, (uint8_t)shaded, false });
}

static void draw_depth(tile_state *tile, const tbr_entry *entry)
{
    tbr_span_result result;
    tbr_span span = make_span(tile, entry);
    span.mode = SPAN_DEPTH;
    tile->gpu->span(&tile->thread->buffers, &result, &span);
    if (tbr_has(tile->gpu, FM_PART_FINAL_DEPTH))
        return; /* an oracle's knowledge is free */
    const uint32_t quads = count_raster(tile, entry, &result);
    tile->counters.quads_prepassed += quads;
    tile->counters.scalar_quads += quads; /* z alone */
    tile->counters.depth_quad_reads += quads;
    tile->counters.depth_quad_writes += count_quads(result.passed);
    if (tile->gpu->desc.rendered != NULL)
        add_work(tile, &(tbr_work){ entry->draw, (uint8_t)quads, 0, true });
}

/* ---- the list ---- */

/* Depths of the stretch of the list that begins here. */
static void draw_stretch_depths(tile_state *tile, uint32_t from)
{
    const tbr *gpu = tile->gpu;
    const bool skips_discard = !tbr_has(gpu, FM_PART_FINAL_DEPTH);
    for (uint32_t i = from; i != TBR_NO_ENTRY; i = gpu->entries[i].next) {
        const tbr_entry *entry = &gpu->entries[i];
        if (gpu->draws[entry->draw].delimits)
            return;
        if (gpu->draws[entry->draw].type != FM_TYPE_WOZ)
            continue;
        if (!skips_discard || (gpu->frame->draws[entry->draw].flags & FM_DRAW_DISCARD) == 0)
            draw_depth(tile, entry);
    }
}

static void draw_list(tile_state *tile)
{
    const tbr *gpu = tile->gpu;
    const bool knows_depths = tbr_has(gpu, FM_PART_FINAL_DEPTH | FM_PART_PREPASS);
    bool is_new_stretch = true;
    for (uint32_t i = gpu->bins[tile->tile].first.head; i != TBR_NO_ENTRY;
         i = gpu->entries[i].next) {
        const tbr_entry *entry = &gpu->entries[i];
        const bool delimits = gpu->draws[entry->draw].delimits;
        if (knows_depths && is_new_stretch && !delimits)
            draw_stretch_depths(tile, i);
        is_new_stretch = delimits;
        if (entry->primitive == TBR_CLEAR)
            clear_depth(tile, gpu->frame->draws[entry->draw].clear_depth);
        else
            draw_entry(tile, entry);
        tile->depth_cleared = tile->depth_cleared || entry->primitive == TBR_CLEAR;
    }
}

/* ---- the end ---- */

static void scan_visibility(fm_tile_end *end, const tile_state *tile)
{
    const tbr_buffers *buffers = &tile->thread->buffers;
    uint32_t least = UINT32_MAX, most = 0;
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++) {
            const int32_t i = y * FM_TILE_SIDE + x;
            least = buffers->layer[i] < least ? buffers->layer[i] : least;
            most = buffers->depth[i] > most ? buffers->depth[i] : most;
        }
    end->depth_far = most;
    end->layer_far = tile->gpu->tracks_layers ? least : 1;
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++) {
            const int32_t i = y * FM_TILE_SIDE + x;
            end->far_is_woz |= buffers->layer[i] == least && buffers->is_woz[i] != 0;
        }
    end->far_is_woz = tile->gpu->tracks_layers ? end->far_is_woz : tile->zr != TBR_NO_ZR;
}

static bool equals_image(const tile_state *tile)
{
    const tbr *gpu = tile->gpu;
    if (!tbr_has_previous(gpu))
        return false;
    for (int32_t y = 0; y < tile->height; y++) {
        const size_t row = (size_t)(tile->y + y) * gpu->desc.width_px + (size_t)tile->x;
        if (memcmp(&gpu->image[row], &tile->thread->buffers.colour[y * FM_TILE_SIDE],
                   (size_t)tile->width * 4) != 0)
            return false;
    }
    return true;
}

static void flush(tile_state *tile)
{
    tbr *gpu = tile->gpu;
    for (int32_t y = 0; y < tile->height; y++) {
        const size_t row = (size_t)(tile->y + y) * gpu->desc.width_px + (size_t)tile->x;
        memcpy(&gpu->image[row], &tile->thread->buffers.colour[y * FM_TILE_SIDE],
               (size_t)tile->width * 4);
    }
    tile->counters.flush_bytes += (uint64_t)(4 * tile->width * tile->height);
}

/* A bool that a hook filled: whatever byte lies there. */
static unsigned byte_of(const bool *filled)
{
    unsigned char byte;
    memcpy(&byte, filled, sizeof byte);
    return byte;
}

/* What a hook filled with no value of its type becomes the default, and the frame is refused. */
static void check_end(tile_state *tile, fm_tile_end *end)
{
    tbr_thread *thread = tile->thread;
    const fm_tile_end usual = { .fvp = FM_FVP_UNKNOWN, .signature_valid = true };
    const struct {
        const char *field;
        unsigned value, largest;
    } filled[] = { { "outcome", end->outcome, FM_TILE_FORESEEN },
                   { "signature_valid", byte_of(&end->signature_valid), 1 },
                   { "fvp.is_layer", byte_of(&end->fvp.is_layer), 1 } };
    for (size_t i = 0; i < sizeof filled / sizeof filled[0]; i++) {
        if (filled[i].value <= filled[i].largest)
            continue;
        if (!thread->is_wrong) {
            thread->is_wrong = true;
            thread->wrong_tile = tile->tile;
            thread->wrong_field = filled[i].field;
            thread->wrong_value = filled[i].value;
        }
        *end = usual;
        return;
    }
}

static fm_tile_end end_tile(tile_state *tile)
{
    const tbr *gpu = tile->gpu;
    fm_tile_end end = { .parts = gpu->desc.parts,
                        .zr = tile->zr,
                        .depth_cleared = tile->depth_cleared,
                        .bits = gpu->bins[tile->tile].bits,
                        .fvp = FM_FVP_UNKNOWN,
                        .signature_valid = true };
    if (tbr_has(gpu, FM_PART_VISIBILITY))
        scan_visibility(&end, tile);
    if (tbr_has(gpu, FM_PART_TAINT))
        end.unsafe =
            tile->met_taint || (tile->unsigned_passed && tile->unsigned_layer >= end.layer_far);
    if (tbr_has(gpu, FM_PART_PREVIOUS_COLOUR))
        end.is_equal = equals_image(tile);
    if (gpu->technique.tile_end == NULL)
        return end;
    hook_enter(gpu->desc.mark, FM_HOOK_TILE_END);
    gpu->technique.tile_end(&end);
    hook_leave(gpu->desc.mark, FM_HOOK_TILE_END);
    check_end(tile, &end);
    return end;
}

static void remember(tile_state *tile, const fm_tile_end *end)
{
    tbr_memory *memory = &tile->gpu->memory[tile->tile];
    if (tbr_has(tile->gpu, FM_PART_VISIBILITY)) {
        tile->counters.visibility_scans++;
        tile->counters.fvp_writes++;
        tile->counters.fvp_changes +=
            memory->fvp.is_layer != end->fvp.is_layer || memory->fvp.value != end->fvp.value;
    }
    memory->fvp = end->fvp;
    memory->signature_valid = end->signature_valid;
}

static void render(tile_state *tile)
{
    clear_tile(tile);
    draw_list(tile);
    const fm_tile_end end = end_tile(tile);
    if (end.outcome == FM_TILE_FORESEEN) {
        tile->counters = (tbr_counters){ .tiles_skipped = 1 };
        tile->gpu->bins[tile->tile].is_skipped = true;
        return;
    }
    tile->counters.tiles_rendered++;
    tile->counters.tiles_kept += end.outcome == FM_TILE_KEPT;
    if (end.outcome == FM_TILE_FLUSHED)
        flush(tile);
    remember(tile, &end);
    if (tile->gpu->desc.rendered == NULL || tile->thread->failed)
        return;
    const tbr_tile_work work = { .tile = tile->tile,
                                 .frame = tile->gpu->frame,
                                 .work = tile->thread->work,
                                 .count = tile->work_count,
                                 .flush_bytes = (uint32_t)tile->counters.flush_bytes,
                                 .scans = tbr_has(tile->gpu, FM_PART_VISIBILITY) };
    tile->gpu->desc.rendered(tile->gpu->desc.context, &work);
}

static bool keeps_colours(tile_state *tile)
{
    const tbr *gpu = tile->gpu;
    const tbr_memory *memory = &gpu->memory[tile->tile];
    const fm_tile_start start = { .signature = gpu->bins[tile->tile].signature,
                                  .previous = memory->signature,
                                  .previous_valid = memory->signature_valid,
                                  .has_uploads = gpu->has_uploads,
                                  .bits = gpu->bins[tile->tile].bits };
    if (gpu->technique.skip == NULL || !tbr_has(gpu, FM_PART_SIGNATURES))
        return false;
    tile->counters.signature_compares++;
    if (!tbr_has_previous(gpu))
        return false;
    hook_enter(gpu->desc.mark, FM_HOOK_SKIP);
    const bool is_skipped = gpu->technique.skip(&start);
    hook_leave(gpu->desc.mark, FM_HOOK_SKIP);
    return is_skipped;
}

void tile_run(tbr *gpu, tbr_thread *thread, uint32_t index)
{
    const int32_t side = FM_TILE_SIDE;
    tile_state tile = { .gpu = gpu, .thread = thread, .tile = index, .zr = TBR_NO_ZR };
    tile.x = (int32_t)(index % gpu->tiles_x) * side;
    tile.y = (int32_t)(index / gpu->tiles_x) * side;
    tile.width = clamp((int32_t)gpu->desc.width_px - tile.x, 0, side);
    tile.height = clamp((int32_t)gpu->desc.height_px - tile.y, 0, side);
    if (keeps_colours(&tile)) {
        tile.counters.tiles_skipped++;
        gpu->bins[index].is_skipped = true;
    } else {
        render(&tile);
    }
    gpu->memory[index].signature = gpu->bins[index].signature;
    counters_add(&thread->counters, &tile.counters);
}
