#include "frame_sequences.h"

#include <math.h>
#include <stdlib.h>

#include "base/random.h"
#include "scene/frame_builder.h"

enum {
    SUB = FRAMES_SUBPIXELS,
    TEXELS = 65536 / FRAMES_SUBPIXELS, /* u, v: a texel to a pixel */
    BATCH = 8,                         /* sprites of a draw call */
    CELL_PX = 64,                      /* of what changes under a panel */
    BURST = 15,                        /* frames that the camera moves or rests */
    SWING = 24,                        /* frames that a mover goes before it turns */
    GRID_MAX = 64,
    ATTRIBUTE_BYTES = 144,
    VERTEX_BYTES = 48,
    SCALARS = 8,
};

/* What a number is drawn for: sequences that do not touch one another. */
typedef enum drawn_for {
    FOR_CAMERA = 1,
    FOR_SPRITE,
    FOR_OBJECT,
    FOR_BUMP,
    FOR_CHURN,
} drawn_for;

typedef struct generator {
    fm_sequence base;
    fm_settings settings;
    fm_frame_builder builder;
    int32_t width, height;       /* sixteenths */
    uint32_t field;              /* height that opaque panels leave; 1 at least */
    uint32_t *camera_moves;      /* [frame_count]: frames up to this one in which it moved */
    uint32_t object_count, grid; /* each of grid x grid cells */
    uint32_t *object_order;      /* [object_count]: as drawn */
} generator;

/* Uniform in 0..2^32 - 1, a function of its arguments alone. */
static uint32_t draw_number(const generator *g, drawn_for purpose, uint32_t index, uint32_t which)
{
    uint64_t state = g->settings.seed;
    state = random_next(&state) ^ ((uint64_t)purpose << 56 | (uint64_t)which << 32 | index);
    return (uint32_t)(random_next(&state) >> 32);
}

static double draw_unit(const generator *g, drawn_for purpose, uint32_t index, uint32_t which)
{
    return draw_number(g, purpose, index, which) * 0x1p-32;
}

fm_status frames_check_size(const fm_settings *settings, fm_error *err)
{
    if (settings->width_px <= FRAMES_SIDE_MAX && settings->height_px <= FRAMES_SIDE_MAX)
        return FM_OK;
    return fm_fail(err, FM_INVALID, "%u x %u px: sequences of frames end at %d", settings->width_px,
                   settings->height_px, FRAMES_SIDE_MAX);
}

fm_draw_call frames_plain_draw(const fm_settings *settings)
{
    return (fm_draw_call){
        .mask = 15,
        .alpha = 255,
        .vertices = 4,
        .vertex_instructions = (uint16_t)settings->vertex_instructions,
        .fragment_instructions = (uint16_t)settings->fragment_instructions,
        .attribute_bytes = ATTRIBUTE_BYTES,
        .scalars = SCALARS,
        .texture_bytes16 = (uint16_t)lround(settings->texture_bytes * 16),
        .vertex_bytes = VERTEX_BYTES,
    };
}

static fm_draw_call plain_draw(const generator *g, uint32_t texture)
{
    fm_draw_call draw = frames_plain_draw(&g->settings);
    draw.texture = texture;
    return draw;
}

/* Sixteenths of a pixel; uv: where its picture starts. */
typedef struct quad {
    int32_t x0, y0, x1, y1;
    uint32_t u, v;
} quad;

static void add_quad(generator *g, const quad *q)
{
    const uint32_t du = (uint32_t)(q->x1 - q->x0) * TEXELS, dv = (uint32_t)(q->y1 - q->y0) * TEXELS;
    const fm_corner a = { q->x0, q->y0, 0, q->u, q->v }, b = { q->x1, q->y0, 0, q->u + du, q->v };
    const fm_corner c = { q->x1, q->y1, 0, q->u + du, q->v + dv };
    const fm_corner d = { q->x0, q->y1, 0, q->u, q->v + dv };
    frame_builder_triangle(&g->builder, &(fm_triangle){ { a, b, c } });
    frame_builder_triangle(&g->builder, &(fm_triangle){ { a, c, d } });
}

/* How far the camera is, in sixteenths, for what follows it by the given share. */
static int32_t camera(const generator *g, uint32_t frame, double share)
{
    return (int32_t)lround(g->settings.camera_px * SUB * share) * (int32_t)g->camera_moves[frame];
}

/* To and fro, a pixel or more a frame. */
static int32_t swing(uint32_t frame, uint32_t start, int32_t step)
{
    const uint32_t phase = (frame + start) % (2 * SWING);
    return step * (int32_t)(phase < SWING ? phase : 2 * SWING - phase);
}

