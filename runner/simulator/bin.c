#include <stdlib.h>
#include <string.h>

#include "internal.h"

#define NO_COMMAND ((1u << TBR_COMMAND_BITS) - 1)

fm_primitive_type tbr_type(const fm_draw_call *draw, uint32_t parts)
{
    const bool less =
        draw->depth_test == FM_COMPARE_LESS || draw->depth_test == FM_COMPARE_LESS_EQUAL;
    if ((draw->flags & FM_DRAW_DEPTH_WRITE) == 0 || draw->depth_test == FM_COMPARE_OFF)
        return FM_TYPE_NWOZ;
    if ((parts & FM_PART_PAPER_TYPES) != 0)
        return FM_TYPE_WOZ;
    if ((draw->flags & FM_DRAW_SHADER_DEPTH) != 0)
        return FM_TYPE_SHADER_DEPTH;
    if (!less || draw->mix != FM_MIX_OFF || draw->mask != 15 ||
        (draw->flags & FM_DRAW_STENCIL) != 0)
        return FM_TYPE_BARRIER;
    return FM_TYPE_WOZ;
}

static bool grow(void **items, uint32_t wanted, uint32_t room, size_t bytes)
{
    void *grown = wanted <= room ? *items : reallocarray(*items, wanted, bytes);
    if (grown != NULL)
        *items = grown;
    return grown != NULL;
}

static uint32_t state_crc(const tbr *gpu, const fm_draw_call *draw)
{
    const uint32_t words[] = { draw->flags,           (uint32_t)draw->depth_test,
                               (uint32_t)draw->mix,   draw->mask,
                               draw->alpha,           draw->shader,
                               draw->uniforms,        draw->texture,
                               draw->texture_version, draw->clear_depth };
    _Static_assert(sizeof words == TBR_STATE_BYTES, "as shift_state expects");
    return crc_of(&gpu->crc, words, sizeof words);
}

static bool delimits(const fm_draw_call *draw)
{
    switch (draw->depth_test) {
    case FM_COMPARE_GREATER:
    case FM_COMPARE_GREATER_EQUAL:
    case FM_COMPARE_NOT_EQUAL:
        return true;
    case FM_COMPARE_OFF:
    case FM_COMPARE_NEVER:
    case FM_COMPARE_LESS:
    case FM_COMPARE_EQUAL:
    case FM_COMPARE_LESS_EQUAL:
    case FM_COMPARE_ALWAYS:
    case FM_COMPARE_COUNT:
        break;
    }
    const fm_primitive_type type = tbr_type(draw, 0);
    return type == FM_TYPE_BARRIER || type == FM_TYPE_SHADER_DEPTH;
}

static fm_status make_draw_room(tbr *gpu, fm_error *err)
{
    void *draws = gpu->draws, *prepassed = gpu->draw_is_prepassed;
    void *may_move = gpu->draw_may_move, *order = gpu->draw_order;
    const uint32_t wanted = gpu->frame->draw_count + 1;
    bool is_whole = grow(&draws, wanted, gpu->draw_room, sizeof *gpu->draws);
    gpu->draws = draws;
    is_whole = is_whole && grow(&prepassed, wanted, gpu->draw_room, sizeof(bool));
    gpu->draw_is_prepassed = prepassed;
    is_whole = is_whole && grow(&may_move, wanted, gpu->draw_room, sizeof(bool));
    gpu->draw_may_move = may_move;
    is_whole = is_whole && grow(&order, wanted, gpu->draw_room, sizeof *gpu->draw_order);
    gpu->draw_order = order;
    if (!is_whole)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %u draw calls", wanted - 1);
    if (gpu->draw_room < wanted)
        gpu->draw_room = wanted;
    return FM_OK;
}

