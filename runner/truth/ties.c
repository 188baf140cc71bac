#include "ties.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One channel of a fragment. */
typedef struct tied {
    double c, a;
    double ratio; /* c / a; INFINITY for a = 0 */
} tied;

/* Fragments at one depth, and how many of them are wanted. */
typedef struct tied_group {
    uint32_t count, take;
    uint32_t kept; /* without those of c = a = 0 in this channel */
    bool has_one_alpha;
} tied_group;

struct fm_ties {
    tied *group;  /* [n] */
    double *best; /* [n + 1]: f of the rows that are done, by j */
    /* The pixel before: its neighbours often have the same fragments. */
    fm_fragment *last; /* [n] */
    uint32_t last_count, last_wanted;
    fm_range last_range;
};

fm_status ties_create(fm_ties **ties, uint32_t n, fm_error *err)
{
    fm_ties *made = calloc(1, sizeof *made);
    *ties = made;
    if (made != NULL) {
        made->group = calloc((size_t)n + 1, sizeof made->group[0]);
        made->best = calloc((size_t)n + 1, sizeof made->best[0]);
        made->last = calloc((size_t)n + 1, sizeof made->last[0]);
    }
    if (made != NULL && made->group != NULL && made->best != NULL && made->last != NULL)
        return FM_OK;
    ties_destroy(made);
    *ties = NULL;
    return fm_fail(err, FM_NO_MEMORY, "ties of %u fragments", n);
}

void ties_destroy(fm_ties *ties)
{
    if (ties == NULL)
        return;
    free(ties->group);
    free(ties->best);
    free(ties->last);
    free(ties);
}

static bool is_tied(const fm_fragment *a, const fm_fragment *b)
{
    return a->depth <= b->depth && a->depth >= b->depth;
}

static uint32_t group_end(const fm_fragment *fragments, uint32_t count, uint32_t first)
{
    uint32_t last = first + 1;
    while (last < count && is_tied(&fragments[last], &fragments[first]))
        last++;
    return last;
}

bool ties_are_open(const fm_fragment *fragments, uint32_t count, uint32_t wanted)
{
    for (uint32_t first = 0, last; first < count && first < wanted; first = last) {
        last = group_end(fragments, count, first);
        for (uint32_t i = first + 1; i < last; i++)
            if (fragments[i].colour != fragments[first].colour)
                return true;
    }
    return false;
}

static double channel_of(const fm_fragment *fragment, int channel)
{
    return (fragment->colour >> (8 * channel) & 0xFFu) / 255.0;
}

static int by_ratio(const void *a, const void *b)
{
    const tied *left = a, *right = b;
    if (left->ratio < right->ratio || left->ratio > right->ratio)
        return left->ratio > right->ratio ? 1 : -1;
    return (left->c > right->c) - (left->c < right->c);
}

/* One channel of a group by rising c / a, without fragments of c = a = 0; returns how many. */
static uint32_t sort_group(fm_ties *ties, const fm_fragment *group, uint32_t count, int channel)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        const double c = channel_of(&group[i], channel), a = channel_of(&group[i], 3);
        if (c > 0 || a > 0)
            ties->group[kept++] = (tied){ c, a, a > 0 ? c / a : INFINITY };
    }
    qsort(ties->group, kept, sizeof ties->group[0], by_ratio);
    return kept;
}

/* The i-th from the front of the order that makes the value largest, or smallest. */
static const tied *at(const fm_ties *ties, uint32_t count, uint32_t i, bool is_largest)
{
    return &ties->group[is_largest ? count - 1 - i : i];
}

/* The first `take` of that order, front to back. */
static double composite_first(const fm_ties *ties, uint32_t count, uint32_t take, bool is_largest)
{
    double value = 0, through = 1;
    for (uint32_t i = 0; i < take; i++) {
        const tied *fragment = at(ties, count, i, is_largest);
        value += through * fragment->c;
        through *= 1 - fragment->a;
    }
    return value;
}

/* Row i: `done` fragments lie behind it. */
static void add_row(double *best, const tied *fragment, uint32_t done, uint32_t take,
                    bool is_largest)
{
    const double c = fragment->c, through = 1 - fragment->a;
    uint32_t j = done < take ? done : take;
    if (done < take)
        best[done + 1] = c + through * best[done];
    for (; j > 0; j--) {
        const double with = c + through * best[j - 1];
        best[j] = (with > best[j]) == is_largest ? with : best[j];
    }
}

/* Of all subsets of `take`, `zeros` of the group being c = a = 0, which take a place and change
 * nothing. */
static double composite_best(fm_ties *ties, uint32_t count, uint32_t zeros, uint32_t take,
                             bool is_largest)
{
    const uint32_t least = take > zeros ? take - zeros : 0, most = take < count ? take : count;
    ties->best[0] = 0;
    for (uint32_t done = 0; done < count; done++)
        add_row(ties->best, at(ties, count, count - 1 - done, is_largest), done, take, is_largest);
    double value = ties->best[least];
    for (uint32_t j = least + 1; j <= most; j++)
        value = (ties->best[j] > value) == is_largest ? ties->best[j] : value;
    return value;
}

static bool has_one_alpha(const fm_fragment *group, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++)
        if (group[i].colour >> 24 != group[0].colour >> 24)
            return false;
    return true;
}

/* Of a sorted group of which `kept` are not set aside: the largest or smallest value of `take`. */
static double extreme(fm_ties *ties, const tied_group *group, bool is_largest)
{
    const uint32_t zeros = group->count - group->kept;
    if (group->take == group->count)
        return composite_first(ties, group->kept, group->kept, is_largest);
    if (zeros == 0 && group->has_one_alpha)
        return composite_first(ties, group->kept, group->take, is_largest);
    return composite_best(ties, group->kept, zeros, group->take, is_largest);
}

static void add_group(fm_range *range, double through, fm_ties *ties, const fm_fragment *fragments,
                      uint32_t count, uint32_t take)
{
    tied_group group = { .count = count,
                         .take = take,
                         .has_one_alpha = has_one_alpha(fragments, count) };
    for (int channel = 0; channel < 4; channel++) {
        double low = channel_of(fragments, channel), high = low;
        if (count > 1) {
            group.kept = sort_group(ties, fragments, count, channel);
            low = extreme(ties, &group, false);
            high = extreme(ties, &group, true);
        }
        range->low[channel] += through * low;
        range->high[channel] += through * high;
    }
}

static void find_range(fm_range *range, fm_ties *ties, const fm_fragment *fragments, uint32_t count,
                       uint32_t wanted)
{
    double through = 1;
    *range = (fm_range){ { 0 }, { 0 } };
    for (uint32_t first = 0, last; first < wanted; first = last) {
        last = group_end(fragments, count, first);
        const uint32_t take = (last < wanted ? last : wanted) - first;
        add_group(range, through, ties, &fragments[first], last - first, take);
        for (uint32_t i = first; i < last; i++)
            through *= 1 - channel_of(&fragments[i], 3);
    }
}

void ties_range(fm_range *range, fm_ties *ties, const fm_fragment *fragments, uint32_t count,
                uint32_t wanted)
{
    const uint32_t most = wanted < count ? wanted : count;
    if (count == 0 || count != ties->last_count || most != ties->last_wanted ||
        memcmp(fragments, ties->last, count * sizeof *fragments) != 0) {
        find_range(&ties->last_range, ties, fragments, count, most);
        memcpy(ties->last, fragments, count * sizeof *fragments);
        ties->last_count = count;
        ties->last_wanted = most;
    }
    *range = ties->last_range;
}
