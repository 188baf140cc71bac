/* tbr_bench [SECONDS]: how fast the simulated GPU draws, in fragments a second and core, and what
 * its parts cost where they run: all techniques on a scene without layers to keep and on one with,
 * and layers kept although nothing needs them. Not a test: nothing here decides anything. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "generators/frame_sequences.h"
#include "tbr_kit.h"

enum { FRAMES = 6, WIDTH = 1196, HEIGHT = 768 };

static const char *const techniques[] = { "tbr-base",        "tbr-re",       "tbr-evr-reorder",
                                          "tbr-evr",         "tbr-evr-safe", "tbr-z-prepass",
                                          "tbr-oracle-tile", "tbr-vro-lite", "tbr-te" };

typedef struct bench_scene {
    const char *name;
    uint32_t backgrounds, sprites, triangles;
    double hud;
    bool keep_layers;
} bench_scene;
/* The first has depth writers alone: nothing tells layers apart. */
static const bench_scene scenes[] = { { "depth only", 0, 0, 4000, 0, false },
                                      { "depth only, layers kept", 0, 0, 4000, 0, true },
                                      { "sprites over depth", 2, 120, 4000, 0.2, false } };

static void fail(const fm_error *err)
{
    fprintf(stderr, "%s\n", err->message);
    abort();
}

static fm_sequence *make_sequence(const bench_scene *scene)
{
    fm_settings settings;
    fm_sequence *sequence = NULL;
    fm_error err = { 0 };
    settings_default(&settings);
    settings.width_px = WIDTH;
    settings.height_px = HEIGHT;
    settings.sequence_frames = FRAMES;
    settings.backgrounds = scene->backgrounds;
    settings.sprites = scene->sprites;
    settings.triangles = scene->triangles;
    settings.hud = scene->hud;
    settings.camera_px = 3; /* everything moves: nothing is skipped */
    if (frames_generate(&sequence, &settings, &err) != FM_OK)
        fail(&err);
    return sequence;
}

static tbr *make_gpu(const kit_technique *technique, bool keep_layers)
{
    fm_error err = { 0 };
    tbr *gpu = NULL;
    const tbr_desc desc = { .width_px = WIDTH,
                            .height_px = HEIGHT,
                            .technique = technique->plugin->method->technique,
                            .parts = technique->parts,
                            .threads = 1,
                            .keep_layers = keep_layers };
    if (tbr_create(&gpu, &desc, &err) != FM_OK)
        fail(&err);
    return gpu;
}

/* Fragments rasterised in a second; *layers: lookups of the layer generator. */
static double measure(uint64_t *layers, const char *words, const bench_scene *scene,
                      double wanted_s)
{
    kit_technique technique = kit_technique_open(words);
    fm_sequence *sequence = make_sequence(scene);
    tbr *gpu = make_gpu(&technique, scene->keep_layers);
    double fragments = 0, seconds = 0;
    fm_error err = { 0 };
    *layers = 0;
    for (uint32_t i = 0; seconds < wanted_s; i++) {
        const fm_frame *frame = NULL;
        if (sequence->frame(sequence, &frame, i % FRAMES, &err) != FM_OK)
            fail(&err);
        const double begin = clock_s();
        if (tbr_frame(gpu, frame, &err) != FM_OK)
            fail(&err);
        seconds += clock_s() - begin;
        fragments += (double)tbr_counts(gpu)->fragments_rasterised;
        *layers += tbr_counts(gpu)->layer_lookups;
    }
    tbr_destroy(gpu);
    sequence_destroy(sequence);
    kit_technique_close(&technique);
    return fragments / seconds;
}

int main(int argc, char **argv)
{
    const double seconds = argc > 1 ? atof(argv[1]) : 0.5;
    printf("%-26s%-18s%14s%12s\n", "scene", "technique", "fragments/s", "layers");
    for (size_t s = 0; s < sizeof scenes / sizeof scenes[0]; s++)
        for (size_t t = 0; t < sizeof techniques / sizeof techniques[0]; t++) {
            uint64_t layers = 0;
            const double rate = measure(&layers, techniques[t], &scenes[s], seconds);
            printf("%-26s%-18s%12.1f M%12s\n", scenes[s].name, techniques[t], rate * 1e-6,
                   layers > 0 ? "kept" : "-");
        }
    return 0;
}