static void prepare_draw(tbr *gpu, uint32_t index, uint32_t submitted_first)
{
    const fm_draw_call *draw = &gpu->frame->draws[index];
    const bool is_clear = (draw->flags & FM_DRAW_DEPTH_CLEAR) != 0;
    gpu->draws[index] = (tbr_draw){
        .type = tbr_type(draw, gpu->desc.parts),
        .tests_depth = draw->depth_test != FM_COMPARE_OFF,
        .writes_depth =
            draw->depth_test != FM_COMPARE_OFF && (draw->flags & FM_DRAW_DEPTH_WRITE) != 0,
        .delimits = is_clear || delimits(draw),
        .digest = draw_digest(draw),
        .state_crc = tbr_has(gpu, FM_PART_SIGNATURES) ? state_crc(gpu, draw) : 0,
        .submitted_first = submitted_first,
    };
    const bool is_woz = !is_clear && gpu->draws[index].type == FM_TYPE_WOZ;
    gpu->draw_is_prepassed[index] =
        tbr_has(gpu, FM_PART_PREPASS) && is_woz && (draw->flags & FM_DRAW_DISCARD) == 0;
    gpu->draw_may_move[index] = is_woz;
    gpu->draw_order[index] = index;
    gpu->tracks_layers = gpu->tracks_layers || !is_woz;
}

static fm_status prepare_draws(tbr *gpu, fm_error *err)
{
    const fm_frame *frame = gpu->frame;
    uint32_t submitted_first = 0;
    fm_status status = make_draw_room(gpu, err);
    if (status != FM_OK)
        return status;
    gpu->tracks_layers = gpu->desc.keep_layers || 2 * frame->clear_depth != FM_DEPTH_FARTHEST;
    for (uint32_t i = 0; i < frame->draw_count; i++) {
        prepare_draw(gpu, i, submitted_first);
        submitted_first += frame->draws[i].count;
    }
    gpu->tracks_layers = gpu->tracks_layers && tbr_has(gpu, FM_PART_VISIBILITY);
    if (tbr_has(gpu, FM_PART_OBJECT_ORDER))
        status = history_order(gpu->draw_order, gpu->history, frame, gpu->draw_may_move, err);
    if (status == FM_OK && tbr_has(gpu, FM_PART_UPLOADS))
        status = history_uploads(&gpu->has_uploads, gpu->history, frame, err);
    return status;
}

static void reset_bins(tbr *gpu)
{
    const uint32_t clear[2] = { gpu->frame->clear_colour, gpu->frame->clear_depth };
    const tbr_bin empty = {
        .first = { TBR_NO_ENTRY, TBR_NO_ENTRY },
        .second = { TBR_NO_ENTRY, TBR_NO_ENTRY },
        .signature = tbr_has(gpu, FM_PART_SIGNATURES) ? crc_of(&gpu->crc, clear, sizeof clear) : 0,
        .signed_draw = TBR_NO_ENTRY,
        .command = NO_COMMAND,
        .layer = gpu->tracks_layers ? 0 : 1,
    };
    for (uint32_t i = 0; i < gpu->tile_count; i++)
        gpu->bins[i] = empty;
    gpu->primitive_count = 0;
    gpu->entry_count = 0;
    gpu->pair_count = 0;
}

/* ---- one pair ---- */

/* The layer of a primitive in a tile: commands that do not write depth are one each, others share
 * one until such a command comes between. Layers that are full merge, and numbers of commands wrap:
 * fewer are then farther than any. */
static void number_layer(tbr_bin *bin, uint32_t draw, bool is_woz)
{
    const uint16_t command = (uint16_t)(draw % NO_COMMAND);
    if (bin->command == command)
        return;
    if ((!is_woz || !bin->last_is_woz) && bin->layer < TBR_MAX_LAYER)
        bin->layer++;
    bin->command = command;
    bin->last_is_woz = is_woz;
}

static void append(tbr *gpu, tbr_chain *chain, uint32_t entry)
{
    if (chain->head == TBR_NO_ENTRY)
        chain->head = entry;
    else
        gpu->entries[chain->tail].next = entry;
    chain->tail = entry;
}

static void splice(tbr *gpu, tbr_chain *first, tbr_chain *second)
{
    if (second->head == TBR_NO_ENTRY)
        return;
    if (first->head == TBR_NO_ENTRY)
        first->head = second->head;
    else
        gpu->entries[first->tail].next = second->head;
    first->tail = second->tail;
    *second = (tbr_chain){ TBR_NO_ENTRY, TBR_NO_ENTRY };
}

static void place(tbr *gpu, tbr_bin *bin, fm_place where, uint32_t entry)
{
    switch (where) {
    case FM_PLACE_FIRST:
        append(gpu, &bin->first, entry);
        return;
    case FM_PLACE_SECOND:
        append(gpu, &bin->second, entry);
        return;
    case FM_PLACE_BARRIER:
        splice(gpu, &bin->first, &bin->second);
        append(gpu, &bin->first, entry);
        return;
    }
}

