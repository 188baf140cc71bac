/* The cases of a comparison: made of both plans, and kept up with what the runs know. */
#ifndef FM_AB_CASES_H
#define FM_AB_CASES_H

#include "pairs.h"

/* Joins the plans, and makes room for all pairs' numbers. FM_INVALID as sides_join; FM_NO_MEMORY.
 * ab_free after a failure, too. */
fm_status cases_make(ab_result *result, const ab_desc *desc, fm_error *err);

/* Takes status and outputs of all cases from the runs, which statistics a case has, and what
 * counts; and sets the verdicts that follow. After each stage: a status may have become worse. */
void cases_update(ab_session *session);

#endif
