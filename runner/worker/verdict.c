#include "verdict.h"

#include <inttypes.h>
#include <stdio.h>

static bool are_fragments_wrong(fm_error *err, const fm_check *check, uint64_t lost)
{
    const fm_losses *excused = &check->excused;
    const uint64_t missing = check->missing - excused->at_depth_one - excused->of_ties;
    if (check_faults(check) + lost == 0)
        return false;
    fm_fail(err, FM_OK,
            "declared exact, but missing %" PRIu64 ", extra %" PRIu64 ", misordered %" PRIu64
            ", lost %" PRIu64 " fragments in %" PRIu64 " pixels",
            missing, check->extra, check->misordered, lost, check->wrong_pixels);
    return true;
}

bool verdict_is_wrong(fm_error *err, const fm_measurement *measurement, uint32_t traits, uint32_t n)
{
    const double allowed = image_rounding(n);
    if ((traits & FM_TRAIT_EXACT) == 0)
        return false;
    if (are_fragments_wrong(err, &measurement->check, measurement->lost) ||
        are_fragments_wrong(err, &measurement->worst_check, measurement->lost))
        return true;
    if (measurement->self_beyond > allowed)
        fm_fail(err, FM_OK,
                "declared exact, but the timed image is %.3g from its own fragments (%.2g is "
                "allowed)",
                measurement->self_beyond + measurement->self_bound,
                measurement->self_bound + allowed);
    else if (measurement->frames_beyond > allowed)
        fm_fail(err, FM_OK,
                "declared exact, but the image of a timed frame is %.3g from all that truth allows "
                "(%.2g is allowed)",
                measurement->frames_beyond, allowed);
    else if (!measurement->may_differ && (traits & FM_TRAIT_RACY) == 0 &&
             measurement->distinct_images > 1)
        fm_fail(err, FM_OK, "declared exact, but its timed frames drew %u different images",
                measurement->distinct_images);
    else
        return false;
    return true;
}

bool verdict_frames_are_wrong(fm_error *err, const fm_technique_outcome *outcome, uint32_t traits)
{
    const bool is_exact = (traits & FM_TRAIT_EXACT) != 0;
    if (outcome->wrong_tiles == 0)
        return false;
    fm_fail(err, FM_OK,
            "%s%" PRIu64 " tiles in %u of %u frames are not the baseline's, the first in frame %u",
            is_exact ? "declared exact, but " : "", outcome->wrong_tiles, outcome->wrong_frames,
            outcome->frames, outcome->first_wrong_frame);
    return is_exact;
}

/* What such an access reads or writes is another's, and nothing says that it stays without harm on
 * the next device. */
bool verdict_accesses(char text[VERDICT_ACCESSES_BYTES], const fm_measurement *m)
{
    size_t length = 0;
    text[0] = '\0';
    if (m->uncounted[0] != '\0')
        length = (size_t)snprintf(text, VERDICT_ACCESSES_BYTES, "bytes_moved is not counted: %s",
                                  m->uncounted);
    for (size_t i = 0; i < m->accesses_count && length < VERDICT_ACCESSES_BYTES; i++)
        if (m->accesses[i].counts.outside > 0)
            length += (size_t)snprintf(
                text + length, VERDICT_ACCESSES_BYTES - length,
                "%sOUT OF RANGE: %" PRIu64 " accesses beyond the end of '%s'",
                length > 0 ? "; " : "", m->accesses[i].counts.outside, m->accesses[i].name);
    return length > 0;
}

bool verdict_loss(char text[VERDICT_LOSS_BYTES], const fm_check *check)
{
    const uint64_t at_one = check->excused.at_depth_one, ties = check->excused.of_ties;
    const char *const fragments = at_one + ties == 1 ? "fragment" : "fragments";
    if (at_one > 0 && ties > 0)
        snprintf(text, VERDICT_LOSS_BYTES,
                 "declared loss: %" PRIu64 " fragments at depth 1, %" PRIu64 " of equal depths",
                 at_one, ties);
    else if (at_one > 0)
        snprintf(text, VERDICT_LOSS_BYTES, "declared loss: %" PRIu64 " %s at depth 1", at_one,
                 fragments);
    else if (ties > 0)
        snprintf(text, VERDICT_LOSS_BYTES, "declared loss: %" PRIu64 " %s of equal depths", ties,
                 fragments);
    return at_one + ties > 0;
}
