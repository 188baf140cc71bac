#include "kept_file.h"

#include <assert.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/file.h"

static const char magic[8] = "fmkept1";
const char *const kept_names[KEPT_KIND_COUNT] = {
    [KEPT_FRAGMENTS] = "fragments", [KEPT_TRUTH] = "truth", [KEPT_FRAMES] = "frames"
};

uint32_t kept_tiles_across(const kept_header *header)
{
    return header->width_px / KEPT_TILE_SIDE + (header->width_px % KEPT_TILE_SIDE != 0);
}

uint64_t kept_tile_count(const kept_header *header)
{
    const uint32_t down =
        header->height_px / KEPT_TILE_SIDE + (header->height_px % KEPT_TILE_SIDE != 0);
    return (uint64_t)kept_tiles_across(header) * down;
}

/* As many as an image may have; twice as many words are no overflow. */
static const uint64_t most_pixels = UINT64_C(1) << 28;

/* ---- writing ---- */

static uint64_t head_bytes(const kept_header *header)
{
    return sizeof *header + (header->list_count + 1) * sizeof(uint64_t);
}

static fm_status write_failed(const kept_writer *writer, int cause, fm_error *err)
{
    return fm_fail(err, FM_IO, "%s: cannot be written: %s", writer->path, strerror(cause));
}

