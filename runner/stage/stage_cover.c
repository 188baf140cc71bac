/* Covers of a scene on the device. */
#include "scene/solid.h"
#include "stage.h"

static fm_status make_hull(fm_solid *solid, const fm_stage *stage, fm_error *err)
{
    const bool is_kept = stage->hull_cache != NULL && !scene_is_layers(stage->scene);
    if (is_kept && solid_read(solid, stage->hull_cache, stage->scene, NULL) == FM_OK)
        return FM_OK;
    const fm_status status = solid_hull(solid, stage->scene, err);
    if (status == FM_OK && is_kept) /* a cache that cannot be written costs time, no more */
        solid_write(solid, stage->hull_cache, stage->scene, NULL);
    return status;
}

static fm_status create_buffers(fm_stage_cover *cover, fm_device *device, const fm_solid *solid,
                                fm_error *err)
{
    fm_status status =
        stage_create_vertices(&cover->vertices, device, solid->vertices,
                              (uint64_t)solid->vertex_count * sizeof solid->vertices[0], err);
    if (status == FM_OK)
        status =
            stage_create_indices(&cover->indices, device, solid->indices, solid->index_count, err);
    cover->index_count = solid->index_count;
    return status;
}

fm_status stage_create_cover(fm_stage *stage, fm_geometry geometry, fm_error *err)
{
    fm_solid solid = { 0 };
    fm_stage_cover *cover = &stage->covers[geometry];
    if (stage->feed != FM_FEED_RASTER)
        return fm_refuse(err, FM_REASON_FEED, "a cover of the scene is drawn: feed raster only");
    if (cover->indices != NULL)
        return FM_OK;
    fm_status status = geometry == FM_GEOMETRY_HULL ? make_hull(&solid, stage, err)
                                                    : solid_box(&solid, stage->scene, err);
    if (status == FM_OK)
        status = create_buffers(cover, stage->device, &solid, err);
    solid_free(&solid);
    return status;
}

void stage_destroy_covers(fm_stage *stage)
{
    for (int i = 0; i < FM_GEOMETRY_COUNT; i++) {
        stage->device->ops->buffer_destroy(stage->device, stage->covers[i].vertices);
        stage->device->ops->buffer_destroy(stage->device, stage->covers[i].indices);
    }
}
