#include "blame.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "image/image.h"
#include "model/family.h"
#include "model/feeds.h"

static const double float_step = 0x1p-23;

static const char *const wrong_names[FM_WRONG_COUNT] = { "missing", "extra", "misordered",
                                                         "lost",    "image", "unstable",
                                                         "tiles" };
static const char *const names[] = {
    [FM_STABILITY_NONE] = "",
    [FM_STABILITY_EXACT] = "exact",
    [FM_STABILITY_TOLERATED] = "within tolerance",
    [FM_STABILITY_NOT_SUPPORTED] = "not supported",
    [FM_STABILITY_WRONG] = "wrong",
    [FM_STABILITY_FAILED] = "failed",
};
_Static_assert(sizeof names / sizeof names[0] == FM_STABILITY_COUNT, "one name each");

/* A frame of which another one would have kept other fragments: the timed image is not that of the
 * checked frame. Only where a pixel's fragments are in flight together. */
enum { IN_FLIGHT = FM_WRONG_IMAGE | FM_WRONG_UNSTABLE };

/* What each trait allows beside the losses that are counted: where a pixel's fragments are in
 * flight together, and where they come in turn. */
static const struct {
    uint32_t trait, wrong, wrong_in_turn;
} allowances[] = {
    { FM_TRAIT_RACY,
      FM_WRONG_MISSING | FM_WRONG_EXTRA | FM_WRONG_MISORDERED | FM_WRONG_LOST | IN_FLIGHT, 0 },
    { FM_TRAIT_SORTED_INPUT, FM_WRONG_MISSING | IN_FLIGHT, FM_WRONG_MISSING },
    { FM_TRAIT_MULTISAMPLED, FM_WRONG_MISSING | FM_WRONG_EXTRA, FM_WRONG_MISSING | FM_WRONG_EXTRA },
    { FM_TRAIT_APPROXIMATE,
      FM_WRONG_MISSING | FM_WRONG_EXTRA | FM_WRONG_MISORDERED | FM_WRONG_IMAGE,
      FM_WRONG_MISSING | FM_WRONG_EXTRA | FM_WRONG_MISORDERED | FM_WRONG_IMAGE },
};
enum { ALLOWANCE_COUNT = sizeof allowances / sizeof allowances[0] };

const char *wrong_name(unsigned bit)
{
    return bit < FM_WRONG_COUNT ? wrong_names[bit] : NULL;
}

const char *stability_name(fm_stability stability)
{
    return names[stability];
}

/* A count, 0 where the file does not have it. */
static double count_of(const fm_case_row *row, fm_metric metric)
{
    return row->metric[metric] > 0 ? row->metric[metric] : 0;
}

/* Whether fragments of one pixel are in flight together. */
static bool is_concurrent(const fm_case_row *row)
{
    switch (feed_from_name(row->feed)) {
    case FM_FEED_COMPUTE_PIXEL:
        return false;
    case FM_FEED_RASTER:
        return !row->is_software;
    default:
        return true;
    }
}

/* The traits that can matter for this case. */
static uint32_t traits_at_work(const fm_case_row *row)
{
    uint32_t traits = row->look.traits;
    if (strcmp(row->order, "ascending") == 0 && !is_concurrent(row))
        traits &= ~(uint32_t)FM_TRAIT_SORTED_INPUT;
    return traits;
}

static uint32_t find_wrong(const fm_case_row *row)
{
    static const struct {
        fm_metric metric;
        uint32_t wrong;
    } counts[] = {
        { FM_METRIC_MISSING, FM_WRONG_MISSING },       { FM_METRIC_EXTRA, FM_WRONG_EXTRA },
        { FM_METRIC_MISORDERED, FM_WRONG_MISORDERED }, { FM_METRIC_FRAGMENTS_LOST, FM_WRONG_LOST },
        { FM_METRIC_WRONG_TILES, FM_WRONG_TILES },
    };
    uint32_t wrong = 0;
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        wrong |= count_of(row, counts[i].metric) > 0 ? counts[i].wrong : 0;
    if (count_of(row, FM_METRIC_SELF_BEYOND) > image_rounding((uint32_t)count_of(row, FM_METRIC_N)))
        wrong |= FM_WRONG_IMAGE;
    if (row->metric[FM_METRIC_DISTINCT_IMAGES] > 1 && !(row->metric[FM_METRIC_TIED_PIXELS] > 0))
        wrong |= FM_WRONG_UNSTABLE;
    return wrong;
}

/* Fragments that are gone beyond what counted losses explain; negative: fewer are gone. */
static double unexcused(const fm_case_row *row)
{
    return count_of(row, FM_METRIC_MISSING) - count_of(row, FM_METRIC_LOST_TIES) -
           count_of(row, FM_METRIC_LOST_AT_ONE);
}

