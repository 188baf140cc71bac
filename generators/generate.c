#include "generate.h"

#include <stdlib.h>

#include "adversarial.h"
#include "frame_sequences.h"
#include "procedural.h"
#include "scene/frame_stream.h"
#include "scene/mesh.h"
#include "scene/placement.h"

static fm_status fill_mesh(fm_scene *scene, fm_error *err)
{
    fm_box box;
    const fm_status status = mesh_read(scene, &box, err);
    return status == FM_OK ? scene_place(scene, &scene->settings, &box, err) : status;
}

static fm_status fill(fm_scene *scene, fm_error *err)
{
    switch (scene->settings.generator) {
    case FM_GENERATOR_LAYERS:
        return layers_generate(scene, err);
    case FM_GENERATOR_MESH:
        return fill_mesh(scene, err);
    case FM_GENERATOR_BUNNY_IN_CUBE:
        return bunny_in_cube_generate(scene, err);
    case FM_GENERATOR_PALACE:
    case FM_GENERATOR_HAIRBALL:
    case FM_GENERATOR_ENGINE:
    case FM_GENERATOR_TEMPLE:
    case FM_GENERATOR_HOTEL:
    case FM_GENERATOR_IVY:
        return procedural_generate(scene, err);
    case FM_GENERATOR_FRAMES:
    case FM_GENERATOR_STREAM:
    case FM_GENERATOR_ADVERSARIAL:
    case FM_GENERATOR_COUNT:
        break; /* no scene of fragments: frames.h */
    }
    return fm_fail(err, FM_INVALID, "generator %s: its scenes are for feed frames",
                   key_find("generator")->values[scene->settings.generator]);
}

fm_status scene_create(fm_scene **scene, const fm_settings *settings, fm_error *err)
{
    *scene = NULL;
    fm_scene *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "scene: %zu bytes", sizeof *made);
    made->settings = *settings;
    made->width_px = settings->width_px;
    made->height_px = settings->height_px;
    const fm_status status = fill(made, err);
    if (status != FM_OK) {
        scene_destroy(made);
        return status;
    }
    settings_scene_hash(made->hash, settings);
    *scene = made;
    return FM_OK;
}

static fm_status replay(fm_sequence **sequence, const fm_settings *settings, fm_error *err)
{
    const fm_stream_costs costs = {
        .vertex_instructions = (uint16_t)settings->vertex_instructions,
        .fragment_instructions = (uint16_t)settings->fragment_instructions,
        .texture_bytes = settings->texture_bytes,
    };
    const fm_status status =
        stream_open(sequence, settings->stream, settings->sequence_frames, &costs, err);
    if (status != FM_OK || ((*sequence)->width_px == settings->width_px &&
                            (*sequence)->height_px == settings->height_px))
        return status;
    return fm_fail(err, FM_INVALID, "%s: recorded at %u x %u px, asked for at %u x %u",
                   settings->stream, (*sequence)->width_px, (*sequence)->height_px,
                   settings->width_px, settings->height_px);
}

fm_status sequence_create(fm_sequence **sequence, const fm_settings *settings, fm_error *err)
{
    if (settings->generator == FM_GENERATOR_STREAM)
        return replay(sequence, settings, err);
    if (settings->generator == FM_GENERATOR_ADVERSARIAL)
        return adversarial_generate(sequence, settings, err);
    return frames_generate(sequence, settings, err);
}
