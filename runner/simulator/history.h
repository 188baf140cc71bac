/* What a frame has to do with the one before, for techniques that ask: how near each object came,
 * and whether a texture was uploaded anew. Kept per object and texture, not per tile. */
#ifndef FM_TBR_HISTORY_H
#define FM_TBR_HISTORY_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/frames.h"

typedef struct history history;

fm_status history_create(history **made, fm_error *err);
void history_destroy(history *self);

/* Whether a texture that was seen before has another version now; from then on that is the known
 * one. FM_NO_MEMORY. */
fm_status history_uploads(bool *has_uploads, history *self, const fm_frame *frame, fm_error *err);

/* Orders draw calls: stretches of neighbours with may_move[draw] become front to back by how near
 * their objects came in the last frame; new objects come last, and what is equally near stays in
 * submission order. order has draw_count entries. FM_NO_MEMORY. */
fm_status history_order(uint32_t *order, history *self, const fm_frame *frame, const bool *may_move,
                        fm_error *err);

#endif
