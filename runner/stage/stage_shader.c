/* What the shaders of a scene pass need to know of the scene and the feed. */
#include "stage.h"

#include <inttypes.h>
#include <string.h>

#include "scene/triangles.h"

static void define_layers(fm_text *text, const fm_stage *stage, bool is_flat)
{
    const fm_scene *scene = stage->scene;
    const uint64_t seed = scene->settings.seed;
    shader_define(text, "FM_LAYERS", scene->n > 0 ? scene->n : 1); /* a divisor */
    shader_define(text, "FM_TESSELLATION", is_flat ? 1 : scene->settings.tessellation);
    shader_define(text, "FM_CELL_MAJOR", scene_is_cell_major(stage->scene) && !is_flat);
    shader_define(text, "FM_ORDER_ROWS", is_flat ? 1 : scene->order_rows);
    shader_define(text, "FM_RECT_X0", scene->rect.x0);
    shader_define(text, "FM_RECT_Y0", scene->rect.y0);
    shader_define(text, "FM_RECT_X1", scene->rect.x1);
    shader_define(text, "FM_RECT_Y1", scene->rect.y1);
    if (scene->survival_threshold != UINT32_MAX) {
        text_add(text, "#define FM_SURVIVAL %uu\n", scene->survival_threshold);
        text_add(text, "#define FM_SEED32 %uu\n", (uint32_t)(seed ^ seed >> 32));
    }
    text_add(text, "struct fm_layer { float depth, slope_x, slope_y; uint colour; };\n");
}

/* As bits: a decimal would have to survive two parsers. */
static void define_float(fm_text *text, const char *name, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    text_add(text, "#define %s uintBitsToFloat(0x%08Xu)\n", name, bits);
}

static void define_triangles(fm_text *text, const fm_stage *stage)
{
    const fm_scene *scene = stage->scene;
    const uint32_t each = triangles_per_instance(scene);
    shader_define(text, "FM_TRIANGLES", scene->triangles);
    shader_define(text, "FM_INSTANCE_TRIANGLES", each > 0 ? each : 1); /* a divisor */
    shader_define(text, "FM_CLIPS", stage->view.clips);
    define_float(text, "FM_NEAREST", stage->view.nearest);
    define_float(text, "FM_FARTHEST", stage->view.farthest);
    define_float(text, "FM_GUARD_X", raster_guard(scene->width_px));
    define_float(text, "FM_GUARD_Y", raster_guard(scene->height_px));
    define_float(text, "FM_NDC_STEP_X", triangles_ndc_step(scene->width_px));
    define_float(text, "FM_NDC_STEP_Y", triangles_ndc_step(scene->height_px));
}

void stage_define(fm_text *text, const fm_stage *stage, fm_geometry geometry)
{
    const fm_scene *scene = stage->scene;
    shader_define(text, "FM_WIDTH", scene->width_px);
    shader_define(text, "FM_HEIGHT", scene->height_px);
    shader_define(text, "FM_PIXELS", (uint64_t)scene->width_px * scene->height_px);
    shader_define(text, "FM_DEPTH_REVERSED", scene->settings.depth == FM_DEPTH_REVERSED);
    if (geometry_is_cover(geometry)) {
        shader_define(text, "FM_COVER_IN_NDC", scene_is_layers(stage->scene));
        return;
    }
    if (scene_is_layers(stage->scene))
        define_layers(text, stage, geometry == FM_GEOMETRY_FLAT);
    if (stage->feed == FM_FEED_TRIANGLES)
        define_triangles(text, stage);
    if ((stage->feed & (FM_FEED_RASTER | FM_FEED_TRIANGLES)) != 0)
        return;
    shader_define(text, "FM_FEED_PIXEL", stage->feed == FM_FEED_COMPUTE_PIXEL);
    shader_define(text, "FM_FEED_ADJACENT", stage->feed == FM_FEED_COMPUTE_ADJACENT);
    text_add(text, "#define FM_INVOCATIONS %" PRIu64 "u\n", stage->invocations);
    if (stage->replays)
        text_add(text, "#define FM_REPLAY\n");
}

