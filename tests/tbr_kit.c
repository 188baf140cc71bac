#include "tbr_kit.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "stats.h"
#include "technique.h"

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
    if (plugin_open(&technique.plugin, path, &err) != FM_OK)
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

static fm_corner corner(int32_t x, int32_t y, uint32_t z)
{
    return (fm_corner){ x * FRAMES_SUBPIXELS, y * FRAMES_SUBPIXELS, z, (uint32_t)x << 16,
                        (uint32_t)y << 16 };
}

void kit_quad(fm_frame_builder *builder, const int32_t px[4], uint32_t z)
{
    const fm_corner a = corner(px[0], px[1], z), b = corner(px[2], px[1], z);
    const fm_corner c = corner(px[2], px[3], z), d = corner(px[0], px[3], z);
    frame_builder_triangle(builder, &(fm_triangle){ { a, b, c } });
    frame_builder_triangle(builder, &(fm_triangle){ { a, c, d } });
}

/* ---- random sequences ---- */

typedef struct thing {
    fm_draw_call draw;
    int32_t px[4];
    uint32_t z;
    bool is_sloped, is_clear;
    uint64_t shape; /* of what is sloped */
} thing;

typedef struct scene {
    uint64_t state;
    uint32_t flags, next_id;
    int32_t width, height;
    thing things[KIT_MAX_DRAWS];
    uint32_t count;
} scene;

static uint32_t below(scene *s, uint32_t bound)
{
    return random_below(&s->state, bound);
}

static bool one_in(scene *s, uint32_t of)
{
    return below(s, of) == 0;
}

static void place(scene *s, thing *t)
{
    const uint32_t kind = below(s, 4);
    const int32_t w = s->width, h = s->height;
    const int32_t x = (int32_t)below(s, (uint32_t)w), y = (int32_t)below(s, (uint32_t)h);
    const int32_t whole[4] = { -1, -1, w + 1, h + 1 }, left[4] = { 0, 0, x + 1, h };
    const int32_t some[4] = { x - 6, y - 6, x + 10, y + 9 };
    memcpy(t->px, kind < 2 ? whole : kind == 2 ? left : some, sizeof t->px);
}

static void make_depth(scene *s, thing *t)
{
    const uint32_t step = FRAMES_DEPTH_MAX / 16;
    t->z = (1 + below(s, 14)) * step;
    if ((s->flags & KIT_TIES) == 0)
        t->z += s->next_id; /* no two things at one depth */
    else if (one_in(s, 2))
        t->draw.depth_test = FM_COMPARE_LESS_EQUAL;
}

static void make_nwoz(scene *s, fm_draw_call *draw)
{
    draw->flags &= ~(uint32_t)FM_DRAW_DEPTH_WRITE;
    if (one_in(s, 2))
        draw->depth_test = FM_COMPARE_OFF;
    if (one_in(s, 3)) {
        draw->mix = one_in(s, 3) ? FM_MIX_ADD : FM_MIX_OVER;
        draw->alpha = (uint8_t)(one_in(s, 3) ? 255 : 100);
        draw->flags |= one_in(s, 3) ? FM_DRAW_TEXTURED_ALPHA : 0u;
    }
}

static void make_barrier(scene *s, fm_draw_call *draw)
{
    static const fm_compare tests[] = { FM_COMPARE_ALWAYS,        FM_COMPARE_GREATER,
                                        FM_COMPARE_GREATER_EQUAL, FM_COMPARE_NOT_EQUAL,
                                        FM_COMPARE_EQUAL,         FM_COMPARE_NEVER };
    switch (below(s, 4)) {
    case 0:
        draw->mix = FM_MIX_OVER;
        draw->alpha = (uint8_t)(one_in(s, 2) ? 255 : 90);
        draw->flags |= one_in(s, 2) ? FM_DRAW_TEXTURED_ALPHA : 0u;
        return;
    case 1:
        draw->mask = (uint8_t)below(s, 16);
        return;
    case 2:
        draw->depth_test = tests[below(s, sizeof tests / sizeof tests[0])];
        return;
    default:
        draw->flags |= FM_DRAW_STENCIL;
    }
}

