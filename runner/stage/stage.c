#include "stage.h"
#include "scene/layers.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* 29 bits number a triangle; the 3 above, a part of a clipped one. */
#define TRIANGLES_MAX ((1u << 29) - 1u)

static const struct slot_words {
    const char *name, *type;
} slot_words[] = {
    [STAGE_LAYERS] = { "fm_layers", "fm_layer" },
    [STAGE_ORDER] = { "fm_order", "uint" },
    [STAGE_CLIP] = { "fm_clip_from_object", "vec4" },
    [STAGE_VERTICES] = { "fm_vertices", "uvec4" },
    [STAGE_INDICES] = { "fm_indices", "uint" },
    [STAGE_LIST] = { "fm_list", "uvec2" },
    [STAGE_LIST_PIXELS] = { "fm_list_pixels", "uint" },
    [STAGE_LIST_OFFSETS] = { "fm_list_offsets", "uint" },
    [STAGE_OUTPUT] = { "fm_output", "vec4" },
    [STAGE_OUTPUT_BACK] = { "fm_output_back", "vec4" },
    [STAGE_COUNTERS] = { "fm_counters", "uint" },
    [STAGE_CAPTURE] = { "fm_capture", "uvec2" },
    [STAGE_CAPTURE_COUNTS] = { "fm_capture_counts", "uvec2" },
};
_Static_assert(sizeof slot_words / sizeof slot_words[0] == STAGE_SLOT_COUNT, "one each");

static fm_status create_slot(fm_stage *stage, int index, uint64_t bytes, const void *data,
                             bool host_reads, fm_error *err)
{
    fm_slot *slot = &stage->slots[index];
    const fm_buffer_desc desc = { .name = slot_words[index].name,
                                  .bytes = bytes,
                                  .owner = FM_OWNER_RUNNER,
                                  .host_reads = host_reads };
    slot_destroy(slot, stage->device);
    fm_status status = slot_create_buffer(slot, stage->device, stage->buffers, &desc, err);
    if (status == FM_OK && data != NULL)
        status = stage->device->ops->buffer_write(stage->device, slot->buffer, 0, data, bytes, err);
    return status;
}

static uint32_t cells(const fm_stage *stage)
{
    const uint32_t t = stage->scene->settings.tessellation;
    return t * t;
}

static fm_status create_layers(fm_stage *stage, fm_error *err)
{
    const fm_scene *scene = stage->scene;
    const uint32_t n = scene->n > 0 ? scene->n : 1; /* shaders of an empty scene name them too */
    const uint64_t order_bytes = (uint64_t)scene->order_rows * n * sizeof scene->order[0];
    fm_status status =
        create_slot(stage, STAGE_LAYERS, n * sizeof scene->layers[0], scene->layers, false, err);
    if (status == FM_OK)
        status = create_slot(stage, STAGE_ORDER, order_bytes, scene->order, false, err);
    if (status != FM_OK || stage->feed != FM_FEED_RASTER)
        return status;
    const uint32_t quads = scene_is_cell_major(stage->scene) ? n : cells(stage);
    status = stage_create_quad_indices(&stage->indices, stage->device, quads, err);
    if (status == FM_OK)
        status = stage_create_quad_indices(&stage->flat_indices, stage->device, 1, err);
    return status;
}

static fm_status write_vertices(void *user, uint32_t first, const fm_vertex *vertices,
                                uint32_t count, fm_error *err)
{
    const fm_stage *stage = user;
    return stage->device->ops->buffer_write(stage->device, stage->vertices,
                                            (uint64_t)first * sizeof *vertices, vertices,
                                            (uint64_t)count * sizeof *vertices, err);
}

static fm_status write_indices(void *user, uint32_t first, const uint32_t *indices, uint32_t count,
                               fm_error *err)
{
    const fm_stage *stage = user;
    return stage->device->ops->buffer_write(stage->device, stage->indices,
                                            (uint64_t)first * sizeof *indices, indices,
                                            (uint64_t)count * sizeof *indices, err);
}

/* The scene is held. */
static fm_status create_mesh_slots(fm_stage *stage, fm_error *err)
{
    const fm_scene *scene = stage->scene;
    fm_status status =
        create_slot(stage, STAGE_VERTICES, scene->vertex_count * sizeof scene->vertices[0],
                    scene->vertices, false, err);
    if (status == FM_OK)
        status = create_slot(stage, STAGE_INDICES, scene->index_count * sizeof scene->indices[0],
                             scene->indices, false, err);
    if (status == FM_OK)
        status = create_slot(stage, STAGE_CLIP, scene->instances * 16ull * sizeof(float),
                             scene->clip_from_object, false, err);
    return status;
}

