#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "technique_internal.h"

enum { TRUTH_MAX_BYTES = 1 << 30 };
static const char truth_magic[8] = "fmtbr 2";

static size_t truth_bytes(const sequence_truth_header *header)
{
    return sizeof *header + (size_t)header->frame_count * header->tile_count * 8;
}

static uint64_t *truth_hashes(const sequence_truth *truth, uint32_t frame)
{
    return (uint64_t *)(void *)(truth->bytes + sizeof truth->header) +
           (size_t)frame * truth->header.tile_count;
}

static sequence_truth_header expected_header(const technique_run *run)
{
    sequence_truth_header header = { .width_px = run->sequence->width_px,
                                     .height_px = run->sequence->height_px,
                                     .frame_count = run->sequence->frame_count,
                                     .tile_count = tbr_tile_count(run->gpu) };
    memcpy(header.magic, truth_magic, sizeof header.magic);
    return header;
}

fm_status technique_truth_make(technique_run *run, fm_error *err)
{
    run->truth.header = expected_header(run);
    run->truth.count = truth_bytes(&run->truth.header);
    run->truth.bytes = calloc(1, run->truth.count);
    if (run->truth.bytes == NULL)
        return fm_fail(err, FM_NO_MEMORY, "truth: %zu bytes", run->truth.count);
    memcpy(run->truth.bytes, &run->truth.header, sizeof run->truth.header);
    return FM_OK;
}

fm_status technique_truth_read(technique_run *run, fm_error *err)
{
    const sequence_truth_header expected = expected_header(run);
    const char *path = run->job->truth;
    fm_status status =
        text_read_file(&run->truth.bytes, &run->truth.count, path, TRUTH_MAX_BYTES, err);
    if (status != FM_OK)
        return status;
    if (run->truth.count != truth_bytes(&expected) ||
        memcmp(run->truth.bytes, &expected, sizeof expected) != 0)
        return fm_fail(err, FM_IO, "%s: not the truth of this sequence", path);
    run->truth.header = expected;
    return FM_OK;
}

static uint64_t hash_tile(const sequence_truth *truth, const tbr *gpu, uint32_t tile)
{
    const uint32_t width = truth->header.width_px, across = tbr_tiles_across(gpu);
    const uint32_t x = tile % across * FM_TILE_SIDE, y = tile / across * FM_TILE_SIDE;
    const uint32_t columns = width - x < FM_TILE_SIDE ? width - x : FM_TILE_SIDE;
    const uint32_t left = truth->header.height_px - y;
    uint64_t hash = 0;
    for (uint32_t row = 0; row < (left < FM_TILE_SIDE ? left : FM_TILE_SIDE); row++)
        hash = XXH64(tbr_image(gpu) + (size_t)(y + row) * width + x, 4 * columns, hash);
    return hash;
}

void technique_truth_add(const sequence_truth *truth, const tbr *gpu, uint32_t frame)
{
    for (uint32_t tile = 0; tile < truth->header.tile_count; tile++)
        truth_hashes(truth, frame)[tile] = hash_tile(truth, gpu, tile);
}

uint64_t technique_wrong_tiles(const sequence_truth *truth, const tbr *gpu, uint32_t frame)
{
    uint64_t wrong = 0;
    for (uint32_t tile = 0; tile < truth->header.tile_count; tile++)
        wrong += hash_tile(truth, gpu, tile) != truth_hashes(truth, frame)[tile];
    return wrong;
}

fm_status technique_keep_begin(technique_run *run, fm_error *err)
{
    _Static_assert((int)KEPT_TILE_SIDE == (int)FM_TILE_SIDE,
                   "a tile of the file is one of the GPU");
    const kept_header header = { .kind = KEPT_FRAMES,
                                 .width_px = run->sequence->width_px,
                                 .height_px = run->sequence->height_px,
                                 .list_count = run->sequence->frame_count };
    if (run->job->keep == NULL || run->job->keep[0] == '\0')
        return FM_OK;
    run->kept_tiles = calloc(tbr_tile_count(run->gpu), sizeof *run->kept_tiles);
    if (run->kept_tiles == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory for its tiles", run->job->keep);
    return kept_begin(&run->kept, run->job->keep, &header, err);
}

/* Pixels of each tile in which the two pictures differ. */
static void count_wrong_pixels(technique_run *run, const uint32_t *drawn, const uint32_t *right)
{
    const uint32_t width = run->sequence->width_px, across = tbr_tiles_across(run->gpu);
    memset(run->kept_tiles, 0, tbr_tile_count(run->gpu) * sizeof *run->kept_tiles);
    for (uint32_t y = 0; y < run->sequence->height_px; y++)
        for (uint32_t x = 0; x < width; x++)
            run->kept_tiles[y / FM_TILE_SIDE * across + x / FM_TILE_SIDE].wrong_pixels +=
                drawn[(size_t)y * width + x] != right[(size_t)y * width + x];
}

void technique_keep_frame(technique_run *run, uint64_t wrong_tiles)
{
    const uint64_t pixels = (uint64_t)run->sequence->width_px * run->sequence->height_px;
    const uint64_t most = run->job->kept_bytes > 0 ? run->job->kept_bytes : TECHNIQUE_KEPT_BYTES;
    uint32_t wrong = 0;
    if (run->kept_tiles == NULL)
        return;
    if (wrong_tiles > 0)
        count_wrong_pixels(run, tbr_image(run->gpu), tbr_image(run->baseline));
    for (uint32_t tile = 0; wrong_tiles > 0 && tile < tbr_tile_count(run->gpu); tile++)
        if (run->kept_tiles[tile].wrong_pixels > 0)
            run->kept_tiles[wrong++] = (kept_tile){ tile, run->kept_tiles[tile].wrong_pixels };
    kept_add_list(&run->kept, run->kept_tiles, wrong);
    if (wrong == 0 || (run->kept.header.word_count + 2 * pixels) * sizeof(uint32_t) > most)
        return;
    kept_add_words(&run->kept, tbr_image(run->gpu), pixels);
    kept_add_words(&run->kept, tbr_image(run->baseline), pixels);
}

fm_status technique_keep_end(technique_run *run, fm_status status, fm_error *err)
{
    free(run->kept_tiles);
    run->kept_tiles = NULL;
    return kept_finish(&run->kept, status, err);
}
