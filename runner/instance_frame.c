/* Running a frame: passes in order, loops, totals read back, what has to grow. */
#include "instance_internal.h"

#include <stdlib.h>
#include <string.h>

enum {
    CANARY_TIMER = FM_MAX_TIMERS - 1,
    COMBINE_TIMER = FM_MAX_TIMERS - 2,
    REDO_MAX = 8,
    LOOP_MAX_DEFAULT = 65536,
    SCENE_PARAM_NONE = 0
};

/* A frame on its way. */
typedef struct frame_run {
    fm_instance *instance;
    fm_frame_result *result;
    fm_band band;
    fm_params params;
    bool params_are_set;
    bool is_recording;
    bool redo;
    uint64_t query[FM_MAX_QUERIES];
    fm_error *err;
} frame_run;

static fm_status flush(frame_run *frame)
{
    fm_frame_times times;
    fm_device *device = frame->instance->device;
    if (!frame->is_recording)
        return FM_OK;
    frame->is_recording = false;
    fm_status status = device->ops->frame_end(device, &times, frame->err);
    if (status != FM_OK)
        return status;
    for (size_t i = 0; i < frame->instance->pass_count; i++)
        frame->result->pass_ns[i] += times.timer_ns[i];
    for (size_t i = 0; i < frame->instance->pass_count && frame->instance->emits_back; i++)
        if (strcmp(frame->instance->method->passes[i].name, "resolve") == 0)
            frame->result->pass_ns[i] += times.timer_ns[COMBINE_TIMER];
    frame->result->canary_ns += times.timer_ns[CANARY_TIMER];
    frame->result->wall_ns += times.wall_ns;
    memcpy(frame->query, times.query, sizeof frame->query);
    return FM_OK;
}

static fm_status record(frame_run *frame)
{
    if (frame->is_recording)
        return FM_OK;
    fm_device *device = frame->instance->device;
    fm_status status = device->ops->frame_begin(device, frame->err);
    frame->is_recording = status == FM_OK;
    return status;
}

static void set_params(frame_run *frame, uint32_t iteration, uint32_t total)
{
    const bool is_total = total != SCENE_PARAM_NONE;
    const fm_params params = { .iteration = iteration,
                               .band_first = is_total ? total : frame->band.first,
                               .band_pixels = frame->band.pixels };
    if (frame->params_are_set && memcmp(&params, &frame->params, sizeof params) == 0)
        return;
    frame->params = params;
    frame->params_are_set = true;
    frame->instance->device->ops->update(
        frame->instance->device, frame->instance->desc.stage->params, 0, &params, sizeof params);
}

/* ---- one pass ---- */

/* The copy of a resource that this iteration means. */
static fm_slot *current_slot(fm_instance *instance, const built_pass *built, size_t use)
{
    const resource_ref ref = built->refs[use];
    if (ref.index < 0 || !instance->method->resources[ref.index].ping_pong)
        return built->uses[use].slot;
    return &instance->resources[ref.index][instance->parity ^ (ref.is_previous ? 1u : 0u)];
}

static uint32_t collect_binds(fm_bind binds[FM_MAX_BINDINGS], fm_instance *instance,
                              const built_pass *built)
{
    uint32_t count = 0;
    binds[count++] = (fm_bind){ .binding = SHADER_BINDING_PARAMS,
                                .kind = FM_BINDING_UNIFORM,
                                .buffer = instance->desc.stage->params,
                                .access = FM_ACCESS_READ };
    binds[count++] = (fm_bind){ .binding = SHADER_BINDING_TABLE,
                                .kind = FM_BINDING_UNIFORM,
                                .buffer = instance->table,
                                .access = FM_ACCESS_READ };
    for (size_t i = 0; i < built->use_count; i++) {
        const fm_use *use = &built->uses[i];
        fm_slot *slot = current_slot(instance, built, i);
        const bool writes = (use->access & FM_ACCESS_WRITE) != 0;
        fm_bind *bind = &binds[count++];
        *bind = (fm_bind){ .binding = use->binding,
                           .buffer = slot->buffer,
                           .image = slot->image,
                           .access = use->access };
        if (slot->image != NULL)
            bind->kind = writes ? FM_BINDING_STORAGE_IMAGE : FM_BINDING_SAMPLED;
        else
            bind->kind = slot->by_address ? FM_BINDING_ADDRESS : FM_BINDING_STORAGE;
    }
    return count;
}