static void sign_state(tbr *gpu, tbr_bin *bin, uint32_t draw)
{
    if (bin->signed_draw == draw)
        return;
    bin->signed_draw = draw;
    bin->signature = crc_combine(&gpu->shift_state, bin->signature, gpu->draws[draw].state_crc);
}

static fm_status make_entry_room(tbr *gpu, fm_error *err)
{
    if (gpu->entry_count < gpu->entry_room)
        return FM_OK;
    const uint32_t wanted = gpu->entry_room > 0 ? 2 * gpu->entry_room : 4096;
    void *entries = gpu->entries, *is_signed = gpu->pair_is_signed;
    bool is_whole =
        wanted > gpu->entry_room && grow(&entries, wanted, gpu->entry_room, sizeof *gpu->entries);
    gpu->entries = entries;
    is_whole = is_whole && grow(&is_signed, wanted, gpu->entry_room, 1);
    gpu->pair_is_signed = is_signed;
    if (!is_whole)
        return fm_fail(err, FM_NO_MEMORY, "no memory for lists of %u entries", wanted);
    gpu->entry_room = wanted;
    return FM_OK;
}

static fm_status no_answer(const char *hook, unsigned value, uint32_t tile, fm_error *err)
{
    return fm_fail(err, FM_INVALID, "technique: %s: answered %u in tile %u, no such value", hook,
                   value, tile);
}

/* What hooks answered of a pair. */
typedef struct pair_answers {
    fm_prediction prediction;
    fm_place place;
    bool is_signed;
} pair_answers;

static fm_prediction predict(tbr *gpu, const fm_pair *pair)
{
    if (gpu->technique.predict == NULL)
        return FM_VISIBLE;
    hook_enter(gpu->desc.mark, FM_HOOK_PREDICT);
    const fm_prediction prediction = gpu->technique.predict(pair);
    hook_leave(gpu->desc.mark, FM_HOOK_PREDICT);
    gpu->counters.fvp_reads++;
    gpu->counters.hidden_by_layer += prediction == FM_HIDDEN_BY_LAYER;
    gpu->counters.hidden_by_depth += prediction == FM_HIDDEN_BY_DEPTH;
    return prediction;
}

static bool sign(tbr *gpu, tbr_bin *bin, const fm_pair *pair, fm_prediction prediction)
{
    if (!tbr_has(gpu, FM_PART_SIGNATURES) || gpu->technique.sign == NULL)
        return true;
    hook_enter(gpu->desc.mark, FM_HOOK_SIGN);
    const bool is_signed = gpu->technique.sign(&bin->bits, pair, prediction);
    hook_leave(gpu->desc.mark, FM_HOOK_SIGN);
    return is_signed;
}

static fm_place ask_place(const tbr *gpu, const fm_pair *pair, fm_prediction prediction)
{
    if (gpu->technique.place == NULL)
        return FM_PLACE_FIRST;
    hook_enter(gpu->desc.mark, FM_HOOK_PLACE);
    const fm_place answer = gpu->technique.place(pair, prediction);
    hook_leave(gpu->desc.mark, FM_HOOK_PLACE);
    return answer;
}

/* Hooks see a copy; one that writes to it changes nothing, and is refused. */
static fm_status ask_hooks(pair_answers *answers, tbr *gpu, uint32_t tile, const fm_pair *pair,
                           fm_error *err)
{
    fm_pair shown;
    memcpy(&shown, pair, sizeof shown);
    answers->prediction = predict(gpu, &shown);
    answers->is_signed = sign(gpu, &gpu->bins[tile], &shown, answers->prediction);
    answers->place = ask_place(gpu, &shown, answers->prediction);
    if ((unsigned)answers->prediction > FM_HIDDEN_BY_DEPTH)
        return no_answer("predict", answers->prediction, tile, err);
    if ((unsigned)answers->place > FM_PLACE_BARRIER)
        return no_answer("place", answers->place, tile, err);
    if (answers->place == FM_PLACE_SECOND && pair->type != FM_TYPE_WOZ)
        return fm_fail(err, FM_INVALID,
                       "technique: place: answered FM_PLACE_SECOND (%u) in tile %u for a pair of "
                       "another type than FM_TYPE_WOZ",
                       (unsigned)answers->place, tile);
    if (memcmp(&shown, pair, sizeof shown) != 0)
        return fm_fail(err, FM_INVALID,
                       "technique: a hook wrote to the pair in tile %u, which is constant", tile);
    return FM_OK;
}

