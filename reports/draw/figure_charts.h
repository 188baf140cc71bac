/* A paper's figure drawn from a run's results. */
#ifndef FM_FIGURE_CHARTS_H
#define FM_FIGURE_CHARTS_H

#include "figure_values.h"

/* The cases of one chart: of a run, and of another machine's to compare with. */
typedef struct fm_figure_source {
    const fm_result_files *results;
    const fm_group *group; /* NULL: none */
} fm_figure_source;

/* The group of the reference with the workload of a group, whatever the device and the size of the
 * viewport; *found is NULL where there is none. FM_NO_MEMORY. */
fm_status figure_reference_group(const fm_group **found, const fm_groups *reference,
                                 const fm_group *group, const fm_figure_chart *chart,
                                 fm_error *err);

/* One chart of the figure for one group. Methods that do not use k are level lines. FM_UNSUPPORTED:
 * the group has nothing to draw in it, with the reason. The caller frees *chart. */
fm_status figure_chart_make(fm_chart *chart, const fm_paper_figure *figure,
                            const fm_figure_chart *from, const fm_figure_source *own,
                            const fm_figure_source *reference, fm_error *err);

#endif