static fm_image_resource *current_image(fm_instance *instance, const char *name,
                                        const fm_resource **resource)
{
    bool is_previous;
    const int index = resource_index(instance->method, name, &is_previous);
    const uint32_t parity = instance->method->resources[index].ping_pong ? instance->parity : 0;
    *resource = &instance->method->resources[index];
    return instance->resources[index][parity ^ (is_previous ? 1u : 0u)].image;
}

static void fill_targets(fm_draw *draw, fm_instance *instance, const fm_pass *pass)
{
    const fm_resource *resource;
    for (uint32_t i = 0; i < FM_MAX_TARGETS && pass->targets[i].resource != NULL; i++) {
        draw->targets[i] = current_image(instance, pass->targets[i].resource, &resource);
        draw->target_loads[i] = pass->targets[i].load;
        memcpy(draw->target_clears[i], resource->clear_colour, sizeof resource->clear_colour);
        draw->target_count = i + 1;
    }
    if (pass->state.depth_stencil == NULL)
        return;
    draw->depth_stencil = current_image(instance, pass->state.depth_stencil, &resource);
    draw->depth_stencil_load = pass->state.depth_stencil_load;
    draw->clear_depth = resource->clear_depth;
    draw->clear_stencil = resource->clear_stencil;
}

static const fm_pipeline *pipeline_at(const built_pass *built, uint32_t iteration)
{
    return built
        ->pipelines[iteration < built->pipeline_count ? iteration : built->pipeline_count - 1];
}

static fm_status draw_pass(frame_run *frame, size_t index, uint32_t iteration)
{
    fm_instance *instance = frame->instance;
    const fm_pass *pass = &instance->method->passes[index];
    const built_pass *built = &instance->passes[index];
    fm_bind binds[FM_MAX_BINDINGS];
    fm_draw draw = { .pipeline = pipeline_at(built, iteration),
                     .binds = binds,
                     .bind_count = collect_binds(binds, instance, built),
                     .width_px = instance->workload.width_px,
                     .height_px = instance->workload.height_px,
                     .vertex_count = 3,
                     .instance_count = 1,
                     .query = -1 };
    fill_targets(&draw, instance, pass);
    if (pass->kind == FM_PASS_SCENE) {
        stage_draw(&draw, instance->desc.stage, pass->flat_tessellation);
        for (size_t i = 0; i < instance->total_count; i++)
            if (instance->method->totals[i].resource == NULL &&
                strcmp(instance->method->totals[i].pass, pass->name) == 0)
                draw.query = (int)index;
    }
    return instance->device->ops->draw(instance->device, &draw, frame->err);
}

static uint64_t invocations(const frame_run *frame, const fm_pass *pass)
{
    const fm_instance *instance = frame->instance;
    const fm_workload *workload = &instance->workload;
    const int total = total_index(instance->method, pass->count_total);
    switch (pass->kind) {
    case FM_PASS_SCENE:
        return instance->desc.stage->invocations;
    case FM_PASS_PIXELS:
        return (uint64_t)workload->width_px * workload->height_px;
    case FM_PASS_TILES:
        return (uint64_t)((workload->width_px + FM_TILE_PX - 1) / FM_TILE_PX) *
               ((workload->height_px + FM_TILE_PX - 1) / FM_TILE_PX);
    case FM_PASS_TRIANGLES:
        return workload->triangles;
    case FM_PASS_TOTAL:
        return total >= 0 ? instance->totals[total] : 0;
    case FM_PASS_INDIRECT:
    case FM_PASS_CLEAR:
    case FM_PASS_HOST:
    case FM_PASS_KIND_COUNT:
        break;
    }
    return 0;
}

static fm_status dispatch_pass(frame_run *frame, const fm_pass *pass, const built_pass *built,
                               uint64_t count)
{
    fm_instance *instance = frame->instance;
    fm_bind binds[FM_MAX_BINDINGS];
    fm_dispatch dispatch = { .pipeline = pipeline_at(built, 0),
                             .binds = binds,
                             .bind_count = collect_binds(binds, instance, built) };
    if (pass->kind == FM_PASS_INDIRECT) {
        bool is_previous;
        const int index = resource_index(instance->method, pass->indirect, &is_previous);
        dispatch.indirect = instance->resources[index][0].buffer;
    } else {
        fm_status status =
            stage_groups(dispatch.groups, &instance->device->caps, count, frame->err);
        if (status != FM_OK || count == 0)
            return status;
    }
    return instance->device->ops->dispatch(instance->device, &dispatch, frame->err);
}

