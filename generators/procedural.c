#include "procedural.h"
#include "scene/placement.h"

#include <inttypes.h>
#include <stdlib.h>

static void (*build_of(fm_generator generator))(fm_builder *)
{
    switch (generator) {
    case FM_GENERATOR_PALACE:
        return palace_build;
    case FM_GENERATOR_HAIRBALL:
        return hairball_build;
    case FM_GENERATOR_ENGINE:
        return engine_build;
    case FM_GENERATOR_TEMPLE:
        return temple_build;
    case FM_GENERATOR_HOTEL:
        return hotel_build;
    case FM_GENERATOR_IVY:
        return ivy_build;
    case FM_GENERATOR_LAYERS:
    case FM_GENERATOR_MESH:
    case FM_GENERATOR_FRAMES:
    case FM_GENERATOR_STREAM:
    case FM_GENERATOR_ADVERSARIAL:
    case FM_GENERATOR_BUNNY_IN_CUBE:
    case FM_GENERATOR_COUNT:
        break;
    }
    return NULL;
}

/* On success the caller frees *builder, which has all counts. */
static fm_status build(fm_builder **builder, const fm_settings *settings, const fm_mesh_sink *sink,
                       fm_error *err)
{
    void (*const make)(fm_builder *) = build_of(settings->generator);
    *builder = NULL;
    fm_builder *b = malloc(sizeof *b);
    if (b == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%zu bytes to build a mesh in", sizeof *b);
    builder_begin(b, settings, sink, err);
    make(b);
    const fm_status status = builder_end(b);
    if (status == FM_OK)
        *builder = b;
    else
        free(b);
    return status;
}

static fm_status make_mesh(const fm_scene *scene, const fm_mesh_sink *sink, fm_error *err)
{
    fm_builder *built;
    const fm_status status = build(&built, &scene->settings, sink, err);
    free(built);
    return status;
}

fm_status procedural_generate(fm_scene *scene, fm_error *err)
{
    fm_builder *counted;
    fm_status status = build(&counted, &scene->settings, NULL, err);
    if (status != FM_OK)
        return status;
    scene->vertex_count = counted->vertex_count;
    scene->index_count = counted->index_count;
    scene->parts = counted->parts;
    scene->make_mesh = make_mesh;
    status = scene_place(scene, &scene->settings, &counted->box, err);
    free(counted);
    return status;
}
