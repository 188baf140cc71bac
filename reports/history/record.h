/* A run becomes rows of the history. */
#ifndef FM_HISTORY_RECORD_H
#define FM_HISTORY_RECORD_H

#include "database.h"
#include "read/result_files.h"

typedef enum fm_recorded {
    FM_RECORDED_NEW,     /* the run was not there */
    FM_RECORDED_REPLACED /* it was, as it was then: it went on, say; it still is one entry */
} fm_recorded;

/* Records machine, run, each case with its numbers, and each launch with its time and the floor's,
 * in one transaction. A run is known by its run_id, a machine by its hardware
 * (model/hardware.h). Of results as database.h says, and FM_UNSUPPORTED: the manifest does not
 * tell run, beginning or machine, so that the run has no place in a history. */
fm_status history_record(fm_recorded *recorded, fm_history *history, const fm_result_files *results,
                         fm_error *err);

#endif
