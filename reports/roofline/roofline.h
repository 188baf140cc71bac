/* How far methods are from what each device allows.
 *
 * The room reports/roofline gathers the cases of each calibrated device, and draws them under the
 * lines that the device cannot pass. It measures nothing: the limits are columns of summary.csv. */
#ifndef FM_ROOFLINE_H
#define FM_ROOFLINE_H

#include "draw/chart.h"
#include "read/cases.h"
#include "read/result_files.h"

/* One device, as the calibration of one machine has it. */
typedef struct fm_roofline {
    const char *device_name;
    double bytes_per_s, fragments_per_s; /* its limits; fragments_per_s NAN: not measured */
    const fm_case_row **cases; /* [count], of which each has times_bound; by method; owned */
    size_t count;
} fm_roofline;

typedef struct fm_rooflines {
    fm_roofline *items; /* in the order of their first cases; owned */
    size_t count;
} fm_rooflines;

/* Cases that were measured on devices with limits, but for controls. The results must outlive them.
 * FM_NO_MEMORY; there are then none. The caller frees them. */
fm_status rooflines_make(fm_rooflines *made, const fm_result_files *results, fm_error *err);
void rooflines_free(fm_rooflines *made);

/* Cases by times_bound, the nearest to the bound first; [count], for free(). NULL: no memory. */
const fm_case_row **roofline_sorted(const fm_roofline *of);

/* bytes_moved for each fragment of the scene; NAN: not counted, or 0. */
double roofline_bytes(const fm_case_row *result);

/* roofline_chart.c. x: bytes moved for each fragment; y: fragments a second, with their interval;
 * both log. Lines: copying at the device's rate, and its raster floor. Hollow: status is not ok.
 * FM_UNSUPPORTED: no case has counted accesses. The caller frees *chart. */
fm_status roofline_chart(fm_chart *chart, const fm_roofline *of, fm_error *err);

#endif
