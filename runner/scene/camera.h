/* Where a mesh scene is seen from. */
#ifndef FM_CAMERA_H
#define FM_CAMERA_H

#include "base/error.h"
#include "mesh/space.h"
#include "model/settings.h"

/* Column major: perspective of settings' camera into Vulkan's clip space (x right, y down, z 0..1
 * from the near to the far plane). It takes points of the space, in which box lies; settings are in
 * the units outside, and are moved into the space in doubles. box is what the camera must see:
 *   eye == target   the eye stands in three-quarter view so that the box just fills the viewport;
 *                   zoom enlarges the image about its centre
 *   near_plane 0    0.4 of the least view depth of the box's corners (a thousandth of the greatest
 *                   depth, if the eye is within the box)
 *   far_plane 0     1.7 of the greatest
 * FM_INVALID: the box lies behind the eye, near_plane >= far_plane, or the eye or a plane is so
 * far from the box that floats, or the rules of rasterise.h, do not hold what it sees. */
fm_status camera_matrix(double clip_from_space[16], const fm_settings *settings,
                        const fm_space *space, const fm_box *box, fm_error *err);

#endif
