/* A paper's figure drawn from a run's results: one chart for each group of its cases. The kinds of
 * charts are drawn in figure_lines, figure_bars and figure_tornado. */
#ifndef FM_FIGURE_CHARTS_H
#define FM_FIGURE_CHARTS_H

#include "figure_values.h"

/* Where the cases of one chart come from: a run, or another machine's to compare with. Borrowed. */
typedef struct fm_figure_source {
    const fm_result_files *results; /* NULL only where group is NULL */
    const fm_group *group;          /* NULL: none */
} fm_figure_source;

/* The group of the reference with the workload of a group, whatever the device and the size of the
 * viewport; *found is NULL where there is none. FM_NO_MEMORY. */
fm_status figure_reference_group(const fm_group **found, const fm_groups *reference,
                                 const fm_group *group, const fm_figure_chart *chart,
                                 fm_error *err);

/* Makes one chart of the figure.
 * from       which of the figure's charts
 * own        the cases; its group is needed
 * reference  another machine's, drawn thin by kind `lines` alone
 * Over k, methods whose time does not depend on k are level lines; where n = r k, they stand at the
 * k of their layers. FM_UNSUPPORTED: the group has nothing to draw in it, with the reason;
 * FM_NO_MEMORY. The caller frees *chart, after a failure too. */
fm_status figure_chart_make(fm_chart *chart, const fm_paper_figure *figure,
                            const fm_figure_chart *from, const fm_figure_source *own,
                            const fm_figure_source *reference, fm_error *err);

#endif
