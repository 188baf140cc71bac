#include "tbr_kit.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "simulator/technique.h"

static void die(const char *what)
{
    fprintf(stderr, "%s\n", what);
    abort();
}

kit_technique kit_technique_open(const char *words)
{
    char copy[256], path[FM_PATH_MAX_BYTES], *rest = copy;
    fm_choice choices[FM_MAX_OPTIONS] = { 0 };
    size_t count = 0;
    kit_technique technique = { 0 };
    fm_error err = { 0 };
    snprintf(copy, sizeof copy, "%s", words);
    const char *id = strsep(&rest, " ");
    snprintf(path, sizeof path, "%s/%s/%s.so", getenv("FRAGMARK_PLUGIN_PATH"), id, id);
    if (plugin_open(&technique.plugin, path, NULL, &err) != FM_OK)
        die(err.message);
    for (char *word; (word = strsep(&rest, " ")) != NULL; count++) {
        const char *value = strchr(word, '=');
        snprintf(choices[count].name, sizeof choices[count].name, "%.*s", (int)(value - word),
                 word);
        snprintf(choices[count].value, sizeof choices[count].value, "%s", value + 1);
    }
    technique.parts = technique_parts(technique.plugin->method, choices, count);
    return technique;
}

void kit_technique_close(kit_technique *technique)
{
    plugin_close(technique->plugin);
    *technique = (kit_technique){ 0 };
}

tbr *kit_gpu(const kit_technique *technique, uint32_t width_px, uint32_t height_px)
{
    fm_error err = { 0 };
    tbr *gpu = NULL;
    const tbr_desc desc = { .width_px = width_px,
                            .height_px = height_px,
                            .technique = technique->plugin->method->technique,
                            .parts = technique->parts,
                            .threads = 1 };
    if (tbr_create(&gpu, &desc, &err) != FM_OK)
        die(err.message);
    return gpu;
}

fm_draw_call kit_draw(void)
{
    return (fm_draw_call){ .mask = 15,
                           .alpha = 255,
                           .vertices = 4,
                           .vertex_instructions = 10,
                           .fragment_instructions = 8,
                           .attribute_bytes = 144,
                           .scalars = 8,
                           .texture_bytes16 = 32,
                           .vertex_bytes = 48 };
}

fm_draw_call kit_woz(void)
{
    fm_draw_call draw = kit_draw();
    draw.flags = FM_DRAW_DEPTH_WRITE;
    draw.depth_test = FM_COMPARE_LESS;
    return draw;
}

void kit_random(kit_sequence *sequence, uint64_t seed, uint32_t flags)
{
    fm_adversary adversary;
    adversary_start(&adversary,
                    &(fm_adversary_desc){ .seed = seed, .flags = flags, .plain = kit_draw() });
    sequence->width_px = (uint32_t)adversary.width;
    sequence->height_px = (uint32_t)adversary.height;
    sequence->count = KIT_MAX_FRAMES;
    for (uint32_t i = 0; i < KIT_MAX_FRAMES; i++) {
        adversary_frame(&sequence->frames[i], &adversary);
        assert(!sequence->frames[i].failed);
    }
}

void kit_sequence_free(kit_sequence *sequence)
{
    for (uint32_t i = 0; i < KIT_MAX_FRAMES; i++)
        frame_builder_free(&sequence->frames[i]);
}
