#include "blame.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "image/image.h"
#include "model/family.h"
#include "model/feeds.h"
#include "read/options.h"

static const double float_step = 0x1p-23;

static const char *const wrong_names[FM_WRONG_COUNT] = { "missing", "extra", "misordered",
                                                         "lost",    "image", "unstable",
                                                         "tiles" };
static const char *const names[] = {
    [FM_STABILITY_NONE] = "",
    [FM_STABILITY_EXACT] = "exact",
    [FM_STABILITY_TOLERATED] = "within tolerance",
    [FM_STABILITY_NOT_SUPPORTED] = "not supported",
    [FM_STABILITY_UNKNOWN] = "not recorded",
    [FM_STABILITY_WRONG] = "wrong",
    [FM_STABILITY_FAILED] = "failed",
};
_Static_assert(sizeof names / sizeof names[0] == FM_STABILITY_COUNT, "one name each");

/* How a pixel's fragments come, and where they lie: what traits depend on. */
enum {
    AT_ALL = 0,
    IN_FLIGHT = 1u << 0, /* several may be in flight together */
    UNSORTED = 1u << 1,  /* they may come in another order than front to back */
    SLOPED = 1u << 2,    /* within a pixel their depths and coverage differ: no flat layers */
    TIED = 1u << 3,      /* wanted ones of equal depth differ in colour */
};

