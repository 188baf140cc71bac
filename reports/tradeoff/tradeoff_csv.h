/* What stands behind the charts of speed against error. */
#ifndef FM_TRADEOFF_CSV_H
#define FM_TRADEOFF_CSV_H

#include "base/text.h"
#include "standing.h"

/* One row for each case that has a time and an error:
 * workload,scene,device,feed,method,options,k,n,case_id,status,error_metric,error,truncation_rmse,rmse,
 * frame_ms,frame_ms_low,frame_ms_high,bytes_allocated,standing,beaten_by
 * standing: among cases of the same n. error: as charted, 0 where exact. beaten_by: a case_id.
 * FM_NO_MEMORY. */
fm_status tradeoff_csv_add(fm_text *csv, const fm_groups *groups, const fm_error_kind *kind,
                           fm_error *err);

#endif
