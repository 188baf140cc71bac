/* Cases that several shards have. */
#ifndef FM_MERGE_OVERLAP_H
#define FM_MERGE_OVERLAP_H

#include "shard_set.h"

/* Holds each row against the one that is merged of its case, in all columns in which the same code
 * gives the same: keys, status, and metrics that are no measurement (model/metrics.h). Of methods
 * whose fragments race, and of rows whose images differed, only memory and the scene are compared;
 * of rows of two drivers, which round otherwise, all but the errors.
 * FM_UNSUPPORTED: naming case, column, and both values. */
fm_status overlap_check(const shard_set *set, fm_error *err);

#endif
