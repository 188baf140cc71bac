/* Whether passes may run on a scene whose projection is reversed. */
#ifndef FM_DEPTH_CHECK_H
#define FM_DEPTH_CHECK_H

#include "base/error.h"
#include "model/descriptor.h"
#include "model/settings.h"

/* With depth=reversed methods see depths that grow from near to far, and attachments those that
 * were rasterised, which fall. FM_UNSUPPORTED: a scene pass tests the rasterised depth; names the
 * pass and its attachment. */
fm_status depth_check_pass(const fm_pass *pass, const fm_settings *settings, fm_error *err);
/* All passes of the method. */
fm_status depth_check(const fm_method_desc *method, const fm_settings *settings, fm_error *err);

#endif