/* Head and offsets are known at the end: room is left for them. */
fm_status kept_begin(kept_writer *writer, const char *path, const kept_header *header,
                     fm_error *err)
{
    int fd = -1;
    *writer = (kept_writer){ .header = *header };
    if (strlen(path) >= sizeof writer->path)
        return fm_fail(err, FM_IO, "%.80s...: the path is too long", path);
    snprintf(writer->path, sizeof writer->path, "%s", path);
    snprintf(writer->partial, sizeof writer->partial, "%s.partial", path);
    memcpy(writer->header.magic, magic, sizeof magic);
    writer->offsets = calloc(header->list_count + 1, sizeof *writer->offsets);
    if (writer->offsets == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory to write it", path);
    fm_status status = file_check_replaceable(path, err);
    if (status == FM_OK)
        status = file_create(&fd, writer->partial, err);
    if (status != FM_OK)
        return status;
    writer->out = fdopen(fd, "wb");
    if (writer->out == NULL) {
        close(fd);
        unlink(writer->partial);
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory to write it", path);
    }
    writer->words = tmpfile();
    if (writer->words == NULL)
        return fm_fail(err, FM_IO, "a temporary file for %s: %s", path, strerror(errno));
    if (fseeko(writer->out, (off_t)head_bytes(header), SEEK_SET) != 0)
        return write_failed(writer, errno, err);
    return FM_OK;
}

static void note_failure(kept_writer *writer, bool is_done)
{
    if (!is_done && writer->failure == 0)
        writer->failure = errno != 0 ? errno : EIO;
}

void kept_add_list(kept_writer *writer, const void *items, size_t count)
{
    kept_header *header = &writer->header;
    if (count > 0)
        note_failure(writer, fwrite(items, KEPT_ITEM_BYTES, count, writer->out) == count);
    header->item_count += count;
    header->nonempty += count > 0;
    header->n = count > header->n ? (uint32_t)count : header->n;
    writer->offsets[++writer->lists] = header->item_count;
}

void kept_add_words(kept_writer *writer, const uint32_t *words, size_t count)
{
    note_failure(writer, fwrite(words, sizeof *words, count, writer->words) == count);
    writer->header.word_count += count;
}

static bool copy_all(FILE *out, FILE *in)
{
    char block[1 << 16];
    size_t count;
    if (fflush(in) != 0 || fseek(in, 0, SEEK_SET) != 0)
        return false;
    while ((count = fread(block, 1, sizeof block, in)) > 0)
        if (fwrite(block, 1, count, out) != count)
            return false;
    return ferror(in) == 0;
}

/* Truths are many and made anew where they are gone, so they are not flushed to disk until they are
 * kept (truth_keep). */
static bool write_head(kept_writer *writer)
{
    const size_t count = (size_t)writer->header.list_count + 1;
    const bool is_flushed = writer->header.kind != KEPT_TRUTH;
    return fseeko(writer->out, 0, SEEK_SET) == 0 &&
           fwrite(&writer->header, sizeof writer->header, 1, writer->out) == 1 &&
           fwrite(writer->offsets, sizeof *writer->offsets, count, writer->out) == count &&
           fflush(writer->out) == 0 && (!is_flushed || fsync(fileno(writer->out)) == 0);
}

/* Closes the file, and moves it into place if nothing failed. */
static void settle(kept_writer *writer, bool is_whole)
{
    if (is_whole && writer->failure == 0)
        note_failure(writer, copy_all(writer->out, writer->words) && write_head(writer));
    if (writer->words != NULL)
        fclose(writer->words);
    note_failure(writer, fclose(writer->out) == 0);
    if (is_whole && writer->failure == 0)
        note_failure(writer, rename(writer->partial, writer->path) == 0);
    if (!is_whole || writer->failure != 0)
        unlink(writer->partial);
}

fm_status kept_finish(kept_writer *writer, fm_status status, fm_error *err)
{
    if (writer->out != NULL) {
        assert(status != FM_OK || writer->lists == writer->header.list_count);
        settle(writer, status == FM_OK);
    }
    if (status == FM_OK && writer->failure != 0)
        status = write_failed(writer, writer->failure, err);
    free(writer->offsets);
    *writer = (kept_writer){ .out = NULL };
    return status;
}

/* ---- reading ---- */

/* Points the arrays into the map; false if the file's size does not fit its header. */
static bool find_arrays(kept_map *map, const kept_header *header)
{
    const uint64_t bytes = map->map_bytes;
    if (header->list_count >= bytes / 8 || header->item_count > bytes / KEPT_ITEM_BYTES ||
        header->word_count > bytes / 4 ||
        head_bytes(header) + header->item_count * KEPT_ITEM_BYTES + header->word_count * 4 != bytes)
        return false;
    const char *at = (const char *)map->map + sizeof *header;
    map->header = header;
    map->offsets = (const uint64_t *)(const void *)at;
    map->items = at + (header->list_count + 1) * 8;
    map->words = (const uint32_t *)(const void *)((const char *)map->items +
                                                  header->item_count * KEPT_ITEM_BYTES);
    return true;
}

/* Offsets that rise by n at most, from 0 to the number of items. */
static bool has_sound_offsets(const kept_map *map)
{
    const kept_header *header = map->header;
    uint64_t nonempty = 0, most = 0;
    if (map->offsets[0] != 0 || map->offsets[header->list_count] != header->item_count)
        return false;
    for (uint64_t i = 0; i < header->list_count; i++) {
        const uint64_t first = map->offsets[i], last = map->offsets[i + 1];
        if (first > last || last > header->item_count)
            return false;
        nonempty += first < last;
        most = last - first > most ? last - first : most;
    }
    return nonempty == header->nonempty && most == header->n;
}

/* Ranks of arrival lie within their pixel. */
static bool has_sound_arrival(const kept_map *map)
{
    const kept_header *header = map->header;
    if (header->word_count == 0 || header->word_count != header->item_count)
        return header->word_count == 0;
    for (uint64_t list = 0; list < header->list_count; list++)
        for (uint64_t i = map->offsets[list]; i < map->offsets[list + 1]; i++)
            if (map->words[i] >= map->offsets[list + 1] - map->offsets[list])
                return false;
    return true;
}

static bool has_sound_tiles(const kept_map *map)
{
    const kept_header *header = map->header;
    const kept_tile *tiles = map->items;
    const uint64_t tile_count = kept_tile_count(header);
    const uint64_t words = 2 * (uint64_t)header->width_px * header->height_px;
    for (uint64_t list = 0; list < header->list_count; list++)
        for (uint64_t i = map->offsets[list]; i < map->offsets[list + 1]; i++)
            if (tiles[i].tile >= tile_count ||
                (i > map->offsets[list] && tiles[i].tile <= tiles[i - 1].tile))
                return false;
    return header->word_count % words == 0 && header->word_count / words <= header->nonempty;
}

/* What is wrong with the file; NULL: nothing. */
static const char *find_damage(kept_map *map)
{
    const kept_header *header = map->map;
    if (map->map_bytes < sizeof *header)
        return "it is shorter than a header";
    if (memcmp(header->magic, magic, sizeof magic) != 0)
        return "it does not begin as a file of truth, fragments or frames";
    if (header->kind >= KEPT_KIND_COUNT || header->reserved != 0)
        return "its kind is none that is known";
    const uint64_t pixels = (uint64_t)header->width_px * header->height_px;
    if (pixels == 0 || pixels > most_pixels)
        return "its pictures are too large, or empty";
    if (header->kind != KEPT_FRAMES && header->list_count != pixels)
        return "it has not one list for each pixel";
    if (!find_arrays(map, header))
        return "its size is not what its header says";
    if (!has_sound_offsets(map))
        return "its offsets lead astray";
    if (header->kind == KEPT_TRUTH && !has_sound_arrival(map))
        return "its ranks of arrival lead astray";
    if (header->kind == KEPT_FRAGMENTS && header->word_count != header->list_count)
        return "it has not one word for each pixel";
    if (header->kind == KEPT_FRAMES && !has_sound_tiles(map))
        return "its tiles or pictures are not those of its frames";
    return NULL;
}

fm_status kept_open(kept_map *map, const char *path, fm_error *err)
{
    int fd = -1;
    const char *damage = NULL;
    *map = (kept_map){ .map = NULL };
    fm_status status = file_open(&fd, &map->map_bytes, path, err);
    if (status != FM_OK)
        return status;
    if (map->map_bytes == 0) {
        damage = "it is empty";
    } else if ((map->map = mmap(NULL, map->map_bytes, PROT_READ, MAP_PRIVATE, fd, 0)) ==
               MAP_FAILED) {
        map->map = NULL;
        status =
            fm_fail(err, errno == ENOMEM ? FM_NO_MEMORY : FM_IO, "%s: %s", path, strerror(errno));
    } else {
        damage = find_damage(map);
    }
    close(fd);
    if (damage != NULL)
        status = fm_fail(err, FM_IO, "%s: damaged: %s", path, damage);
    if (status != FM_OK)
        kept_close(map);
    map->is_damaged = damage != NULL;
    return status;
}

void kept_close(kept_map *map)
{
    if (map->map != NULL)
        munmap(map->map, map->map_bytes);
    *map = (kept_map){ .map = NULL };
}

bool kept_pictures(const uint32_t *pictures[2], const kept_map *map, uint64_t frame)
{
    const uint64_t pixels = (uint64_t)map->header->width_px * map->header->height_px;
    uint64_t before = 0; /* frames with wrong tiles */
    for (uint64_t i = 0; i < frame; i++)
        before += map->offsets[i] < map->offsets[i + 1];
    if (map->offsets[frame] == map->offsets[frame + 1] ||
        before >= map->header->word_count / (2 * pixels))
        return false;
    pictures[0] = map->words + 2 * pixels * before;
    pictures[1] = pictures[0] + pixels;
    return true;
}
