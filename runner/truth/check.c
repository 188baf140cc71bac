#include "check.h"

#include <stdlib.h>
#include <string.h>

uint32_t check_depth_bits(const fm_fragment *fragment)
{
    uint32_t bits;
    memcpy(&bits, &fragment->depth, sizeof bits);
    return bits & 0x7FFFFFFFu; /* -0 is 0 */
}

int check_compare(const fm_fragment *a, const fm_fragment *b)
{
    const uint32_t left = check_depth_bits(a), right = check_depth_bits(b);
    if (left != right)
        return left > right ? 1 : -1;
    return (a->colour > b->colour) - (a->colour < b->colour);
}

static int compare_for_sort(const void *a, const void *b)
{
    return check_compare(a, b);
}

static uint64_t count_misordered(const fm_fragment *captured, uint32_t count)
{
    uint64_t misordered = 0;
    for (uint32_t i = 1; i < count; i++)
        misordered += check_depth_bits(&captured[i]) < check_depth_bits(&captured[i - 1]);
    return misordered;
}

/* Both ascending: wanted depths without a partner. */
static uint64_t count_missing(const fm_fragment *captured, uint32_t captured_count,
                              const fm_fragment *truth, uint32_t wanted)
{
    uint64_t missing = 0;
    uint32_t at = 0;
    for (uint32_t i = 0; i < wanted; i++) {
        while (at < captured_count && check_depth_bits(&captured[at]) < check_depth_bits(&truth[i]))
            at++;
        if (at < captured_count && check_depth_bits(&captured[at]) == check_depth_bits(&truth[i]))
            at++;
        else
            missing++;
    }
    return missing;
}

/* captured ascending by (depth, colour); truth ascending by depth only: colours of a tie are looked
 * for within the tie, each of truth's fragments used once. */
static bool take_from_tie(bool *used, const fm_fragment *truth, uint32_t first, uint32_t last,
                          uint32_t colour)
{
    for (uint32_t i = first; i < last; i++) {
        if (!used[i - first] && truth[i].colour == colour) {
            used[i - first] = true;
            return true;
        }
    }
    return false;
}

static uint64_t count_extra(const fm_fragment *captured, uint32_t captured_count,
                            const fm_fragment *truth, uint32_t truth_count, bool *used)
{
    uint64_t extra = 0;
    uint32_t first = 0, last = 0;
    for (uint32_t i = 0; i < captured_count; i++) {
        const uint32_t depth = check_depth_bits(&captured[i]);
        if (i == 0 || depth != check_depth_bits(&captured[i - 1])) {
            while (first < truth_count && check_depth_bits(&truth[first]) < depth)
                first++;
            for (last = first; last < truth_count && check_depth_bits(&truth[last]) == depth;)
                last++;
            memset(used, 0, (last - first) * sizeof *used);
        }
        extra += !take_from_tie(used, truth, first, last, captured[i].colour);
    }
    return extra;
}

static uint32_t most_ulps(const fm_fragment *captured, uint32_t count, const fm_fragment *truth)
{
    uint32_t most = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t a = check_depth_bits(&captured[i]), b = check_depth_bits(&truth[i]);
        const uint32_t apart = a > b ? a - b : b - a;
        most = apart > most ? apart : most;
    }
    return most;
}

void check_pixel(fm_check *check, fm_fragment *captured, uint32_t captured_count,
                 const fm_fragment *truth, uint32_t truth_count, uint32_t wanted)
{
    enum { TIE_ON_STACK = 256 };
    bool on_stack[TIE_ON_STACK];
    bool *used = truth_count <= TIE_ON_STACK ? on_stack : calloc(truth_count, sizeof *used);
    const uint64_t misordered = count_misordered(captured, captured_count);
    qsort(captured, captured_count, sizeof *captured, compare_for_sort);
    const uint64_t missing = count_missing(captured, captured_count, truth, wanted);
    /* Without memory for the tie nothing can be vouched for: all of them count as extra. */
    uint64_t extra = used == NULL ? captured_count
                                  : count_extra(captured, captured_count, truth, truth_count, used);
    if (captured_count - extra > wanted) /* the pixel's own, but more than were asked for */
        extra = captured_count - wanted;
    const uint32_t ulps =
        most_ulps(captured, captured_count < wanted ? captured_count : wanted, truth);
    check->captured += captured_count;
    check->misordered += misordered;
    check->missing += missing;
    check->wanted += wanted;
    loss_count(&check->declared, check->traits, NULL, 0, truth, wanted);
    loss_count(&check->excused, check->traits, captured, captured_count, truth, wanted);
    check->extra += extra;
    check->wrong_pixels += missing + extra + misordered > 0;
    check->depth_ulp_max = ulps > check->depth_ulp_max ? ulps : check->depth_ulp_max;
    if (used != on_stack)
        free(used);
}

uint64_t check_faults(const fm_check *check)
{
    return check->missing - check->excused.at_depth_one - check->excused.of_ties + check->extra +
           check->misordered;
}