static void add_backgrounds(generator *g, uint32_t frame)
{
    for (uint32_t i = 0; i < g->settings.backgrounds; i++) {
        const fm_draw_call draw = plain_draw(g, 1 + i);
        const uint32_t moved = (uint32_t)camera(g, frame, 1.0 / (1 + i)) * TEXELS;
        frame_builder_draw(&g->builder, &draw);
        add_quad(g, &(quad){ 0, 0, g->width, g->height, moved, 0 });
    }
}

/* Opaque panels: a bar at the bottom, of the height that makes their share. */
static int32_t opaque_top(const generator *g)
{
    return g->height - (int32_t)lround(g->height * g->settings.hud * g->settings.hud_opaque);
}

/* ---- sprites ---- */

static void add_sprite(generator *g, uint32_t index, uint32_t frame)
{
    const double size = g->settings.object_px * (0.5 + draw_unit(g, FOR_SPRITE, index, 0)) * SUB;
    const int32_t side = (int32_t)lround(size);
    int32_t x = (int32_t)(draw_number(g, FOR_SPRITE, index, 1) % (uint32_t)g->width) - side / 2;
    int32_t y = (int32_t)(draw_number(g, FOR_SPRITE, index, 2) % g->field) - side / 2;
    const uint32_t motion = draw_number(g, FOR_SPRITE, index, 3);
    if (draw_unit(g, FOR_SPRITE, index, 4) < g->settings.moving) {
        x += swing(frame, motion % (2 * SWING), SUB + (int32_t)(motion >> 8 & 15));
        y += swing(frame, motion >> 16 & 31, (int32_t)(motion >> 24 & 15));
    }
    /* The world scrolls round. */
    const int32_t span = g->width + 4 * side;
    x = (x + 2 * side + span - camera(g, frame, 1) % span) % span - 2 * side;
    add_quad(g, &(quad){ x, y, x + side, y + side, index << 20, 0 });
}

static void add_sprites(generator *g, uint32_t frame)
{
    for (uint32_t i = 0; i < g->settings.sprites; i++) {
        if (i % BATCH == 0) {
            fm_draw_call draw = plain_draw(g, 64 + i / BATCH);
            const uint32_t left = g->settings.sprites - i;
            draw.vertices = 4 * (left < BATCH ? left : BATCH);
            if (draw_unit(g, FOR_SPRITE, i, 5) < g->settings.translucent) {
                draw.mix = FM_MIX_OVER;
                draw.alpha = 128;
                draw.flags = FM_DRAW_TEXTURED_ALPHA;
                draw.depth_test = g->settings.triangles > 0 ? FM_COMPARE_LESS : FM_COMPARE_OFF;
            }
            frame_builder_draw(&g->builder, &draw);
        }
        add_sprite(g, i, frame);
    }
}

/* ---- objects with depth ---- */

/* A grid over a rectangle; nearer at its middle. */
typedef struct object {
    int32_t x, y, side; /* sixteenths */
    double depth;       /* 0..1 */
    uint32_t index;
} object;

static fm_corner grid_corner(const generator *g, const object *o, uint32_t i, uint32_t k)
{
    const int32_t n = (int32_t)g->grid;
    const double bump = 0.04 * draw_unit(g, FOR_BUMP, o->index, i * (GRID_MAX + 1) + k);
    const double tilt = 0.03 * ((double)k / n - 0.5);
    const double z = fmin(fmax(o->depth + bump + tilt, 0.0), 0.999);
    return (fm_corner){ .x = o->x + o->side * (int32_t)i / n,
                        .y = o->y + o->side * (int32_t)k / n,
                        .z = (uint32_t)lround(z * FRAMES_DEPTH_MAX),
                        .u = (uint32_t)(o->side * (int32_t)i / n) * TEXELS,
                        .v = (uint32_t)(o->side * (int32_t)k / n) * TEXELS };
}

static void add_grid(generator *g, const object *o)
{
    for (uint32_t k = 0; k < g->grid; k++)
        for (uint32_t i = 0; i < g->grid; i++) {
            const fm_corner a = grid_corner(g, o, i, k), b = grid_corner(g, o, i + 1, k);
            const fm_corner c = grid_corner(g, o, i + 1, k + 1), d = grid_corner(g, o, i, k + 1);
            frame_builder_triangle(&g->builder, &(fm_triangle){ { a, b, c } });
            frame_builder_triangle(&g->builder, &(fm_triangle){ { a, c, d } });
        }
}