static void clear_pass(frame_run *frame, const fm_pass *pass)
{
    fm_instance *instance = frame->instance;
    fm_device *device = instance->device;
    for (int i = 0; i < FM_MAX_ACCESSES && pass->writes[i] != NULL; i++) {
        bool is_previous;
        const int index = resource_index(instance->method, pass->writes[i], &is_previous);
        const fm_resource *resource = &instance->method->resources[index];
        const uint32_t parity = resource->ping_pong ? instance->parity : 0;
        const fm_slot *slot = &instance->resources[index][parity ^ (is_previous ? 1u : 0u)];
        if (slot->image != NULL)
            device->ops->image_clear(device, slot->image, resource->clear_colour,
                                     resource->clear_depth, resource->clear_stencil);
        else if (slot->buffer != NULL)
            device->ops->fill(device, slot->buffer, pass->clear_word);
    }
}

static bool is_empty_scene(const fm_instance *instance, const fm_pass *pass)
{
    return pass->kind == FM_PASS_SCENE && instance->desc.stage->scene->triangles == 0;
}

static fm_status run_pass(frame_run *frame, size_t index, uint32_t iteration)
{
    fm_instance *instance = frame->instance;
    const fm_pass *pass = &instance->method->passes[index];
    const bool is_total = pass->kind == FM_PASS_TOTAL;
    const uint64_t count = invocations(frame, pass);
    fm_status status = record(frame);
    if (status != FM_OK || pass->kind == FM_PASS_HOST)
        return status;
    set_params(frame, iteration, is_total ? (uint32_t)count : SCENE_PARAM_NONE);
    instance->device->ops->timer_begin(instance->device, (uint32_t)index);
    if (pass->kind == FM_PASS_CLEAR)
        clear_pass(frame, pass);
    else if (is_empty_scene(instance, pass) && pass->targets[0].resource == NULL)
        status = FM_OK;
    else if (instance->passes[index].is_drawn)
        status = draw_pass(frame, index, iteration);
    else
        status = dispatch_pass(frame, pass, &instance->passes[index], count);
    instance->device->ops->timer_end(instance->device, (uint32_t)index);
    return status;
}

/* ---- totals ---- */

static fm_status sum_elements(uint64_t *sum, frame_run *frame, const fm_slot *slot)
{
    fm_device *device = frame->instance->device;
    uint32_t *words = malloc(slot->length * sizeof *words);
    *sum = 0;
    if (words == NULL)
        return fm_fail(frame->err, FM_NO_MEMORY, "reading '%s' back", slot->name);
    fm_status status = device->ops->buffer_read(device, slot->buffer, 0, words,
                                                slot->length * sizeof *words, frame->err);
    for (uint64_t i = 0; i < slot->length && status == FM_OK; i++)
        *sum += words[i];
    free(words);
    return status;
}

static fm_status read_total(frame_run *frame, size_t index)
{
    fm_instance *instance = frame->instance;
    const fm_total *total = &instance->method->totals[index];
    bool is_previous;
    if (total->resource == NULL) {
        instance->totals[index] = frame->query[pass_index(instance->method, total->pass)];
        return FM_OK;
    }
    const int resource = resource_index(instance->method, total->resource, &is_previous);
    const fm_slot *slot = &instance->resources[resource][0];
    uint32_t word = 0;
    if (total->sum)
        return sum_elements(&instance->totals[index], frame, slot);
    fm_status status = instance->device->ops->buffer_read(
        instance->device, slot->buffer, total->index * sizeof word, &word, sizeof word, frame->err);
    instance->totals[index] = word;
    return status;
}

/* Pipelines name how each buffer is reached; growing past the bound range changes that. */
static fm_status rebuild(frame_run *frame)
{
    passes_destroy(frame->instance);
    return passes_create(frame->instance, frame->err);
}

static uint32_t address_bits(const fm_instance *instance)
{
    uint32_t bits = 0;
    for (size_t i = 0; i < instance->resource_count; i++)
        bits |= (uint32_t)instance->resources[i][0].by_address << i;
    return bits;
}

