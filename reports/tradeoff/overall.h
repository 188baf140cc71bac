/* Methods over several workloads: speed against error, all told. */
#ifndef FM_OVERALL_H
#define FM_OVERALL_H

#include "standing.h"

/* One method with its options and k, that was ok in all workloads. */
typedef struct fm_overall_point {
    const fm_case_row *row; /* of the first workload */
    fm_span ratio;          /* geometric mean of its time over that of the cheapest exact case */
    double error;           /* the worst of all workloads */
} fm_overall_point;

/* All workloads of one device and feed that have an exact case. */
typedef struct fm_overall {
    const char *device, *feed;
    size_t workload_count, scene_count; /* scenes of different names */
    fm_overall_point *points;           /* in the order of the first workload; owned */
    size_t point_count;
} fm_overall;

typedef struct fm_overalls {
    fm_overall *items; /* owned */
    size_t count;
} fm_overalls;

/* Those with two scenes or more. FM_NO_MEMORY; the caller frees them, after a failure too. */
fm_status overalls_make(fm_overalls *overalls, const fm_groups *groups, const fm_error_kind *kind,
                        fm_error *err);
void overalls_free(fm_overalls *overalls);

#endif