static double object_depth(const generator *g, uint32_t index)
{
    return 0.05 + 0.85 * draw_unit(g, FOR_OBJECT, index, 0);
}

/* Near ones are larger and follow the camera further. */
static object place_object(const generator *g, uint32_t index, uint32_t frame)
{
    object o = { .depth = object_depth(g, index), .index = index };
    const double area = g->settings.depth_complexity * (double)g->width * g->height /
                        (g->object_count > 0 ? g->object_count : 1);
    o.side = (int32_t)lround(sqrt(area) * (1.3 - 0.6 * o.depth));
    o.x = (int32_t)(draw_number(g, FOR_OBJECT, index, 1) % (uint32_t)g->width) - o.side / 2;
    o.y = (int32_t)(draw_number(g, FOR_OBJECT, index, 2) % (uint32_t)g->height) - o.side / 2;
    if (draw_unit(g, FOR_OBJECT, index, 3) < g->settings.moving)
        o.x += swing(frame, draw_number(g, FOR_OBJECT, index, 4) % SWING, SUB);
    const int32_t span = g->width + 2 * o.side;
    o.x = (o.x + o.side + span - camera(g, frame, 1.2 - o.depth) % span) % span - o.side;
    return o;
}

static void add_backdrop(generator *g, uint32_t frame)
{
    fm_draw_call draw = plain_draw(g, 32);
    const uint32_t z = (uint32_t)(0.97 * FRAMES_DEPTH_MAX);
    const uint32_t moved = (uint32_t)camera(g, frame, 0.2) * TEXELS;
    draw.flags = FM_DRAW_DEPTH_WRITE;
    draw.depth_test = FM_COMPARE_LESS;
    frame_builder_draw(&g->builder, &draw);
    add_quad(g, &(quad){ 0, 0, g->width, g->height, moved, 0 });
    for (uint32_t i = 1; i <= 2; i++)
        for (int c = 0; c < 3; c++)
            g->builder.frame.triangles[g->builder.frame.triangle_count - i].corners[c].z = z;
}

static void add_objects(generator *g, uint32_t frame)
{
    for (uint32_t i = 0; i < g->object_count; i++) {
        const object o = place_object(g, g->object_order[i], frame);
        fm_draw_call draw = plain_draw(g, 4096 + o.index % 32);
        draw.flags = FM_DRAW_DEPTH_WRITE;
        draw.depth_test = FM_COMPARE_LESS;
        draw.object = (uint16_t)o.index;
        draw.vertices = (g->grid + 1) * (g->grid + 1);
        if (o.x < g->width && o.x + o.side > 0 && o.y < g->height && o.y + o.side > 0) {
            frame_builder_draw(&g->builder, &draw);
            add_grid(g, &o);
        }
    }
    if (g->object_count > 0 && !g->builder.failed)
        add_backdrop(g, frame);
}

/* ---- panels ---- */

static uint32_t count_changes(const generator *g, uint32_t cell, uint32_t frame)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i <= frame; i++)
        count += draw_unit(g, FOR_CHURN, cell, i) < g->settings.hidden_churn;
    return count;
}

static void add_hidden(generator *g, uint32_t frame)
{
    const int32_t cell = CELL_PX * SUB;
    uint32_t index = 0;
    if (!(g->settings.hidden_churn > 0))
        return;
    for (int32_t y = opaque_top(g); y + cell <= g->height; y += cell)
        for (int32_t x = 0; x + cell <= g->width; x += cell, index++) {
            fm_draw_call draw = plain_draw(g, 8192 + index);
            draw.uniforms = count_changes(g, index, frame);
            if (g->settings.triangles > 0) {
                draw.flags = FM_DRAW_DEPTH_WRITE;
                draw.depth_test = FM_COMPARE_LESS;
            }
            frame_builder_draw(&g->builder, &draw);
            add_quad(g, &(quad){ x, y, x + cell, y + cell, 0, 0 });
        }
}

static void add_panels(generator *g)
{
    const int32_t top = opaque_top(g);
    const int32_t glass =
        (int32_t)lround(g->height * g->settings.hud * (1 - g->settings.hud_opaque));
    fm_draw_call draw = plain_draw(g, 16);
    if (top < g->height) {
        frame_builder_draw(&g->builder, &draw);
        add_quad(g, &(quad){ 0, top, g->width, g->height, 0, 0 });
    }
    draw.texture = 17;
    draw.mix = FM_MIX_OVER;
    draw.alpha = 160;
    if (glass > 0) {
        frame_builder_draw(&g->builder, &draw);
        add_quad(g, &(quad){ 0, 0, g->width, glass, 0, 0 });
    }
}

