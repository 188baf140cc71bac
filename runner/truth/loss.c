#include "loss.h"

static const uint32_t of_ties = FM_TRAIT_LOSES_TIES | FM_TRAIT_PASSES_LOSE_TIES;

/* The first of the fragments, from `first` on, that is not `depth` or nearer. */
static uint32_t run_end(const fm_fragment *fragments, uint32_t first, uint32_t count, float depth)
{
    while (first < count && fragments[first].depth <= depth)
        first++;
    return first;
}

/* `missing` of the fragments at one depth, of which `survivors` were handed over. */
static void add_missing(fm_losses *losses, uint32_t traits, float depth, uint32_t missing,
                        uint32_t survivors)
{
    if ((traits & FM_TRAIT_LOSES_DEPTH_ONE) != 0 && depth >= 1.0f && depth <= 1.0f)
        losses->at_depth_one += missing;
    else if ((traits & of_ties) != 0)
        losses->of_ties += survivors > 0 ? missing : missing - 1; /* one had to survive */
}

void loss_count(fm_losses *losses, uint32_t traits, const fm_fragment *captured,
                uint32_t captured_count, const fm_fragment *truth, uint32_t wanted)
{
    uint32_t at = 0;
    if ((traits & (FM_TRAIT_LOSES_DEPTH_ONE | of_ties)) == 0)
        return;
    for (uint32_t first = 0, end; first < wanted; first = end) {
        const float depth = truth[first].depth;
        end = run_end(truth, first + 1, wanted, depth);
        while (at < captured_count && captured[at].depth < depth)
            at++;
        const uint32_t survivors = run_end(captured, at, captured_count, depth) - at;
        if (survivors < end - first)
            add_missing(losses, traits, depth, end - first - survivors, survivors);
    }
}

bool loss_may_touch(uint32_t traits, const fm_fragment *truth, uint32_t wanted)
{
    if ((traits & FM_TRAIT_LOSES_DEPTH_ONE) != 0 && wanted > 0 && truth[wanted - 1].depth >= 1.0f)
        return true;
    for (uint32_t i = 1; (traits & of_ties) != 0 && i < wanted; i++)
        if (truth[i].depth <= truth[i - 1].depth)
            return true;
    return false;
}