static fm_status take_total(frame_run *frame, size_t index)
{
    const uint32_t before = address_bits(frame->instance);
    bool grew = false;
    fm_status status = read_total(frame, index);
    if (status == FM_OK)
        status = resources_create_after(frame->instance, index, frame->err);
    if (status == FM_OK)
        status = resources_grow(&grew, frame->instance, index, frame->err);
    frame->redo = frame->redo || grew;
    if (status == FM_OK && address_bits(frame->instance) != before)
        status = rebuild(frame);
    return status;
}

/* Totals that this pass completes; the hook, if it is a host pass. */
static fm_status after_pass(frame_run *frame, size_t index, fm_next *next)
{
    fm_instance *instance = frame->instance;
    const fm_pass *pass = &instance->method->passes[index];
    fm_status status = FM_OK;
    for (size_t i = 0; i < instance->total_count && status == FM_OK; i++) {
        if (strcmp(instance->method->totals[i].pass, pass->name) != 0)
            continue;
        status = flush(frame);
        if (status == FM_OK)
            status = take_total(frame, i);
    }
    *next = frame->redo ? FM_REDO : FM_NEXT;
    if (status == FM_OK && pass->kind == FM_PASS_HOST && instance->method->after != NULL) {
        status = flush(frame);
        *next = instance->method->after(&instance->workload, pass->name);
    }
    return status;
}

/* ---- loops ---- */

static const fm_loop *loop_from(const fm_instance *instance, size_t first, const fm_loop *inside)
{
    for (int i = 0; i < FM_MAX_LOOPS && instance->method->loops[i].first != NULL; i++) {
        const fm_loop *loop = &instance->method->loops[i];
        if (loop != inside && pass_index(instance->method, loop->first) == (int)first)
            return loop;
    }
    return NULL;
}

static uint32_t loop_most(const fm_instance *instance, const fm_loop *loop)
{
    const uint32_t count = loop->count + loop->count_per_k * instance->workload.k +
                           loop->count_per_n * instance->workload.n;
    const uint32_t max = loop->max > 0 ? loop->max : LOOP_MAX_DEFAULT;
    return loop->until_zero == NULL && count < max ? count : max;
}

static fm_status swap_copies(frame_run *frame)
{
    frame->instance->parity ^= 1u;
    for (size_t i = 0; i < frame->instance->resource_count; i++) {
        if (!frame->instance->resources[i][1].by_address)
            continue;
        fm_status status = flush(frame);
        return status == FM_OK ? table_upload(frame->instance, frame->err) : status;
    }
    return FM_OK;
}

static fm_status run_range(frame_run *frame, size_t first, size_t last, uint32_t iteration,
                           const fm_loop *inside, fm_next *next);

static fm_status run_loop(frame_run *frame, const fm_loop *loop, fm_next *next)
{
    fm_instance *instance = frame->instance;
    const size_t first = (size_t)pass_index(instance->method, loop->first);
    const size_t last = (size_t)pass_index(instance->method, loop->last);
    const int until = total_index(instance->method, loop->until_zero);
    const uint32_t most = loop_most(instance, loop);
    fm_status status = FM_OK;
    *next = FM_NEXT;
    for (uint32_t i = 0; i < most && status == FM_OK && *next != FM_REDO; i++) {
        status = run_range(frame, first, last, i, loop, next);
        if (status == FM_OK)
            status = swap_copies(frame);
        if (until >= 0 && instance->totals[until] == 0 && *next != FM_REPEAT)
            break;
    }
    return status;
}

static fm_status run_range(frame_run *frame, size_t first, size_t last, uint32_t iteration,
                           const fm_loop *inside, fm_next *next)
{
    fm_status status = FM_OK;
    *next = FM_NEXT;
    for (size_t i = first; i <= last && status == FM_OK && *next != FM_REDO; i++) {
        const fm_loop *loop = loop_from(frame->instance, i, inside);
        if (loop != NULL) {
            status = run_loop(frame, loop, next);
            i = (size_t)pass_index(frame->instance->method, loop->last);
            continue;
        }
        fm_next here = FM_NEXT;
        status = run_pass(frame, i, iteration);
        if (status == FM_OK)
            status = after_pass(frame, i, &here);
        if (here != FM_NEXT)
            *next = here;
    }
    return status;
}