/* ---- the sequence ---- */

static fm_status make_frame(fm_sequence *sequence, const fm_frame **frame, uint32_t index,
                            fm_error *err)
{
    generator *g = (generator *)sequence;
    frame_builder_clear(&g->builder);
    add_backgrounds(g, index);
    add_objects(g, index);
    add_sprites(g, index);
    add_hidden(g, index);
    add_panels(g);
    *frame = &g->builder.frame;
    return g->builder.failed ? fm_fail(err, FM_NO_MEMORY, "no memory for frame %u", index) : FM_OK;
}

static void destroy(fm_sequence *sequence)
{
    generator *g = (generator *)sequence;
    frame_builder_free(&g->builder);
    free(g->camera_moves);
    free(g->object_order);
    free(g);
}

static fm_status make_camera(generator *g, fm_error *err)
{
    g->camera_moves = calloc(g->base.frame_count, sizeof *g->camera_moves);
    if (g->camera_moves == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %u frames", g->base.frame_count);
    for (uint32_t i = 1; i < g->base.frame_count; i++) {
        /* In bursts, of the share asked for up to each of them. */
        const double due = g->settings.camera_moves * (i / BURST + 1) * BURST;
        const bool moves =
            g->camera_moves[i - 1] < (uint32_t)lround(due) || g->settings.camera_moves >= 1;
        g->camera_moves[i] = g->camera_moves[i - 1] + (moves ? 1 : 0);
    }
    return FM_OK;
}

/* An object and when its turn is: the smaller the key, the earlier. */
typedef struct object_turn {
    double key;
    uint32_t index;
} object_turn;

/* Of equal keys the lower index comes first, so that the order is the same on every machine. */
static int compare_turns(const void *left, const void *right)
{
    const object_turn *a = left, *b = right;
    if (a->key < b->key || a->key > b->key)
        return a->key < b->key ? -1 : 1;
    return (a->index > b->index) - (a->index < b->index);
}

/* Depth and chance, mixed, decide in which order objects are drawn. */
static fm_status make_objects(generator *g, fm_error *err)
{
    const fm_settings *s = &g->settings;
    const double side = 4 * s->object_px * SUB;
    const double count = s->depth_complexity * (double)g->width * g->height / (side * side);
    g->object_count = s->triangles > 0 ? (uint32_t)lround(fmin(fmax(count, 1), 60000)) : 0;
    object_turn *turns = calloc(g->object_count + 1, sizeof *turns);
    g->object_order = calloc(g->object_count + 1, sizeof *g->object_order);
    if (turns == NULL || g->object_order == NULL) {
        free(turns);
        return fm_fail(err, FM_NO_MEMORY, "no memory for %u objects", g->object_count);
    }
    const double cells = g->object_count > 0 ? s->triangles / 2.0 / g->object_count : 0;
    g->grid = (uint32_t)fmin(fmax(round(sqrt(cells)), 1), GRID_MAX);
    for (uint32_t i = 0; i < g->object_count; i++)
        turns[i] = (object_turn){ s->front_to_back * object_depth(g, i) +
                                      (1 - s->front_to_back) * draw_unit(g, FOR_OBJECT, i, 5),
                                  i };
    qsort(turns, g->object_count, sizeof *turns, compare_turns);
    for (uint32_t i = 0; i < g->object_count; i++)
        g->object_order[i] = turns[i].index;
    free(turns);
    return FM_OK;
}

fm_status frames_generate(fm_sequence **sequence, const fm_settings *settings, fm_error *err)
{
    *sequence = NULL;
    const fm_status size = frames_check_size(settings, err);
    if (size != FM_OK)
        return size;
    generator *g = calloc(1, sizeof *g);
    if (g == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for a sequence");
    g->base = (fm_sequence){ .width_px = settings->width_px,
                             .height_px = settings->height_px,
                             .frame_count = settings->sequence_frames,
                             .frame = make_frame,
                             .destroy = destroy };
    g->settings = *settings;
    g->width = (int32_t)settings->width_px * SUB;
    g->height = (int32_t)settings->height_px * SUB;
    g->field = opaque_top(g) > 0 ? (uint32_t)opaque_top(g) : 1;
    fm_status status = make_camera(g, err);
    if (status == FM_OK)
        status = make_objects(g, err);
    if (status == FM_OK)
        *sequence = &g->base;
    else
        destroy(&g->base);
    return status;
}
