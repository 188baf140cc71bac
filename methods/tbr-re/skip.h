/* Rendering Elimination's decision, shared by all techniques that sign tiles. */
#ifndef TBR_RE_SKIP_H
#define TBR_RE_SKIP_H

#include "fragmark/technique.h"

static inline bool re_skip(const fm_tile_start *tile)
{
    return tile->previous_valid && tile->signature == tile->previous;
}

#endif