/* ---- a frame ---- */

static fm_status start(frame_run *frame)
{
    fm_instance *instance = frame->instance;
    fm_device *device = instance->device;
    fm_status status = FM_OK;
    if (instance->desc.settings->pool == FM_POOL_PER_FRAME) {
        resources_destroy(instance); /* as published: each frame asks for its memory anew */
        status = resources_create_fixed(instance, frame->err);
    }
    frame->redo = false;
    frame->params_are_set = false;
    instance->parity = 0;
    if (status == FM_OK)
        status = record(frame);
    if (status != FM_OK)
        return status;
    device->ops->fill(device, instance->desc.stage->slots[STAGE_COUNTERS].buffer, 0);
    if (instance->desc.is_capture)
        device->ops->fill(device, instance->desc.stage->slots[STAGE_CAPTURE_COUNTS].buffer, 0);
    device->ops->timer_begin(device, CANARY_TIMER);
    device->ops->timer_end(device, CANARY_TIMER);
    return FM_OK;
}

static fm_status combine(frame_run *frame)
{
    fm_instance *instance = frame->instance;
    static const fm_pass pass = { .kind = FM_PASS_PIXELS };
    if (instance->combine.use_count == 0)
        return FM_OK;
    fm_status status = record(frame);
    if (status != FM_OK)
        return status;
    instance->device->ops->timer_begin(instance->device, COMBINE_TIMER);
    status = dispatch_pass(frame, &pass, &instance->combine, invocations(frame, &pass));
    instance->device->ops->timer_end(instance->device, COMBINE_TIMER);
    return status;
}

static fm_status run_once(frame_run *frame)
{
    fm_next next = FM_NEXT;
    fm_status status = start(frame);
    if (status == FM_OK)
        status = run_range(frame, 0, frame->instance->pass_count - 1, 0, NULL, &next);
    if (status == FM_OK && next != FM_REDO)
        status = combine(frame);
    frame->redo = next == FM_REDO;
    /* After an error the frame that is open must still be ended. */
    fm_error ignored;
    fm_error *err = frame->err;
    frame->err = status == FM_OK ? err : &ignored;
    const fm_status ended = flush(frame);
    frame->err = err;
    return status == FM_OK ? ended : status;
}

static fm_status read_counters(frame_run *frame)
{
    uint32_t words[STAGE_COUNTER_COUNT] = { 0 };
    fm_instance *instance = frame->instance;
    fm_status status = instance->device->ops->buffer_read(
        instance->device, instance->desc.stage->slots[STAGE_COUNTERS].buffer, 0, words,
        sizeof words, frame->err);
    frame->result->lost = words[STAGE_COUNTER_LOST];
    frame->result->culled = words[STAGE_COUNTER_CULLED];
    frame->result->locked = words[STAGE_COUNTER_LOCKED];
    return status;
}

fm_status instance_frame(fm_frame_result *result, fm_instance *instance, const fm_band *band,
                         fm_error *err)
{
    frame_run frame = { .instance = instance, .result = result, .err = err };
    *result = (fm_frame_result){ 0 };
    if (band != NULL)
        frame.band = *band;
    fm_status status = run_once(&frame);
    while (status == FM_OK && frame.redo) {
        if (++result->redos > REDO_MAX)
            return fm_fail(err, FM_INVALID, "%s: asked for the frame again %d times",
                           instance->method->id, REDO_MAX);
        status = run_once(&frame);
    }
    return status == FM_OK ? read_counters(&frame) : status;
}

bool instance_can_emit_again(const fm_instance *instance)
{
    return instance->method->loops[0].first == NULL;
}

fm_status instance_emit(fm_instance *instance, const fm_band *band, fm_error *err)
{
    fm_frame_result result = { 0 };
    frame_run frame = { .instance = instance, .result = &result, .band = *band, .err = err };
    fm_device *device = instance->device;
    fm_status status = record(&frame);
    if (status != FM_OK)
        return status;
    device->ops->fill(device, instance->desc.stage->slots[STAGE_CAPTURE_COUNTS].buffer, 0);
    for (size_t i = 0; i < instance->pass_count && status == FM_OK; i++)
        if (instance->method->passes[i].emits)
            status = run_pass(&frame, i, 0);
    const fm_status ended = flush(&frame);
    return status == FM_OK ? ended : status;
}