/* The pair of the primitive that was set up last with a tile. */
static fm_status bin_pair(tbr *gpu, uint32_t tile, uint32_t primitive_crc, fm_error *err)
{
    const uint32_t primitive = gpu->primitive_count - 1, draw = gpu->primitive_draw[primitive];
    const tbr_draw *ready = &gpu->draws[draw];
    tbr_bin *bin = &gpu->bins[tile];
    pair_answers answers;
    fm_status status = make_entry_room(gpu, err);
    if (status != FM_OK)
        return status;
    if (gpu->tracks_layers)
        number_layer(bin, draw, ready->type == FM_TYPE_WOZ);
    const fm_pair pair = {
        .type = ready->type,
        .depth_test = ready->tests_depth,
        .layer = tbr_has(gpu, FM_PART_VISIBILITY) ? bin->layer : 0,
        .depth_near = 2 * gpu->setups[primitive].z_min,
        .fvp = gpu->memory[tile].fvp,
    };
    status = ask_hooks(&answers, gpu, tile, &pair, err);
    if (status != FM_OK)
        return status;
    const uint32_t entry = gpu->entry_count++;
    gpu->entries[entry] = (tbr_entry){ .primitive = primitive,
                                       .draw = draw,
                                       .next = TBR_NO_ENTRY,
                                       .layer = (uint16_t)pair.layer,
                                       .prediction = (uint8_t)answers.prediction,
                                       .is_signed = answers.is_signed };
    place(gpu, bin, answers.place, entry);
    gpu->pair_is_signed[gpu->pair_count++] = answers.is_signed;
    gpu->pair_counts[primitive]++;
    if (tbr_has(gpu, FM_PART_SIGNATURES) && answers.is_signed) {
        sign_state(gpu, bin, draw);
        bin->signature = crc_combine(&gpu->shift_primitive, bin->signature, primitive_crc);
        gpu->counters.signed_pairs++;
    }
    return FM_OK;
}

/* ---- draw calls ---- */

/* A depth clear is a barrier in every tile, and signed. */
static fm_status bin_clear(tbr *gpu, uint32_t draw, fm_error *err)
{
    for (uint32_t tile = 0; tile < gpu->tile_count; tile++) {
        tbr_bin *bin = &gpu->bins[tile];
        const fm_status status = make_entry_room(gpu, err);
        if (status != FM_OK)
            return status;
        const uint32_t entry = gpu->entry_count++;
        gpu->entries[entry] = (tbr_entry){
            .primitive = TBR_CLEAR, .draw = draw, .next = TBR_NO_ENTRY, .is_signed = true
        };
        place(gpu, bin, FM_PLACE_BARRIER, entry);
        if (tbr_has(gpu, FM_PART_SIGNATURES))
            sign_state(gpu, bin, draw);
    }
    return FM_OK;
}

static fm_status bin_primitive(tbr *gpu, const fm_triangle *triangle, fm_error *err)
{
    const tbr_setup *setup = &gpu->setups[gpu->primitive_count - 1];
    const int32_t side = FM_TILE_SIDE;
    fm_status status = FM_OK;
    const uint32_t crc =
        tbr_has(gpu, FM_PART_SIGNATURES) ? crc_of(&gpu->crc, triangle, sizeof *triangle) : 0;
    for (int32_t y = setup->y0 / side; y <= (setup->y1 - 1) / side; y++)
        for (int32_t x = setup->x0 / side; x <= (setup->x1 - 1) / side && status == FM_OK; x++)
            if (setup_overlaps(setup, x * side, y * side))
                status = bin_pair(gpu, (uint32_t)y * gpu->tiles_x + (uint32_t)x, crc, err);
    return status;
}

static void count_draw(tbr *gpu, const fm_draw_call *draw, bool is_prepassed)
{
    tbr_counters *count = &gpu->counters;
    const uint64_t times = is_prepassed ? 2 : 1;
    const uint64_t bytes = (uint64_t)draw->vertices * draw->vertex_bytes;
    const uint64_t instructions = (uint64_t)draw->vertices * draw->vertex_instructions;
    count->vertices += draw->vertices * times;
    count->vertex_lines += (bytes + TBR_LINE_BYTES - 1) / TBR_LINE_BYTES * times;
    /* Positions alone take about a third of a vertex shader. */
    count->vertex_instructions_run += instructions + (is_prepassed ? instructions / 3 : 0);
    count->primitives += draw->count * times;
}