/* A trait allows these errors if one of the circumstances holds. */
static const struct {
    uint32_t trait, when, wrong;
} allowances[] = {
    { FM_TRAIT_RACY, IN_FLIGHT,
      FM_WRONG_MISSING | FM_WRONG_EXTRA | FM_WRONG_MISORDERED | FM_WRONG_LOST | FM_WRONG_IMAGE |
          FM_WRONG_UNSTABLE },
    { FM_TRAIT_SORTED_INPUT, UNSORTED, FM_WRONG_MISSING },
    /* Other frames keep others: neither do they agree with each other, nor with the checked one. */
    { FM_TRAIT_SORTED_INPUT, IN_FLIGHT, FM_WRONG_IMAGE | FM_WRONG_UNSTABLE },
    { FM_TRAIT_MULTISAMPLED, SLOPED, FM_WRONG_MISSING | FM_WRONG_EXTRA },
    { FM_TRAIT_APPROXIMATE, AT_ALL, FM_WRONG_IMAGE },
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

/* A count, 0 where it is not known. */
static double count_of(const fm_case_row *row, fm_metric metric)
{
    return row->metric[metric] > 0 ? row->metric[metric] : 0;
}

static bool is_in_flight(const fm_case_row *row)
{
    switch (feed_from_name(row->feed)) {
    case FM_FEED_COMPUTE_PIXEL:
        return false;
    case FM_FEED_RASTER: /* what is not known to be software may be a GPU */
        return !(row->is_device_known && row->is_software);
    default:
        return true;
    }
}

static bool is_sloped(const fm_case_row *row)
{
    char depths[FM_OPTION_VALUE_BYTES];
    options_value(depths, row->options, "depths");
    return row->order[0] == '\0' /* no layers */ || strcmp(depths, "sloped") == 0;
}

static uint32_t circumstances(const fm_case_row *row)
{
    uint32_t are = (is_in_flight(row) ? IN_FLIGHT : 0) | (is_sloped(row) ? SLOPED : 0);
    if (strcmp(row->order, "ascending") != 0 || (are & (IN_FLIGHT | SLOPED)) != 0)
        are |= UNSORTED;
    return are | (row->metric[FM_METRIC_TIED_PIXELS] > 0 ? TIED : 0);
}

static bool has_trait(const fm_case_row *row, uint32_t trait)
{
    return (row->look.traits & trait) != 0;
}

/* Off the fragments handed over; of an approximation, which merges or weighs them, off the picture
 * that is wanted. */
static bool is_image_wrong(const fm_case_row *row)
{
    const double rounding = image_rounding((uint32_t)fmin(count_of(row, FM_METRIC_N), UINT32_MAX));
    return has_trait(row, FM_TRAIT_APPROXIMATE)
               ? count_of(row, FM_METRIC_MAX_ABS) > rounding * case_brightness(row)
               : count_of(row, FM_METRIC_SELF_BEYOND) > rounding;
}

/* Where ties leave a choice, frames may differ; but none may be further from truth than the last
 * one, which the image's error is of. */
static bool is_unstable(const fm_case_row *row)
{
    const bool differs =
        row->metric[FM_METRIC_DISTINCT_IMAGES] > 1 || row->metric[FM_METRIC_DISTINCT_FRAGMENTS] > 1;
    const double further = count_of(row, FM_METRIC_FRAMES_RMSE_MAX) - count_of(row, FM_METRIC_RMSE);
    return (differs && (circumstances(row) & TIED) == 0) ||
           further > float_step * case_brightness(row) ||
           (count_of(row, FM_METRIC_MISSING_MAX) > count_of(row, FM_METRIC_MISSING) &&
            !has_trait(row, FM_TRAIT_APPROXIMATE));
}

static uint32_t find_wrong(const fm_case_row *row)
{
    static const struct {
        fm_metric metric;
        uint32_t wrong;
    } counts[] = {
        { FM_METRIC_MISSING, FM_WRONG_MISSING },     { FM_METRIC_MISSING_MAX, FM_WRONG_MISSING },
        { FM_METRIC_EXTRA, FM_WRONG_EXTRA },         { FM_METRIC_MISORDERED, FM_WRONG_MISORDERED },
        { FM_METRIC_FRAGMENTS_LOST, FM_WRONG_LOST }, { FM_METRIC_WRONG_TILES, FM_WRONG_TILES },
    };
    uint32_t wrong = 0;
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        wrong |= count_of(row, counts[i].metric) > 0 ? counts[i].wrong : 0;
    if (has_trait(row, FM_TRAIT_APPROXIMATE)) /* its fragments are not those of the pixel */
        wrong &= ~(uint32_t)(FM_WRONG_MISSING | FM_WRONG_EXTRA | FM_WRONG_MISORDERED);
    wrong |= is_image_wrong(row) ? FM_WRONG_IMAGE : 0;
    wrong |= is_unstable(row) ? FM_WRONG_UNSTABLE : 0;
    /* Whatever it was that the check of an exact method found. */
    return wrong == 0 && row->outcome == FM_CASE_WRONG_IMAGE ? FM_WRONG_IMAGE : wrong;
}

/* Counted losses: allowed up to what the traits declare, and, where nothing else loses or keeps
 * fragments, exactly that. Of ties that passes lose nothing says how many. */
static bool are_losses_declared(const fm_case_row *row, bool is_exactly)
{
    const double ties = count_of(row, FM_METRIC_LOST_TIES);
    const double at_one = count_of(row, FM_METRIC_LOST_AT_ONE);
    const double declared_ties = count_of(row, FM_METRIC_DECLARED_TIES);
    const double declared_at_one = count_of(row, FM_METRIC_DECLARED_AT_ONE);
    if (ties > declared_ties || at_one > declared_at_one ||
        (ties > 0 && !has_trait(row, FM_TRAIT_LOSES_TIES | FM_TRAIT_PASSES_LOSE_TIES)) ||
        (at_one > 0 && !has_trait(row, FM_TRAIT_LOSES_DEPTH_ONE)))
        return false;
    return !is_exactly || (at_one >= declared_at_one &&
                           (ties >= declared_ties || !has_trait(row, FM_TRAIT_LOSES_TIES)));
}

/* Of the worst captured frame. */
static double most_missing(const fm_case_row *row)
{
    return fmax(count_of(row, FM_METRIC_MISSING), count_of(row, FM_METRIC_MISSING_MAX));
}

/* What the traits of losses that are counted allow. */
static uint32_t allow_losses(fm_blame *blame, const fm_case_row *row)
{
    const double ties = count_of(row, FM_METRIC_LOST_TIES);
    const double at_one = count_of(row, FM_METRIC_LOST_AT_ONE);
    const bool varies = (circumstances(row) & (IN_FLIGHT | TIED)) == (IN_FLIGHT | TIED);
    uint32_t allowed = 0;
    if (!are_losses_declared(row, false))
        return 0;
    if (ties > 0)
        blame->traits |= row->look.traits & (FM_TRAIT_LOSES_TIES | FM_TRAIT_PASSES_LOSE_TIES);
    if (at_one > 0)
        blame->traits |= FM_TRAIT_LOSES_DEPTH_ONE;
    if (!(most_missing(row) > ties + at_one))
        allowed |= FM_WRONG_MISSING;
    if (has_trait(row, FM_TRAIT_EMITS_BACK) && count_of(row, FM_METRIC_EXTRA) <= ties)
        allowed |= FM_WRONG_EXTRA;
    if (ties > 0 && varies) /* another one of a tie survives in each frame */
        allowed |= FM_WRONG_IMAGE | FM_WRONG_UNSTABLE;
    return allowed;
}

/* What the method's traits allow here; those that are needed for what is wrong go to the blame. */
static uint32_t allow_traits(fm_blame *blame, const fm_case_row *row)
{
    const uint32_t are = circumstances(row);
    uint32_t allowed = 0;
    for (size_t i = 0; i < ALLOWANCE_COUNT; i++) {
        if (!has_trait(row, allowances[i].trait) ||
            (allowances[i].when != AT_ALL && (allowances[i].when & are) == 0))
            continue;
        allowed |= allowances[i].wrong;
        if ((blame->unexplained & allowances[i].wrong) != 0)
            blame->traits |= allowances[i].trait;
    }
    return allowed;
}

/* What tells exact from within tolerance. */
static fm_metric off_by(const fm_case_row *row)
{
    return has_trait(row, FM_TRAIT_APPROXIMATE) ? FM_METRIC_MAX_ABS : FM_METRIC_SELF_MAX_ABS;
}

static void blame_measured(fm_blame *blame, const fm_case_row *row)
{
    const double wanted = count_of(row, FM_METRIC_FRAGMENTS_WANTED);
    blame->wrong = blame->unexplained = find_wrong(row);
    blame->unexplained &= ~allow_losses(blame, row);
    const uint32_t allowed = allow_traits(blame, row);
    blame->unexplained &= ~allowed;
    if (row->is_simulated && !has_trait(row, FM_TRAIT_EXACT))
        blame->unexplained &= ~(uint32_t)FM_WRONG_TILES;
    if (!are_losses_declared(row, (allowed & FM_WRONG_MISSING) == 0)) {
        blame->wrong |= FM_WRONG_MISSING;
        blame->unexplained |= FM_WRONG_MISSING;
    }
    if (wanted > 0 && (blame->wrong & FM_WRONG_MISSING) != 0)
        blame->missing_share = fmin(1, most_missing(row) / wanted);
    blame->verdict = blame->wrong != 0                          ? FM_STABILITY_WRONG
                     : count_of(row, off_by(row)) <= float_step ? FM_STABILITY_EXACT
                                                                : FM_STABILITY_TOLERATED;
}

/* Whether the row has what a verdict needs: runs of before these columns have not. */
static bool is_recorded(const fm_case_row *row)
{
    return row->is_simulated ? !isnan(row->metric[FM_METRIC_WRONG_TILES])
                             : !isnan(row->metric[FM_METRIC_FRAGMENTS_WANTED]) &&
                                   !isnan(row->metric[FM_METRIC_SELF_BEYOND]);
}

fm_blame blame_case(const fm_case_row *row)
{
    fm_blame blame = { .verdict = FM_STABILITY_NONE };
    if (has_trait(row, FM_TRAIT_FLOOR) || row->outcome == FM_CASE_SKIPPED)
        return blame;
    if (row->outcome == FM_CASE_NOT_SUPPORTED)
        blame.verdict = FM_STABILITY_NOT_SUPPORTED;
    else if (row->outcome != FM_CASE_OK && row->outcome != FM_CASE_WRONG_IMAGE)
        blame.verdict = FM_STABILITY_FAILED;
    else if (!is_recorded(row))
        blame.verdict = FM_STABILITY_UNKNOWN;
    else
        blame_measured(&blame, row);
    return blame;
}

bool blame_is_open(const fm_blame *blame)
{
    return blame->unexplained != 0 || blame->verdict == FM_STABILITY_FAILED;
}

static void add_word(char words[BLAME_WORDS_BYTES], const char *word)
{
    snprintf(words + strlen(words), BLAME_WORDS_BYTES - strlen(words), "%s%.150s",
             words[0] != '\0' ? ", " : "", word);
}

void blame_words(char words[BLAME_WORDS_BYTES], const fm_blame *blame, const fm_case_row *row)
{
    words[0] = '\0';
    if (blame->verdict == FM_STABILITY_NOT_SUPPORTED)
        add_word(words, row->reason[0] != '\0' ? row->reason : "not recorded");
    else if (blame->verdict == FM_STABILITY_FAILED)
        add_word(words, row->status);
    for (unsigned bit = 0; trait_words(bit) != NULL; bit++)
        if ((blame->traits & 1u << bit) != 0)
            add_word(words, trait_words(bit));
    if ((blame->wrong & ~blame->unexplained & FM_WRONG_TILES) != 0)
        add_word(words, "not declared exact");
}
