/* Animated draw-call sequences in the manner of mobile games, for the simulated tile-based GPU.
 *
 * A frame, in the order drawn: `backgrounds` full-screen quads without depth; objects with depth,
 * grids of `triangles` in all, together `depth_complexity` screens, before a backdrop; sprites
 * without depth, in batches of eight; under the opaque panels, one sprite for each 64 x 64 px that
 * changes with probability `hidden_churn` in a frame; panels. The camera moves backgrounds and
 * objects, near ones more than far ones; movers go to and fro by themselves. All motion is in
 * sixteenths of a pixel, so that what stops is bit-identical. The same settings give the same
 * frames on every machine. */
#ifndef FM_GENERATORS_FRAMES_H
#define FM_GENERATORS_FRAMES_H

#include "model/settings.h"
#include "scene/frames.h"

/* FM_INVALID: a viewport over FRAMES_SIDE_MAX; FM_NO_MEMORY. */
fm_status frames_generate(fm_sequence **sequence, const fm_settings *settings, fm_error *err);

/* What generators of such sequences share: whether the viewport is one they can fill, and a draw
 * call of one opaque quad without depth at the costs that the settings say. */
fm_status frames_check_size(const fm_settings *settings, fm_error *err);
fm_draw_call frames_plain_draw(const fm_settings *settings);

#endif
