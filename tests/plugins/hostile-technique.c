/* Techniques of the simulated GPU that are good but for one hook, HOOK, which does a deed of
 * deeds.h, DEED, each time that it is called, or answers what is no answer, GARBAGE. */
#include "deeds.h"
#include "fragmark/technique.h"
#include "head.h"

#ifndef DEED
#define DEED nothing
#endif
#ifndef GARBAGE
#define GARBAGE 0
#endif

enum { in_predict, in_place, in_sign, in_skip, in_tile_end };

static void act(int hook)
{
    if (hook == HOOK)
        DEED();
}

/* What C lets a hook answer. */
static unsigned answer(int hook, unsigned good)
{
    return hook == HOOK && GARBAGE != 0 ? GARBAGE : good;
}

static fm_prediction predict(const fm_pair *pair)
{
    const unsigned bits = answer(in_predict, FM_VISIBLE);
    fm_prediction prediction;
    (void)pair;
    act(in_predict);
    memcpy(&prediction, &bits, sizeof prediction);
    return prediction;
}

static fm_place place(const fm_pair *pair, fm_prediction prediction)
{
    const unsigned bits = answer(in_place, FM_PLACE_FIRST);
    fm_place where;
    (void)pair;
    (void)prediction;
    act(in_place);
    memcpy(&where, &bits, sizeof where);
    return where;
}

static bool sign(uint32_t *bits, const fm_pair *pair, fm_prediction prediction)
{
    (void)pair;
    (void)prediction;
    act(in_sign);
    *bits = answer(in_sign, 0);
    return true;
}

static bool skip(const fm_tile_start *tile)
{
    act(in_skip);
    return tile->previous_valid && tile->signature == tile->previous;
}

static void tile_end(fm_tile_end *tile)
{
    const unsigned outcome = answer(in_tile_end, FM_TILE_FLUSHED);
    act(in_tile_end);
    memcpy(&tile->outcome, &outcome, sizeof outcome);
}

static const fm_technique technique = {
    .parts = FM_PART_VISIBILITY | FM_PART_SIGNATURES,
    .predict = predict,
    .place = place,
    .sign = sign,
    .skip = skip,
    .tile_end = tile_end,
};

const fm_method_desc fm_method = {
    HEAD(ID),
    .feeds = FM_FEED_FRAMES,
    .keeps = FM_KEEPS_NEAREST,
    .technique = &technique,
};
