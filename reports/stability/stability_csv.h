/* What stands behind the matrices: what was measured of each case, and what it is held against. */
#ifndef FM_STABILITY_CSV_H
#define FM_STABILITY_CSV_H

#include "base/text.h"
#include "read/result_files.h"

/* One row for each case but those of floors and skipped ones:
 * case_id,device,device_name,is_software,feed,scene,order,method,traits,options,k,n,status,verdict,
 * wrong,reasons,unexplained, and then numbers, each by its metric's name.
 * traits: names with blanks between. wrong, unexplained: as wrong_name, with blanks between; of a
 * case that failed, its status. is_software: 0 or 1; empty where the
 * manifest does not list the device yet. FM_NO_MEMORY. */
fm_status stability_csv_add(fm_text *csv, const fm_result_files *results, fm_error *err);

#endif
