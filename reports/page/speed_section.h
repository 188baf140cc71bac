/* Speed against error: of each workload a chart, and the table of its cases. And speed against what
 * the device allows: a chart and a table for each device. */
#ifndef FM_SPEED_SECTION_H
#define FM_SPEED_SECTION_H

#include "read/group.h"
#include "writer.h"

/* is_folded: the workloads open when they are asked for. FM_IO, FM_NO_MEMORY; FM_INVALID: a chart
 * that cannot be drawn. */
fm_status speed_section_add(fm_writer *to, const fm_groups *groups, bool is_folded);
/* The same statuses. */
fm_status hardware_section_add(fm_writer *to);

#endif
