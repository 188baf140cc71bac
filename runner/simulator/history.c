#include "history.h"

#include <stdlib.h>
#include <string.h>

enum { OBJECTS = 1 << 16, FIRST_ROOM = 256 };
#define NOT_SEEN UINT32_MAX

typedef struct texture_seen {
    uint32_t texture, version;
    bool is_used;
} texture_seen;

typedef struct keyed_draw {
    uint32_t depth, draw;
} keyed_draw;

struct history {
    uint32_t depths[OBJECTS], last_depths[OBJECTS]; /* nearest corner; NOT_SEEN */
    texture_seen *textures;                         /* [room], open addressing */
    uint32_t texture_count, texture_room;
    keyed_draw *keyed;
    uint32_t keyed_room;
};

fm_status history_create(history **made, fm_error *err)
{
    *made = calloc(1, sizeof **made);
    if (*made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for what the last frame was");
    memset((*made)->depths, 255, sizeof(*made)->depths);
    return FM_OK;
}

void history_destroy(history *self)
{
    if (self == NULL)
        return;
    free(self->textures);
    free(self->keyed);
    free(self);
}

/* ---- textures ---- */

/* Its place, or the free one that it would have. */
static texture_seen *find_texture(texture_seen *textures, uint32_t room, uint32_t texture)
{
    uint32_t at = texture * 0x9E3779B1u % room;
    while (textures[at].is_used && textures[at].texture != texture)
        at = (at + 1) % room;
    return &textures[at];
}

/* At most half of the places are in use. */
static bool make_texture_room(history *self)
{
    if (2 * self->texture_count < self->texture_room)
        return true;
    const uint32_t room = self->texture_room > 0 ? 2 * self->texture_room : FIRST_ROOM;
    texture_seen *grown = room > self->texture_room ? calloc(room, sizeof *grown) : NULL;
    if (grown == NULL)
        return false;
    for (uint32_t i = 0; i < self->texture_room; i++)
        if (self->textures[i].is_used)
            *find_texture(grown, room, self->textures[i].texture) = self->textures[i];
    free(self->textures);
    self->textures = grown;
    self->texture_room = room;
    return true;
}

fm_status history_uploads(bool *has_uploads, history *self, const fm_frame *frame, fm_error *err)
{
    *has_uploads = false;
    for (uint32_t i = 0; i < frame->draw_count; i++) {
        const fm_draw_call *draw = &frame->draws[i];
        if (!make_texture_room(self))
            return fm_fail(err, FM_NO_MEMORY, "no memory for %u textures", self->texture_count);
        texture_seen *seen = find_texture(self->textures, self->texture_room, draw->texture);
        *has_uploads = *has_uploads || (seen->is_used && seen->version != draw->texture_version);
        self->texture_count += !seen->is_used;
        *seen = (texture_seen){ draw->texture, draw->texture_version, true };
    }
    return FM_OK;
}

/* ---- objects ---- */

static int compare_keyed(const void *left, const void *right)
{
    const keyed_draw *a = left, *b = right;
    if (a->depth != b->depth)
        return a->depth < b->depth ? -1 : 1;
    return (a->draw > b->draw) - (a->draw < b->draw);
}

static void note_depths(history *self, const fm_frame *frame, const bool *may_move)
{
    memcpy(self->last_depths, self->depths, sizeof self->depths);
    memset(self->depths, 255, sizeof self->depths);
    for (uint32_t i = 0; i < frame->draw_count; i++) {
        const fm_draw_call *draw = &frame->draws[i];
        uint32_t *nearest = &self->depths[draw->object];
        for (uint32_t k = 0; may_move[i] && k < 3 * draw->count; k++) {
            const uint32_t z = frame->triangles[draw->first + k / 3].corners[k % 3].z;
            *nearest = z < *nearest ? z : *nearest;
        }
    }
}

static bool make_keyed_room(history *self, uint32_t wanted)
{
    keyed_draw *grown =
        wanted > self->keyed_room ? reallocarray(self->keyed, wanted, sizeof *grown) : self->keyed;
    if (grown == NULL)
        return wanted == 0;
    self->keyed_room = wanted > self->keyed_room ? wanted : self->keyed_room;
    self->keyed = grown;
    return true;
}

fm_status history_order(uint32_t *order, history *self, const fm_frame *frame, const bool *may_move,
                        fm_error *err)
{
    if (!make_keyed_room(self, frame->draw_count))
        return fm_fail(err, FM_NO_MEMORY, "no memory to order %u draw calls", frame->draw_count);
    note_depths(self, frame, may_move);
    for (uint32_t i = 0; i < frame->draw_count; i++)
        self->keyed[i] = (keyed_draw){ self->last_depths[frame->draws[i].object], i };
    for (uint32_t first = 0, end; first < frame->draw_count; first = end) {
        end = first + 1;
        while (may_move[first] && end < frame->draw_count && may_move[end])
            end++;
        qsort(&self->keyed[first], end - first, sizeof *self->keyed, compare_keyed);
    }
    for (uint32_t i = 0; i < frame->draw_count; i++)
        order[i] = self->keyed[i].draw;
    return FM_OK;
}
