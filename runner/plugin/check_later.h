/* Fields that the interface has and this version does not know what to do with. A plugin that sets
 * one is refused, so that none is ever misread in silence; whoever teaches the runner such a field
 * deletes its row. */
#ifndef FM_CHECK_LATER_H
#define FM_CHECK_LATER_H

#include "base/error.h"
#include "fragmark/method.h"

/* FM_INVALID with "FIELD: not yet" where any byte of such a field is set: zero is the default. */
fm_status check_later_method(const fm_method_desc *method, fm_error *err);
fm_status check_later_pass(const fm_pass *pass, fm_error *err);

#endif
