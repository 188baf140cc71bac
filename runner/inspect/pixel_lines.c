#include "pixel_lines.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/csv.h"
#include "truth/states.h"

static uint32_t list_of(const fm_fragment **items, const kept_map *map, uint64_t pixel)
{
    *items = NULL;
    if (map == NULL)
        return 0;
    *items = (const fm_fragment *)map->items + map->offsets[pixel];
    return (uint32_t)(map->offsets[pixel + 1] - map->offsets[pixel]);
}

static void add_rank(fm_text *text, uint32_t rank)
{
    if (rank != STATES_NO_RANK)
        text_add(text, "%u", rank);
}

static void add_line(fm_text *text, const pixel_source *source, uint64_t pixel,
                     const fragment_line *line)
{
    const uint32_t width =
        (source->fragments != NULL ? source->fragments : source->truth)->header->width_px;
    const bool is_known = source->fragments != NULL && source->truth != NULL;
    const uint32_t colour = line->fragment.colour;
    uint32_t bits;
    memcpy(&bits, &line->fragment.depth, sizeof bits);
    text_add(text, "%" PRIu64 ",%" PRIu64 ",", pixel % width, pixel / width);
    add_rank(text, line->rank);
    text_add(text, ",");
    csv_add_real(text, (double)line->fragment.depth);
    text_add(text, ",%08" PRIx32 ",%u,%u,%u,%u,%s%s%s,", bits, colour & 255u, colour >> 8 & 255u,
             colour >> 16 & 255u, colour >> 24, is_known ? state_names[line->state] : "",
             is_known && line->is_misordered ? "+" : "", line->is_misordered ? "misordered" : "");
    add_rank(text, line->true_rank);
    text_add(text, "\n");
}

/* With one of the lists alone there is nothing to compare. */
static uint32_t lines_alone(fragment_line *lines, const states_pixel *of)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < of->captured_count; i++)
        lines[count++] = (fragment_line){
            .fragment = of->captured[i],
            .rank = i,
            .true_rank = STATES_NO_RANK,
            .is_misordered = i > 0 && of->captured[i].depth < of->captured[i - 1].depth,
        };
    for (uint32_t i = 0; i < of->truth_count; i++)
        lines[count++] =
            (fragment_line){ .fragment = of->truth[i], .rank = STATES_NO_RANK, .true_rank = i };
    return count;
}

static void count_lines(pixel_counts *sums, const states_pixel *of, const fragment_line *lines,
                        uint32_t count, bool is_known)
{
    sums->own += of->truth_count;
    sums->wanted += of->wanted < of->truth_count ? of->wanted : of->truth_count;
    sums->handed_over += of->captured_count;
    for (uint32_t i = 0; i < count; i++) {
        sums->missing += is_known && lines[i].state == STATE_MISSING;
        sums->extra += is_known && lines[i].state == STATE_EXTRA;
        sums->misordered += lines[i].is_misordered;
    }
}

fm_status pixel_lines_add(fm_text *text, pixel_counts *sums, const pixel_source *source,
                          uint64_t pixel, fm_error *err)
{
    const bool is_known = source->fragments != NULL && source->truth != NULL;
    states_pixel of = { .wanted = UINT32_MAX };
    uint32_t count = 0;
    fm_status status = FM_OK;
    of.captured_count = list_of(&of.captured, source->fragments, pixel);
    of.truth_count = list_of(&of.truth, source->truth, pixel);
    if (source->fragments != NULL)
        of.wanted = source->fragments->header->wanted;
    const uint64_t uncaptured = source->fragments != NULL ? source->fragments->words[pixel] : 0;
    const size_t room = (size_t)of.captured_count + of.truth_count;
    fragment_line *lines = calloc(room > 0 ? room : 1, sizeof *lines);
    if (lines == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu fragments", room);
    if (is_known)
        status = states_of_pixel(lines, &count, &of, err);
    else
        count = lines_alone(lines, &of);
    if (status == FM_OK)
        count_lines(sums, &of, lines, count, is_known);
    sums->handed_over += uncaptured;
    sums->uncaptured += uncaptured;
    sums->extra += is_known ? uncaptured : 0;
    for (uint32_t i = 0; i < count && text != NULL; i++)
        add_line(text, source, pixel, &lines[i]);
    free(lines);
    return status;
}

static void add_counts(pixel_counts *sums, const pixel_counts *more)
{
    sums->own += more->own;
    sums->wanted += more->wanted;
    sums->handed_over += more->handed_over;
    sums->missing += more->missing;
    sums->extra += more->extra;
    sums->misordered += more->misordered;
    sums->uncaptured += more->uncaptured;
}

fm_status pixel_lines_wrong(fm_text *text, pixel_counts *sums, uint64_t *wrong,
                            const pixel_source *source, uint64_t most, fm_error *err)
{
    const uint32_t width = source->truth->header->width_px;
    const uint64_t pixels = (uint64_t)width * source->truth->header->height_px;
    fm_status status = FM_OK;
    *wrong = 0;
    for (uint64_t i = 0; i < pixels && status == FM_OK; i++) {
        pixel_counts one = { 0 };
        status = pixel_lines_add(NULL, &one, source, i, err);
        add_counts(sums, &one);
        if (one.missing + one.extra + one.misordered == 0)
            continue;
        if ((*wrong)++ < most)
            text_add(text,
                     "%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu64
                     ",%" PRIu64 ",%" PRIu64 "\n",
                     i % width, i / width, one.own, one.wanted, one.handed_over, one.missing,
                     one.extra, one.misordered);
    }
    return status;
}