static fm_status create_mesh(fm_stage *stage, fm_error *err)
{
    const fm_scene *scene = stage->scene;
    const fm_mesh_sink sink = { stage, write_vertices, write_indices };
    if (stage->feed == FM_FEED_TRIANGLES)
        return create_mesh_slots(stage, err);
    if (stage->feed != FM_FEED_RASTER)
        return FM_OK;
    fm_status status =
        stage_create_vertices(&stage->vertices, stage->device, NULL,
                              (uint64_t)scene->vertex_count * sizeof scene->vertices[0], err);
    if (status == FM_OK)
        status =
            stage_create_indices(&stage->indices, stage->device, NULL, scene->index_count, err);
    if (status == FM_OK)
        status = scene_mesh(scene, &sink, err);
    if (status == FM_OK)
        status = create_slot(stage, STAGE_CLIP, scene->instances * 16ull * sizeof(float),
                             scene->clip_from_object, false, err);
    return status;
}

/* The captured list in the order in which the feed replays it. */
typedef struct replay_list {
    uint32_t (*fragments)[2];
    uint32_t *pixels;
    uint32_t *offsets;
} replay_list;

static void replay_put(replay_list *list, uint64_t at, const fm_truth *truth, uint64_t pixel,
                       uint64_t arrival)
{
    const uint64_t first = truth->offsets[pixel];
    const fm_fragment *fragment =
        &truth->fragments[first +
                          (truth->arrival != NULL ? truth->arrival[first + arrival] : arrival)];
    memcpy(&list->fragments[at][0], &fragment->depth, sizeof fragment->depth);
    list->fragments[at][1] = fragment->colour;
    list->pixels[at] = (uint32_t)pixel;
}

static void replay_fill(replay_list *list, const fm_truth *truth, bool by_layer)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    uint64_t at = 0;
    for (uint64_t pixel = 0; pixel <= pixels; pixel++)
        list->offsets[pixel] = (uint32_t)truth->offsets[pixel];
    if (!by_layer) {
        for (uint64_t pixel = 0; pixel < pixels; pixel++)
            for (uint64_t i = 0; i < truth->offsets[pixel + 1] - truth->offsets[pixel]; i++)
                replay_put(list, at++, truth, pixel, i);
        return;
    }
    for (uint64_t arrival = 0; arrival < truth->n; arrival++)
        for (uint64_t pixel = 0; pixel < pixels; pixel++)
            if (arrival < truth->offsets[pixel + 1] - truth->offsets[pixel])
                replay_put(list, at++, truth, pixel, arrival);
}

static fm_status create_replay(fm_stage *stage, const fm_truth *truth, fm_error *err)
{
    const uint64_t count = truth->fragment_count;
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    if (count > UINT32_MAX)
        return fm_refuse(err, FM_REASON_SUITE_LIMIT,
                         "%" PRIu64 " fragments: compute feeds replay %u at most", count,
                         UINT32_MAX);
    replay_list list = { .fragments = malloc((count + 1) * sizeof list.fragments[0]),
                         .pixels = malloc((count + 1) * sizeof list.pixels[0]),
                         .offsets = malloc((pixels + 1) * sizeof list.offsets[0]) };
    fm_status status = FM_OK;
    if (list.fragments == NULL || list.pixels == NULL || list.offsets == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "a list of %" PRIu64 " fragments", count);
        goto out;
    }
    replay_fill(&list, truth, stage->feed == FM_FEED_COMPUTE_LAYER);
    status = create_slot(stage, STAGE_LIST, (count + (count == 0)) * 8, list.fragments, false, err);
    if (status == FM_OK && stage->feed == FM_FEED_COMPUTE_PIXEL)
        status = create_slot(stage, STAGE_LIST_OFFSETS, (pixels + 1) * 4, list.offsets, false, err);
    if (status == FM_OK && stage->feed != FM_FEED_COMPUTE_PIXEL)
        status = create_slot(stage, STAGE_LIST_PIXELS, (count + (count == 0)) * 4, list.pixels,
                             false, err);
out:
    free(list.fragments);
    free(list.pixels);
    free(list.offsets);
    return status;
}

static fm_status count_invocations(fm_stage *stage, const fm_truth *truth, fm_error *err)
{
    const fm_rect *rect = &stage->scene->rect;
    const uint64_t rect_pixels = (uint64_t)(rect->x1 - rect->x0) * (rect->y1 - rect->y0);
    const bool per_pixel = stage->feed == FM_FEED_COMPUTE_PIXEL;
    if (stage->replays)
        stage->invocations =
            per_pixel ? (uint64_t)truth->width_px * truth->height_px : truth->fragment_count;
    else
        stage->invocations = per_pixel ? rect_pixels : rect_pixels * stage->scene->n;
    if (stage->invocations > UINT32_MAX)
        return fm_refuse(err, FM_REASON_SUITE_LIMIT,
                         "%" PRIu64 " invocations: a compute feed has %u at most",
                         stage->invocations, UINT32_MAX);
    return FM_OK;
}

