#include "states.h"

#include <stdlib.h>

#include "check.h"

const char *const state_names[STATE_COUNT] = { [STATE_OK] = "ok",
                                               [STATE_MISSING] = "missing",
                                               [STATE_EXTRA] = "extra",
                                               [STATE_BEHIND] = "behind" };

/* What becomes of one of the pixel's own. */
typedef enum own_fate { FATE_NONE, FATE_USED, FATE_MISSING } own_fate;

typedef struct comparison {
    const states_pixel *pixel;
    uint32_t wanted;
    fragment_line *sorted; /* [captured_count]: by depth, colour, rank */
    unsigned char *fates;  /* [truth_count]: own_fate */
} comparison;

static int by_depth(const void *a, const void *b)
{
    const fragment_line *left = a, *right = b;
    const int order = check_compare(&left->fragment, &right->fragment);
    return order != 0 ? order : (left->rank > right->rank) - (left->rank < right->rank);
}

/* A captured one takes one of its own depth and colour, which nobody has taken. */
static bool take(const comparison *of, fragment_line *line, uint32_t first, uint32_t last)
{
    for (uint32_t i = first; i < last; i++) {
        if (of->fates[i] == FATE_NONE && of->pixel->truth[i].colour == line->fragment.colour) {
            of->fates[i] = FATE_USED;
            line->true_rank = i;
            return true;
        }
    }
    return false;
}

/* The pixel's own of one depth, first to last, against the captured ones of it, lines. Any of a tie
 * fills a wanted place, whatever its colour; what has a right colour fills one first. */
static void settle_depth(const comparison *of, uint32_t first, uint32_t last, fragment_line *lines,
                         uint32_t count)
{
    const uint32_t own = last - first;
    const uint32_t left = of->wanted > first ? of->wanted - first : 0;
    const uint32_t places = left < own ? left : own;
    uint32_t filled = 0, missing = places > count ? places - count : 0;
    for (uint32_t i = 0; i < count; i++) {
        const bool is_own = take(of, &lines[i], first, last);
        lines[i].state = !is_own ? STATE_EXTRA : filled < places ? STATE_OK : STATE_BEHIND;
        filled += is_own;
    }
    for (uint32_t i = first; i < last && missing > 0; i++) {
        if (of->fates[i] == FATE_NONE) {
            of->fates[i] = FATE_MISSING;
            missing--;
        }
    }
}

/* Both ascending, one depth after the other. */
static void settle_all(const comparison *of)
{
    const states_pixel *pixel = of->pixel;
    uint32_t own = 0, at = 0;
    while (own < pixel->truth_count || at < pixel->captured_count) {
        const bool is_own =
            own < pixel->truth_count &&
            (at == pixel->captured_count ||
             check_depth_bits(&pixel->truth[own]) <= check_depth_bits(&of->sorted[at].fragment));
        const uint32_t depth =
            check_depth_bits(is_own ? &pixel->truth[own] : &of->sorted[at].fragment);
        const uint32_t first = own, from = at;
        while (own < pixel->truth_count && check_depth_bits(&pixel->truth[own]) == depth)
            own++;
        while (at < pixel->captured_count && check_depth_bits(&of->sorted[at].fragment) == depth)
            at++;
        settle_depth(of, first, own, of->sorted + from, at - from);
    }
}

/* The farthest of the pixel's own are extra where they are more than were wanted. */
static void mark_surplus(const comparison *of)
{
    uint32_t own = 0;
    for (uint32_t i = 0; i < of->pixel->captured_count; i++)
        own += of->sorted[i].state != STATE_EXTRA;
    for (uint32_t i = of->pixel->captured_count; i > 0 && own > of->wanted; i--) {
        if (of->sorted[i - 1].state == STATE_BEHIND) {
            of->sorted[i - 1].state = STATE_EXTRA;
            own--;
        }
    }
}

static int by_rank(const void *a, const void *b)
{
    const fragment_line *left = a, *right = b;
    return (left->rank > right->rank) - (left->rank < right->rank);
}

/* The next of the pixel's own that is missing, from `own` on. */
static uint32_t next_missing(const comparison *of, uint32_t own)
{
    while (own < of->pixel->truth_count && of->fates[own] != FATE_MISSING)
        own++;
    return own;
}

static uint32_t merge(fragment_line *lines, const comparison *of)
{
    const states_pixel *pixel = of->pixel;
    uint32_t count = 0, own = next_missing(of, 0);
    for (uint32_t i = 0; i <= pixel->captured_count; i++) {
        const fragment_line *next = i < pixel->captured_count ? &of->sorted[i] : NULL;
        while (own < pixel->truth_count &&
               (next == NULL ||
                check_depth_bits(&pixel->truth[own]) < check_depth_bits(&next->fragment))) {
            lines[count++] = (fragment_line){ .fragment = pixel->truth[own],
                                              .rank = STATES_NO_RANK,
                                              .true_rank = own,
                                              .state = STATE_MISSING };
            own = next_missing(of, own + 1);
        }
        if (next != NULL)
            lines[count++] = *next;
    }
    return count;
}

fm_status states_of_pixel(fragment_line *lines, uint32_t *count, const states_pixel *pixel,
                          fm_error *err)
{
    comparison of = { .pixel = pixel,
                      .wanted =
                          pixel->wanted < pixel->truth_count ? pixel->wanted : pixel->truth_count,
                      .sorted = calloc((size_t)pixel->captured_count + 1, sizeof *of.sorted),
                      .fates = calloc((size_t)pixel->truth_count + 1, sizeof *of.fates) };
    fm_status status = FM_OK;
    *count = 0;
    if (of.sorted == NULL || of.fates == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "no memory for %u fragments", pixel->captured_count);
        goto out;
    }
    for (uint32_t i = 0; i < pixel->captured_count; i++)
        of.sorted[i] =
            (fragment_line){ .fragment = pixel->captured[i],
                             .rank = i,
                             .true_rank = STATES_NO_RANK,
                             .is_misordered =
                                 i > 0 && check_depth_bits(&pixel->captured[i]) <
                                              check_depth_bits(&pixel->captured[i - 1]) };
    qsort(of.sorted, pixel->captured_count, sizeof *of.sorted, by_depth);
    settle_all(&of);
    mark_surplus(&of);
    qsort(of.sorted, pixel->captured_count, sizeof *of.sorted, by_rank);
    *count = merge(lines, &of);
out:
    free(of.sorted);
    free(of.fates);
    return status;
}