size_t stage_uses(fm_use *uses, fm_stage *stage, fm_geometry geometry)
{
    size_t count = 0;
    for (uint32_t i = STAGE_LAYERS; i <= STAGE_LIST_OFFSETS; i++)
        if (stage->slots[i].buffer != NULL && (!geometry_is_cover(geometry) || i == STAGE_CLIP))
            uses[count++] = (fm_use){ .slot = &stage->slots[i], .access = FM_ACCESS_READ };
    return count;
}

fm_status stage_vertex_shader(fm_text *text, const fm_use *uses, size_t use_count,
                              const fm_stage *stage, const fm_shader_folders *folders,
                              fm_geometry geometry, fm_error *err)
{
    const bool is_cover = geometry_is_cover(geometry), is_layers = scene_is_layers(stage->scene);
    bool any_address = false;
    for (size_t i = 0; i < use_count; i++)
        any_address = any_address || uses[i].slot->by_address;
    shader_begin(text, &stage->device->caps, any_address ? FM_FEATURE_BUFFER_ADDRESS : 0);
    stage_define(text, stage, geometry);
    shader_declare(text, uses, use_count, "vertex");
    fm_status status = FM_OK;
    if (is_layers && !is_cover)
        status = shader_add_file(text, folders, "common/layers.glsl", err);
    if (status == FM_OK)
        status = shader_add_file(text, folders,
                                 is_cover    ? "common/cover_vertex.glsl"
                                 : is_layers ? "common/layers_vertex.glsl"
                                             : "common/mesh_vertex.glsl",
                                 err);
    return status;
}

static void draw_cover(fm_draw *draw, const fm_stage *stage, const fm_stage_cover *cover)
{
    draw->vertices = cover->vertices;
    draw->indices = cover->indices;
    draw->vertex_count = cover->index_count;
    draw->instance_count = scene_is_layers(stage->scene) ? 1 : stage->scene->instances;
}

void stage_draw(fm_draw *draw, const fm_stage *stage, fm_geometry geometry)
{
    const bool is_flat = geometry == FM_GEOMETRY_FLAT;
    const fm_scene *scene = stage->scene;
    const uint32_t t = scene->settings.tessellation, cells = t * t;
    draw->indices = stage->indices;
    if (geometry_is_cover(geometry)) {
        draw_cover(draw, stage, &stage->covers[geometry]);
    } else if (!scene_is_layers(stage->scene)) {
        draw->vertices = stage->vertices;
        draw->vertex_count = scene->index_count;
        draw->instance_count = scene->instances;
    } else if (is_flat) {
        draw->indices = stage->flat_indices;
        draw->vertex_count = 6;
        draw->instance_count = scene->n;
    } else if (scene_is_cell_major(stage->scene)) {
        draw->vertex_count = 6 * scene->n;
        draw->instance_count = cells;
    } else {
        draw->vertex_count = 6 * cells;
        draw->instance_count = scene->n;
    }
}

void stage_vertex_layout(fm_pipeline_desc *desc, const fm_stage *stage, fm_geometry geometry)
{
    if (scene_is_layers(stage->scene) && !geometry_is_cover(geometry))
        return;
    desc->vertex_stride_bytes = sizeof(fm_vertex);
    desc->attribute_count = 2;
    desc->attributes[0] =
        (fm_vertex_attribute){ .location = 0, .element = FM_ELEMENT_FLOAT, .is_vec3 = true };
    desc->attributes[1] = (fm_vertex_attribute){ .location = 1,
                                                 .element = FM_ELEMENT_UINT,
                                                 .offset_bytes = offsetof(fm_vertex, colour) };
}

fm_status stage_groups(uint32_t groups[3], const fm_device_caps *caps, uint64_t invocations,
                       fm_error *err)
{
    const uint64_t needed = (invocations + STAGE_GROUP_SIZE - 1) / STAGE_GROUP_SIZE;
    const uint64_t wide = needed < caps->max_groups[0] ? needed : caps->max_groups[0];
    const uint64_t high = wide > 0 ? (needed + wide - 1) / wide : 0;
    if (high > caps->max_groups[1])
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                         "%" PRIu64 " workgroups; a dispatch has %u x %u at most", needed,
                         caps->max_groups[0], caps->max_groups[1]);
    groups[0] = (uint32_t)wide;
    groups[1] = (uint32_t)high;
    groups[2] = 1;
    return FM_OK;
}
