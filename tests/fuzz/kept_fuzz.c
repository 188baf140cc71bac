/* What `fragmark dump` reads: a file that opens is walked through, alone, and fragments against
 * themselves as truth. */
#include "fuzz.h"
#include "inspect/frame_lines.h"
#include "inspect/pixel_lines.h"

enum { PIXELS_MOST = 4096, TILES_MOST = 64 };

static void walk_pixels(const pixel_source *source, const kept_header *header)
{
    fm_text text = { 0 };
    pixel_counts sums = { 0 };
    for (uint64_t i = 0; i < header->list_count && i < PIXELS_MOST; i++) {
        pixel_lines_add(&text, &sums, source, i, NULL);
        text.length = 0;
    }
    text_free(&text);
}

static void walk_frames(const kept_map *frames)
{
    fm_text text = { 0 };
    frame_counts counts;
    uint64_t wrong;
    frame_lines_wrong(&text, &counts, frames, TILES_MOST);
    for (uint64_t i = 0; i < counts.frames && i < TILES_MOST; i++) {
        text.length = 0;
        frame_lines_add(&text, &wrong, frames, i, NULL, NULL);
    }
    text_free(&text);
}

static void walk(const kept_map *map)
{
    switch ((kept_kind)map->header->kind) {
    case KEPT_FRAGMENTS:
        walk_pixels(&(pixel_source){ .fragments = map }, map->header);
        walk_pixels(&(pixel_source){ map, map }, map->header);
        return;
    case KEPT_TRUTH:
        walk_pixels(&(pixel_source){ .truth = map }, map->header);
        return;
    case KEPT_FRAMES:
        walk_frames(map);
        return;
    case KEPT_KIND_COUNT:
        return;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_file file;
    kept_map map;
    fm_error err = { 0 };
    fuzz_file_open(&file, bytes, count);
    const fm_status status = kept_open(&map, file.path, &err);
    fuzz_expect_reason(status, &err);
    if (status == FM_OK)
        walk(&map);
    kept_close(&map);
    fuzz_file_close(&file);
    return 0;
}