static void make_thing(scene *s, thing *t)
{
    *t = (thing){ .draw = kit_woz() };
    t->draw.texture = ++s->next_id;
    t->draw.object = (uint16_t)(s->next_id % 7);
    make_depth(s, t);
    place(s, t);
    if ((s->flags & KIT_CLEARS) != 0 && one_in(s, 16)) {
        t->is_clear = true;
        t->draw.flags = FM_DRAW_DEPTH_CLEAR;
        t->draw.clear_depth = one_in(s, 2) ? FRAMES_DEPTH_MAX : t->z;
        return;
    }
    if ((s->flags & KIT_BARRIERS) != 0 && one_in(s, 5))
        make_barrier(s, &t->draw);
    if ((s->flags & KIT_NWOZ) != 0 && one_in(s, 2))
        make_nwoz(s, &t->draw);
    t->draw.flags |= (s->flags & KIT_DISCARD) != 0 && one_in(s, 6) ? FM_DRAW_DISCARD : 0u;
    t->draw.flags |= (s->flags & KIT_SHADER_DEPTH) != 0 && one_in(s, 8) ? FM_DRAW_SHADER_DEPTH : 0u;
    t->is_sloped = (s->flags & KIT_SLOPED) != 0 && one_in(s, 2);
    t->shape = random_next(&s->state);
}

static void draw_sloped(fm_frame_builder *builder, const thing *t)
{
    fm_triangle triangle;
    uint64_t state = t->shape;
    const uint32_t step = FRAMES_DEPTH_MAX / 16;
    for (int i = 0; i < 3; i++) {
        const int32_t x =
            t->px[i == 1 ? 2 : 0] * FRAMES_SUBPIXELS + (int32_t)random_below(&state, 64);
        const int32_t y =
            t->px[i == 2 ? 3 : 1] * FRAMES_SUBPIXELS + (int32_t)random_below(&state, 64);
        const uint32_t z = t->z / 2 + random_below(&state, 7 * step);
        triangle.corners[i] = (fm_corner){ x, y, z, (uint32_t)x << 12, (uint32_t)y << 12 };
    }
    frame_builder_triangle(builder, &triangle);
}

static void emit(fm_frame_builder *builder, const scene *s)
{
    for (uint32_t i = 0; i < s->count; i++) {
        const thing *t = &s->things[i];
        frame_builder_draw(builder, &t->draw);
        if (t->is_sloped)
            draw_sloped(builder, t);
        else if (!t->is_clear)
            kit_quad(builder, t->px, t->z);
    }
}

static void remove_thing(scene *s, uint32_t at)
{
    memmove(&s->things[at], &s->things[at + 1], (s->count - at - 1) * sizeof s->things[0]);
    s->count--;
}

static void insert_thing(scene *s, uint32_t at)
{
    memmove(&s->things[at + 1], &s->things[at], (s->count - at) * sizeof s->things[0]);
    s->count++;
    make_thing(s, &s->things[at]);
}

static void change(scene *s)
{
    if (s->count == 0) {
        insert_thing(s, 0);
        return;
    }
    const uint32_t at = below(s, s->count);
    switch (below(s, 6)) {
    case 0:
        remove_thing(s, at);
        return;
    case 1:
        if (s->count < KIT_MAX_DRAWS)
            insert_thing(s, at);
        return;
    case 2:
        place(s, &s->things[at]);
        return;
    case 3:
        make_depth(s, &s->things[at]);
        return;
    case 4:
        s->things[at].draw.texture_version++;
        return;
    default:
        make_thing(s, &s->things[at]);
    }
}

void kit_random(kit_sequence *sequence, uint64_t seed, uint32_t flags)
{
    scene s = { .state = seed * 0x9E3779B97F4A7C15u + 1, .flags = flags };
    s.width = 5 + (int32_t)below(&s, 20);
    s.height = 5 + (int32_t)below(&s, 20);
    sequence->width_px = (uint32_t)s.width;
    sequence->height_px = (uint32_t)s.height;
    sequence->count = KIT_MAX_FRAMES;
    const uint32_t start = 1 + below(&s, 5);
    while (s.count < start)
        insert_thing(&s, s.count);
    const bool is_near = (flags & KIT_FAR_CLEAR) != 0 && one_in(&s, 4);
    for (uint32_t i = 0; i < KIT_MAX_FRAMES; i++) {
        frame_builder_clear(&sequence->frames[i]);
        if (is_near)
            sequence->frames[i].frame.clear_depth = FRAMES_DEPTH_MAX / 2;
        emit(&sequence->frames[i], &s);
        assert(!sequence->frames[i].failed);
        for (uint32_t times = below(&s, 3); (flags & KIT_STATIC) == 0 && times > 0; times--)
            change(&s);
    }
}

void kit_sequence_free(kit_sequence *sequence)
{
    for (uint32_t i = 0; i < KIT_MAX_FRAMES; i++)
        frame_builder_free(&sequence->frames[i]);
}
