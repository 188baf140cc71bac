#include "truth.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include <xxhash.h>

#include "base/file.h"
#include "truth_file.h"

static const char magic[8] = "fmtruth1";

static fm_status write_failed(const truth_file *file, fm_error *err)
{
    return fm_fail(err, FM_IO, "%s: cannot be written: %s", file->path, strerror(errno));
}

fm_status truth_file_open(truth_file *file, const char *path, const truth_header *header,
                          const uint64_t *offsets, fm_error *err)
{
    truth_header full = *header;
    const size_t pixels = (size_t)header->width_px * header->height_px;
    int fd = -1;
    *file = (truth_file){ .out = NULL };
    snprintf(file->path, sizeof file->path, "%s", path);
    const fm_status status = file_create(&fd, path, err);
    if (status != FM_OK)
        return status;
    file->out = fdopen(fd, "wb");
    if (file->out == NULL) {
        close(fd);
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory to write it", path);
    }
    if (header->has_arrival && (file->arrival = tmpfile()) == NULL)
        return fm_fail(err, FM_IO, "a temporary file for truth: %s", strerror(errno));
    memcpy(full.magic, magic, sizeof magic);
    if (fwrite(&full, sizeof full, 1, file->out) != 1 ||
        fwrite(offsets, sizeof *offsets, pixels + 1, file->out) != pixels + 1)
        return write_failed(file, err);
    return FM_OK;
}

fm_status truth_file_add(truth_file *file, const fm_fragment *fragments, const uint32_t *arrival,
                         size_t count, fm_error *err)
{
    if (fwrite(fragments, sizeof *fragments, count, file->out) != count ||
        (file->arrival != NULL && fwrite(arrival, sizeof *arrival, count, file->arrival) != count))
        return write_failed(file, err);
    return FM_OK;
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

fm_status truth_file_close(truth_file *file, fm_status status, fm_error *err)
{
    if (status == FM_OK && file->arrival != NULL && !copy_all(file->out, file->arrival))
        status = write_failed(file, err);
    if (file->arrival != NULL)
        fclose(file->arrival);
    if (file->out != NULL && fclose(file->out) != 0 && status == FM_OK)
        status = write_failed(file, err);
    return status;
}

/* Points the arrays into the map; false if the file's size does not fit its header. */
static bool find_arrays(fm_truth *truth, const truth_header *header)
{
    const uint64_t pixels = (uint64_t)header->width_px * header->height_px;
    const uint64_t count = header->fragment_count;
    const uint64_t offsets_bytes = (pixels + 1) * sizeof(uint64_t);
    if (count > truth->map_bytes || offsets_bytes > truth->map_bytes)
        return false;
    const uint64_t needed = sizeof *header + offsets_bytes + count * sizeof(fm_fragment) +
                            (header->has_arrival ? count * sizeof(uint32_t) : 0);
    if (needed != truth->map_bytes)
        return false;
    const char *at = (const char *)truth->map + sizeof *header;
    truth->offsets = (const uint64_t *)(const void *)at;
    truth->fragments = (const fm_fragment *)(const void *)(at + offsets_bytes);
    if (header->has_arrival)
        truth->arrival = (const uint32_t *)(const void *)(truth->fragments + count);
    return truth->offsets[0] == 0 && truth->offsets[pixels] == count;
}

/* What readers rely on: offsets that rise by n at most, ranks of arrival within their pixel. */
static bool is_sound(const fm_truth *truth)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    for (uint64_t pixel = 0; pixel < pixels; pixel++) {
        const uint64_t first = truth->offsets[pixel], last = truth->offsets[pixel + 1];
        if (first > last || last > truth->fragment_count || last - first > truth->n)
            return false;
        for (uint64_t i = first; truth->arrival != NULL && i < last; i++)
            if (truth->arrival[i] >= last - first)
                return false;
    }
    return true;
}

fm_status truth_open(fm_truth **out, const char *path, fm_error *err)
{
    fm_truth *truth = calloc(1, sizeof *truth);
    int fd = -1;
    *out = NULL;
    if (truth == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory", path);
    fm_status status = file_open(&fd, &truth->map_bytes, path, err);
    if (status == FM_INVALID)
        status = fm_fail(err, FM_IO, "%s: not a truth file: a folder, a device or a pipe", path);
    if (status != FM_OK)
        goto out;
    truth->map = mmap(NULL, truth->map_bytes, PROT_READ, MAP_PRIVATE, fd, 0);
    if (truth->map == MAP_FAILED) {
        truth->map = NULL;
        status = fm_fail(err, errno == ENOMEM ? FM_NO_MEMORY : FM_IO, "%s: %s", path,
                         truth->map_bytes == 0 ? "damaged truth file" : strerror(errno));
        goto out;
    }
    if (truth->map_bytes < sizeof(truth_header)) {
        status = fm_fail(err, FM_IO, "%s: damaged truth file", path);
        goto out;
    }
    const truth_header *header = truth->map;
    truth->width_px = header->width_px;
    truth->height_px = header->height_px;
    truth->n = header->n;
    truth->fragment_count = header->fragment_count;
    truth->nonempty_pixels = header->nonempty_pixels;
    if (memcmp(header->magic, magic, sizeof magic) != 0 || !find_arrays(truth, header) ||
        !is_sound(truth)) {
        status = fm_fail(err, FM_IO, "%s: damaged truth file", path);
        goto out;
    }
    *out = truth;
    truth = NULL;
out:
    if (fd >= 0)
        close(fd);
    truth_close(truth);
    return status;
}

void truth_close(fm_truth *truth)
{
    if (truth == NULL)
        return;
    if (truth->map != NULL)
        munmap(truth->map, truth->map_bytes);
    free(truth);
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
