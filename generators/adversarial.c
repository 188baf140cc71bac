#include "adversarial.h"

#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "frame_sequences.h"

static uint32_t below(fm_adversary *s, uint32_t bound)
{
    return random_below(&s->state, bound);
}

static bool one_in(fm_adversary *s, uint32_t count)
{
    return below(s, count) == 0;
}

static void place(fm_adversary *s, fm_adverse_thing *t)
{
    const uint32_t kind = below(s, 4);
    const int32_t w = s->width, h = s->height;
    const int32_t x = (int32_t)below(s, (uint32_t)w), y = (int32_t)below(s, (uint32_t)h);
    const int32_t whole[4] = { -1, -1, w + 1, h + 1 }, left[4] = { 0, 0, x + 1, h };
    const int32_t some[4] = { x - 6, y - 6, x + 10, y + 9 };
    memcpy(t->px, kind < 2 ? whole : kind == 2 ? left : some, sizeof t->px);
}

static void make_depth(fm_adversary *s, fm_adverse_thing *t)
{
    const uint32_t step = FRAMES_DEPTH_MAX / 16;
    t->z = (1 + below(s, 14)) * step;
    if ((s->desc.flags & ADVERSE_TIES) == 0)
        t->z += s->next_id; /* no two things at one depth */
    else if (one_in(s, 2))
        t->draw.depth_test = FM_COMPARE_LESS_EQUAL;
}

static void make_nwoz(fm_adversary *s, fm_draw_call *draw)
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

static void make_barrier(fm_adversary *s, fm_draw_call *draw)
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

static void make_thing(fm_adversary *s, fm_adverse_thing *t)
{
    *t = (fm_adverse_thing){ .draw = s->desc.plain };
    t->draw.flags = FM_DRAW_DEPTH_WRITE;
    t->draw.depth_test = FM_COMPARE_LESS;
    t->draw.texture = ++s->next_id;
    t->draw.object = (uint16_t)(s->next_id % 7);
    make_depth(s, t);
    place(s, t);
    if ((s->desc.flags & ADVERSE_CLEARS) != 0 && one_in(s, 16)) {
        t->is_clear = true;
        t->draw.flags = FM_DRAW_DEPTH_CLEAR;
        t->draw.clear_depth = one_in(s, 2) ? FRAMES_DEPTH_MAX : t->z;
        return;
    }
    if ((s->desc.flags & ADVERSE_BARRIERS) != 0 && one_in(s, 5))
        make_barrier(s, &t->draw);
    if ((s->desc.flags & ADVERSE_NWOZ) != 0 && one_in(s, 2))
        make_nwoz(s, &t->draw);
    t->draw.flags |= (s->desc.flags & ADVERSE_DISCARD) != 0 && one_in(s, 6) ? FM_DRAW_DISCARD : 0u;
    t->draw.flags |=
        (s->desc.flags & ADVERSE_SHADER_DEPTH) != 0 && one_in(s, 8) ? FM_DRAW_SHADER_DEPTH : 0u;
    t->is_sloped = (s->desc.flags & ADVERSE_SLOPED) != 0 && one_in(s, 2);
    t->shape = random_next(&s->state);
}

static void draw_sloped(fm_frame_builder *builder, const fm_adverse_thing *t)
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

static void emit(fm_frame_builder *builder, const fm_adversary *s)
{
    for (uint32_t i = 0; i < s->count; i++) {
        const fm_adverse_thing *t = &s->things[i];
        frame_builder_draw(builder, &t->draw);
        if (t->is_sloped)
            draw_sloped(builder, t);
        else if (!t->is_clear)
            frame_builder_quad(builder, t->px, t->z);
    }
}

static void remove_thing(fm_adversary *s, uint32_t at)
{
    memmove(&s->things[at], &s->things[at + 1], (s->count - at - 1) * sizeof s->things[0]);
    s->count--;
}

static void insert_thing(fm_adversary *s, uint32_t at)
{
    memmove(&s->things[at + 1], &s->things[at], (s->count - at) * sizeof s->things[0]);
    s->count++;
    make_thing(s, &s->things[at]);
}

static void change(fm_adversary *s)
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
        if (s->count < FM_ADVERSARY_DRAWS)
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

void adversary_start(fm_adversary *made, const fm_adversary_desc *desc)
{
    *made = (fm_adversary){ .desc = *desc, .state = desc->seed * 0x9E3779B97F4A7C15u + 1 };
    const bool is_chosen = desc->width_px == 0;
    made->width = is_chosen ? 5 + (int32_t)below(made, 20) : (int32_t)desc->width_px;
    made->height = is_chosen ? 5 + (int32_t)below(made, 20) : (int32_t)desc->height_px;
    const uint32_t start = 1 + below(made, 5);
    while (made->count < start)
        insert_thing(made, made->count);
    made->is_near = (desc->flags & ADVERSE_FAR_CLEAR) != 0 && one_in(made, 4);
}

void adversary_frame(fm_frame_builder *builder, fm_adversary *adversary)
{
    frame_builder_clear(builder);
    if (adversary->is_near)
        builder->frame.clear_depth = FRAMES_DEPTH_MAX / 2;
    emit(builder, adversary);
    for (uint32_t times = below(adversary, 3);
         (adversary->desc.flags & ADVERSE_STATIC) == 0 && times > 0; times--)
        change(adversary);
}

typedef struct generator {
    fm_sequence base;
    fm_adversary_desc desc;
    fm_adversary now;
    fm_frame_builder builder;
    uint32_t made; /* frames, since the start; the last is in builder */
} generator;

/* Frames follow one another: for an earlier one all is made again. */
static fm_status make_frame(fm_sequence *sequence, const fm_frame **frame, uint32_t index,
                            fm_error *err)
{
    generator *g = (generator *)sequence;
    if (index + 1 < g->made || g->made == 0) {
        adversary_start(&g->now, &g->desc);
        g->made = 0;
    }
    for (; g->made <= index; g->made++)
        adversary_frame(&g->builder, &g->now);
    *frame = &g->builder.frame;
    return g->builder.failed ? fm_fail(err, FM_NO_MEMORY, "no memory for frame %u", index) : FM_OK;
}

static void destroy(fm_sequence *sequence)
{
    generator *g = (generator *)sequence;
    frame_builder_free(&g->builder);
    free(g);
}

fm_status adversarial_generate(fm_sequence **sequence, const fm_settings *settings, fm_error *err)
{
    *sequence = NULL;
    const fm_status status = frames_check_size(settings, err);
    if (status != FM_OK)
        return status;
    generator *g = calloc(1, sizeof *g);
    if (g == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for a sequence");
    g->base = (fm_sequence){ .width_px = settings->width_px,
                             .height_px = settings->height_px,
                             .frame_count = settings->sequence_frames,
                             .frame = make_frame,
                             .destroy = destroy };
    g->desc = (fm_adversary_desc){ .seed = settings->seed,
                                   .flags = ADVERSE_ALL,
                                   .width_px = settings->width_px,
                                   .height_px = settings->height_px,
                                   .plain = frames_plain_draw(settings) };
    *sequence = &g->base;
    return FM_OK;
}
