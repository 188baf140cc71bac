#include "truth.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include <xxhash.h>

#include "base/file.h"
#include "base/text.h"
#include "kept_file.h"

fm_status truth_open(fm_truth **out, const char *path, fm_error *err)
{
    kept_map file;
    fm_truth *truth = calloc(1, sizeof *truth);
    *out = NULL;
    if (truth == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory", path);
    fm_status status = kept_open(&file, path, err);
    if (status == FM_INVALID)
        status = fm_fail(err, FM_IO, "%s: not a truth file: a folder, a device or a pipe", path);
    if (status == FM_OK && file.header->kind != KEPT_TRUTH) {
        status = fm_fail(err, FM_IO, "%s: damaged: it holds no truth", path);
        kept_close(&file);
    }
    if (status != FM_OK) {
        free(truth);
        return status;
    }
    *truth = (fm_truth){ .width_px = file.header->width_px,
                         .height_px = file.header->height_px,
                         .n = file.header->n,
                         .fragment_count = file.header->item_count,
                         .nonempty_pixels = file.header->nonempty,
                         .offsets = file.offsets,
                         .fragments = file.items,
                         .arrival = file.header->word_count > 0 ? file.words : NULL,
                         .map = file.map,
                         .map_bytes = file.map_bytes };
    *out = truth;
    return FM_OK;
}

void truth_close(fm_truth *truth)
{
    if (truth == NULL)
        return;
    if (truth->map != NULL)
        munmap(truth->map, truth->map_bytes);
    free(truth);
}

/* Flushed first: what has its name is whole, also after the machine went down. */
static bool link_flushed(const char *path, const char *partial, const char *keep)
{
    int fd = -1;
    if (file_open(&fd, NULL, path, NULL) != FM_OK)
        return false;
    const bool is_flushed = fsync(fd) == 0;
    close(fd);
    return is_flushed && link(path, partial) == 0 && rename(partial, keep) == 0;
}

fm_status truth_keep(const char *keep, const char *path, const fm_truth *truth, fm_error *err)
{
    fm_text partial = { 0 };
    if (keep == NULL || keep[0] == '\0')
        return FM_OK;
    text_add(&partial, "%s.partial", keep);
    if (partial.failed)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory for its name", keep);
    fm_status status = file_check_replaceable(keep, err);
    unlink(partial.bytes);
    if (status == FM_OK && !link_flushed(path, partial.bytes, keep))
        status = text_write_file(keep, truth->map, truth->map_bytes, err);
    unlink(partial.bytes); /* two names of one file stay two where one is renamed to the other */
    text_free(&partial);
    return status;
}

void truth_forget(const fm_truth *truth, uint64_t first, uint64_t last)
{
    const uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);
    const uintptr_t from = (uintptr_t)&truth->fragments[truth->offsets[first]] / page * page;
    const uintptr_t to = (uintptr_t)&truth->fragments[truth->offsets[last]] / page * page;
    /* Advice: without it the pages stay, which is no failure. A page that is read again comes back
     * from the file. */
    if (truth->map != NULL && from < to)
        madvise((char *)truth->map + (from - (uintptr_t)truth->map), to - from, MADV_DONTNEED);
}

uint64_t truth_digest(const fm_truth *truth)
{
    enum { BLOCK_FRAGMENTS = 1 << 20 };
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    uint64_t digest = XXH64(truth->offsets, (pixels + 1) * sizeof truth->offsets[0], 0);
    for (uint64_t i = 0; i < truth->fragment_count; i += BLOCK_FRAGMENTS) {
        const uint64_t left = truth->fragment_count - i;
        const uint64_t count = left < BLOCK_FRAGMENTS ? left : BLOCK_FRAGMENTS;
        digest = XXH64(&truth->fragments[i], count * sizeof truth->fragments[0], digest);
    }
    return digest >> 16;
}

static uint64_t kept_of(const fm_truth *truth, uint64_t pixel, uint32_t k)
{
    const uint64_t count = truth->offsets[pixel + 1] - truth->offsets[pixel];
    return k > 0 && count > k ? k : count;
}

uint64_t truth_kept(const fm_truth *truth, uint32_t k)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    uint64_t kept = 0;
    for (uint64_t i = 0; i < pixels; i++)
        kept += kept_of(truth, i, k);
    return kept;
}

void composite_pixel(double rgba[4], const fm_fragment *fragments, uint64_t count)
{
    memset(rgba, 0, 4 * sizeof rgba[0]);
    for (uint64_t i = 0; i < count; i++) {
        const double through = 1.0 - rgba[3];
        for (int channel = 0; channel < 4; channel++)
            rgba[channel] += (fragments[i].colour >> (8 * channel) & 0xFFu) / 255.0 * through;
    }
}