static void count_primitive(tbr *gpu, const fm_draw_call *draw, bool is_prepassed)
{
    tbr_counters *count = &gpu->counters;
    const uint64_t pairs = gpu->pair_counts[gpu->primitive_count - 1];
    const uint64_t times = is_prepassed ? 2 : 1;
    if (pairs == 0)
        return;
    count->pairs += pairs * times;
    count->list_bytes += pairs * times * TBR_POINTER_BYTES;
    count->attribute_bytes += draw->attribute_bytes * times;
    if (gpu->tracks_layers) {
        count->layer_bytes += pairs * TBR_LAYER_BYTES;
        count->layer_lookups += pairs;
    }
    if (tbr_has(gpu, FM_PART_SIGNATURES))
        count->signed_bytes += draw->attribute_bytes;
}

static fm_status bin_draw(tbr *gpu, uint32_t index, fm_error *err)
{
    const fm_draw_call *draw = &gpu->frame->draws[index];
    const bool is_prepassed = gpu->draw_is_prepassed[index];
    fm_status status = FM_OK;
    gpu->draws[index].binned_first = gpu->primitive_count;
    count_draw(gpu, draw, is_prepassed);
    for (uint32_t i = 0; i < draw->count && status == FM_OK; i++) {
        const fm_triangle *triangle = &gpu->frame->triangles[draw->first + i];
        tbr_setup *setup = &gpu->setups[gpu->primitive_count];
        const bool is_seen =
            setup_triangle(setup, triangle, gpu->desc.width_px, gpu->desc.height_px);
        setup->draw = index;
        gpu->primitive_draw[gpu->primitive_count] = index;
        gpu->pair_counts[gpu->primitive_count++] = 0;
        if (!is_seen)
            continue;
        status = bin_primitive(gpu, triangle, err);
        count_primitive(gpu, draw, is_prepassed);
    }
    return status;
}

static fm_status make_primitive_room(tbr *gpu, fm_error *err)
{
    uint64_t wanted = 1;
    for (uint32_t i = 0; i < gpu->frame->draw_count; i++)
        wanted += gpu->frame->draws[i].count;
    if (wanted > UINT32_MAX / 2)
        return fm_fail(err, FM_INVALID, "%llu triangles in a frame: at most 2^31",
                       (unsigned long long)wanted);
    void *setups = gpu->setups, *draws = gpu->primitive_draw, *counts = gpu->pair_counts;
    bool is_whole = grow(&setups, (uint32_t)wanted, gpu->primitive_room, sizeof *gpu->setups);
    gpu->setups = setups;
    is_whole = is_whole &&
               grow(&draws, (uint32_t)wanted, gpu->primitive_room, sizeof *gpu->primitive_draw);
    gpu->primitive_draw = draws;
    is_whole =
        is_whole && grow(&counts, (uint32_t)wanted, gpu->primitive_room, sizeof *gpu->pair_counts);
    gpu->pair_counts = counts;
    if (!is_whole)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %llu triangles",
                       (unsigned long long)wanted);
    if (gpu->primitive_room < wanted)
        gpu->primitive_room = (uint32_t)wanted;
    return FM_OK;
}

fm_status bin_frame(tbr *gpu, fm_error *err)
{
    fm_status status = prepare_draws(gpu, err);
    if (status == FM_OK)
        status = make_primitive_room(gpu, err);
    if (status != FM_OK)
        return status;
    reset_bins(gpu);
    for (uint32_t i = 0; i < gpu->frame->draw_count && status == FM_OK; i++) {
        const uint32_t draw = gpu->draw_order[i];
        const bool is_clear = (gpu->frame->draws[draw].flags & FM_DRAW_DEPTH_CLEAR) != 0;
        status = is_clear ? bin_clear(gpu, draw, err) : bin_draw(gpu, draw, err);
    }
    for (uint32_t i = 0; i < gpu->tile_count; i++)
        splice(gpu, &gpu->bins[i].first, &gpu->bins[i].second);
    return status;
}
