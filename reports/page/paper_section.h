/* Of each paper: verdicts first, then its figures. */
#ifndef FM_PAPER_SECTION_H
#define FM_PAPER_SECTION_H

#include "writer.h"

/* The papers of the report's figures, each once. */
fm_name_list paper_sections_names(const fm_report_desc *desc);
/* FM_IO, FM_NO_MEMORY; FM_INVALID: a chart that cannot be drawn. */
fm_status paper_sections_add(fm_writer *to);

#endif
