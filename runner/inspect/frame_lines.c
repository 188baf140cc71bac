#include "frame_lines.h"

#include <inttypes.h>

static uint32_t least(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

static void add_tile(fm_text *text, const kept_header *header, uint64_t frame,
                     const kept_tile *tile)
{
    const uint32_t across = kept_tiles_across(header);
    const uint32_t x = tile->tile % across * KEPT_TILE_SIDE;
    const uint32_t y = tile->tile / across * KEPT_TILE_SIDE;
    text_add(text, "%" PRIu64 ",%u,%u,%u,%u,%u,%u\n", frame, tile->tile, x, y,
             least(header->width_px - x, KEPT_TILE_SIDE),
             least(header->height_px - y, KEPT_TILE_SIDE), tile->wrong_pixels);
}

void frame_lines_wrong(fm_text *text, frame_counts *counts, const kept_map *frames, uint64_t most)
{
    const kept_tile *tiles = frames->items;
    *counts = (frame_counts){ .frames = frames->header->list_count,
                              .wrong_frames = frames->header->nonempty };
    for (uint64_t frame = 0; frame < frames->header->list_count; frame++)
        for (uint64_t i = frames->offsets[frame]; i < frames->offsets[frame + 1]; i++) {
            counts->wrong_pixels += tiles[i].wrong_pixels;
            if (counts->wrong_tiles++ < most)
                add_tile(text, frames->header, frame, &tiles[i]);
        }
}

static void add_colour(fm_text *text, uint32_t colour)
{
    text_add(text, "%u,%u,%u,%u,", colour & 255u, colour >> 8 & 255u, colour >> 16 & 255u,
             colour >> 24);
}

fm_status frame_lines_add(fm_text *text, uint64_t *wrong, const kept_map *frames, uint64_t frame,
                          const pixel_area *area, fm_error *err)
{
    const kept_header *header = frames->header;
    const pixel_area all = { 0, 0, header->width_px, header->height_px };
    const pixel_area in = area != NULL ? *area : all;
    const uint32_t *pictures[2], across = kept_tiles_across(header);
    *wrong = 0;
    if (frame >= header->list_count)
        return fm_fail(err, FM_INVALID,
                       "frame %" PRIu64 ": the sequence has %" PRIu64 " frames, from 0", frame,
                       header->list_count);
    const uint64_t tiles = frames->offsets[frame + 1] - frames->offsets[frame];
    if (tiles == 0)
        return FM_OK;
    if (!kept_pictures(pictures, frames, frame))
        return fm_fail(err, FM_INVALID,
                       "frame %" PRIu64 ": its %" PRIu64
                       " wrong tiles are known (--wrong lists tiles), but the pictures of the "
                       "first %" PRIu64 " wrong frames alone are kept",
                       frame, tiles,
                       header->word_count / (2 * (uint64_t)header->width_px * header->height_px));
    for (uint32_t y = in.y; y < in.y + in.height; y++)
        for (uint32_t x = in.x; x < in.x + in.width; x++) {
            const uint64_t at = (uint64_t)y * header->width_px + x;
            const bool is_wrong = pictures[0][at] != pictures[1][at];
            *wrong += is_wrong;
            if (!is_wrong && area == NULL)
                continue;
            text_add(text, "%" PRIu64 ",%u,%u,%u,", frame, x, y,
                     y / KEPT_TILE_SIDE * across + x / KEPT_TILE_SIDE);
            add_colour(text, pictures[0][at]);
            add_colour(text, pictures[1][at]);
            text_add(text, "%s\n", is_wrong ? "wrong" : "ok");
        }
    return FM_OK;
}