/* The traits of losses that are counted explain these, in just this number. */
static void excuse_losses(fm_blame *blame, const fm_case_row *row)
{
    const double ties = count_of(row, FM_METRIC_LOST_TIES);
    const double at_one = count_of(row, FM_METRIC_LOST_AT_ONE);
    blame->traits |=
        ties > 0 ? row->look.traits & (FM_TRAIT_LOSES_TIES | FM_TRAIT_PASSES_LOSE_TIES) : 0;
    blame->traits |= at_one > 0 ? FM_TRAIT_LOSES_DEPTH_ONE : 0;
    if (!(unexcused(row) > 0))
        blame->unexplained &= ~(uint32_t)FM_WRONG_MISSING;
    if ((row->look.traits & FM_TRAIT_EMITS_BACK) != 0 && count_of(row, FM_METRIC_EXTRA) <= ties)
        blame->unexplained &= ~(uint32_t)FM_WRONG_EXTRA;
    if (ties > 0 && is_concurrent(row))
        blame->unexplained &= ~(uint32_t)IN_FLIGHT;
}

/* Fewer were lost than the traits say, though nothing else could have kept or replaced them. */
static bool loses_too_few(const fm_case_row *row, uint32_t others)
{
    return (others & FM_WRONG_MISSING) == 0 &&
           (((row->look.traits & FM_TRAIT_LOSES_TIES) != 0 &&
             count_of(row, FM_METRIC_LOST_TIES) < count_of(row, FM_METRIC_DECLARED_TIES)) ||
            count_of(row, FM_METRIC_LOST_AT_ONE) < count_of(row, FM_METRIC_DECLARED_AT_ONE));
}

static void blame_measured(fm_blame *blame, const fm_case_row *row)
{
    const uint32_t at_work = traits_at_work(row);
    const double wanted = count_of(row, FM_METRIC_FRAGMENTS_WANTED);
    uint32_t allowed = 0;
    blame->wrong = blame->unexplained = find_wrong(row);
    excuse_losses(blame, row);
    for (size_t i = 0; i < ALLOWANCE_COUNT; i++) {
        if ((at_work & allowances[i].trait) == 0)
            continue;
        const uint32_t here =
            is_concurrent(row) ? allowances[i].wrong : allowances[i].wrong_in_turn;
        allowed |= here;
        if ((blame->unexplained & here) != 0)
            blame->traits |= allowances[i].trait;
    }
    blame->unexplained &= ~allowed;
    if (row->is_simulated && (row->look.traits & FM_TRAIT_EXACT) == 0)
        blame->unexplained &= ~(uint32_t)FM_WRONG_TILES;
    if (loses_too_few(row, allowed)) {
        blame->wrong |= FM_WRONG_MISSING;
        blame->unexplained |= FM_WRONG_MISSING;
    }
    blame->missing_share = wanted > 0 ? count_of(row, FM_METRIC_MISSING) / wanted : 0;
    blame->verdict = blame->wrong != 0                                     ? FM_STABILITY_WRONG
                     : count_of(row, FM_METRIC_SELF_MAX_ABS) <= float_step ? FM_STABILITY_EXACT
                                                                           : FM_STABILITY_TOLERATED;
}

fm_blame blame_case(const fm_case_row *row)
{
    fm_blame blame = { .verdict = FM_STABILITY_NONE };
    if ((row->look.traits & FM_TRAIT_FLOOR) != 0 || row->outcome == FM_CASE_SKIPPED)
        return blame;
    if (row->outcome == FM_CASE_NOT_SUPPORTED)
        blame.verdict = FM_STABILITY_NOT_SUPPORTED;
    else if (row->outcome == FM_CASE_OK || row->outcome == FM_CASE_WRONG_IMAGE)
        blame_measured(&blame, row);
    else
        blame.verdict = FM_STABILITY_FAILED;
    return blame;
}

bool blame_is_open(const fm_blame *blame)
{
    return blame->unexplained != 0 || blame->verdict == FM_STABILITY_FAILED;
}

void blame_words(char words[BLAME_WORDS_BYTES], const fm_blame *blame, const fm_case_row *row)
{
    words[0] = '\0';
    if (blame->verdict == FM_STABILITY_NOT_SUPPORTED)
        snprintf(words, BLAME_WORDS_BYTES, "%.150s",
                 row->reason[0] != '\0' ? row->reason : "not recorded");
    else if (blame->verdict == FM_STABILITY_FAILED)
        snprintf(words, BLAME_WORDS_BYTES, "%.150s", row->status);
    for (unsigned bit = 0; trait_words(bit) != NULL; bit++)
        if ((blame->traits & 1u << bit) != 0)
            snprintf(words + strlen(words), BLAME_WORDS_BYTES - strlen(words), "%s%s",
                     words[0] != '\0' ? ", " : "", trait_words(bit));
}