/* The image starts transparent black, 1 - A being 1: a method that emits nothing shows nothing. */
static fm_status create_black(fm_stage *stage, uint64_t pixels, fm_error *err)
{
    float(*black)[4] = calloc(pixels, sizeof *black);
    if (black == NULL)
        return fm_fail(err, FM_NO_MEMORY, "an image of %" PRIu64 " pixels", pixels);
    for (uint64_t i = 0; i < pixels; i++)
        black[i][3] = 1.0f;
    fm_status status = create_slot(stage, STAGE_OUTPUT, pixels * sizeof *black, black, false, err);
    free(black);
    return status;
}

static fm_status create_shared(fm_stage *stage, fm_error *err)
{
    const uint64_t pixels = (uint64_t)stage->scene->width_px * stage->scene->height_px;
    const fm_buffer_desc params = {
        .name = "params", .bytes = sizeof(fm_params), .owner = FM_OWNER_RUNNER, .is_uniform = true
    };
    fm_status status =
        stage->device->ops->buffer_create(&stage->params, stage->device, &params, err);
    if (status == FM_OK)
        status = create_black(stage, pixels, err);
    if (status == FM_OK)
        status = create_slot(stage, STAGE_COUNTERS, STAGE_COUNTER_COUNT * 4, NULL, true, err);
    return status;
}

static fm_status look_at_triangles(fm_stage *stage, fm_error *err)
{
    const fm_scene *scene = stage->scene;
    if (scene->triangles > TRIANGLES_MAX)
        return fm_refuse(err, FM_REASON_SUITE_LIMIT,
                         "%" PRIu64 " triangles: the feed triangles carries %u at most",
                         scene->triangles, TRIANGLES_MAX);
    stage->view = triangles_view(scene);
    return FM_OK;
}

fm_status stage_create(fm_stage **out, fm_device *device, const fm_scene *scene,
                       const fm_truth *truth, uint32_t feed, fm_error *err)
{
    fm_stage *stage = calloc(1, sizeof *stage);
    *out = NULL;
    if (stage == NULL)
        return fm_fail(err, FM_NO_MEMORY, "a stage");
    stage->device = device;
    stage->scene = scene;
    stage->feed = feed;
    stage->buffers = scene->settings.buffers;
    stage->n =
        scene->settings.generator == FM_GENERATOR_LAYERS || truth == NULL ? scene->n : truth->n;
    for (uint32_t i = 0; i < STAGE_SLOT_COUNT; i++)
        stage->slots[i] = (fm_slot){ .name = slot_words[i].name,
                                     .type = slot_words[i].type,
                                     .table_index = i,
                                     .in_table = true };
    const bool is_compute = (feed & (FM_FEED_RASTER | FM_FEED_TRIANGLES)) == 0;
    stage->replays = is_compute && !layers_are_flat(&stage->scene->settings);
    fm_status status = create_shared(stage, err);
    if (status == FM_OK && feed == FM_FEED_TRIANGLES)
        status = look_at_triangles(stage, err);
    if (status == FM_OK && scene_is_layers(stage->scene) && !stage->replays)
        status = create_layers(stage, err);
    if (status == FM_OK && !scene_is_layers(stage->scene))
        status = create_mesh(stage, err);
    if (status == FM_OK && stage->replays)
        status = create_replay(stage, truth, err);
    if (status == FM_OK && is_compute)
        status = count_invocations(stage, truth, err);
    if (status == FM_OK)
        *out = stage;
    else
        stage_destroy(stage);
    return status;
}

void stage_destroy(fm_stage *stage)
{
    if (stage == NULL)
        return;
    const fm_device_ops *ops = stage->device->ops;
    for (uint32_t i = 0; i < STAGE_SLOT_COUNT; i++)
        slot_destroy(&stage->slots[i], stage->device);
    stage_destroy_covers(stage);
    ops->buffer_destroy(stage->device, stage->params);
    ops->buffer_destroy(stage->device, stage->vertices);
    ops->buffer_destroy(stage->device, stage->indices);
    ops->buffer_destroy(stage->device, stage->flat_indices);
    free(stage);
}

fm_status stage_create_capture(fm_stage *stage, uint64_t pixels, uint64_t fragments, fm_error *err)
{
    fm_status status = create_slot(stage, STAGE_CAPTURE, pixels * fragments * 8, NULL, false, err);
    if (status == FM_OK)
        status = create_slot(stage, STAGE_CAPTURE_COUNTS, pixels * 8, NULL, false, err);
    return status;
}

fm_status stage_create_back(fm_stage *stage, fm_error *err)
{
    const uint64_t pixels = (uint64_t)stage->scene->width_px * stage->scene->height_px;
    return create_slot(stage, STAGE_OUTPUT_BACK, pixels * 16, NULL, false, err);
}
