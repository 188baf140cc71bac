/* Of each paper: verdicts first, then its figures. */
#ifndef FM_PAPER_SECTION_H
#define FM_PAPER_SECTION_H

#include "writer.h"

/* Adds the papers of the report's figures, each once. Out of memory is remembered in the page. */
void paper_sections_names(fm_text_list *names, fm_text *page, const fm_report_desc *desc);
/* The sections of these papers. FM_IO, FM_NO_MEMORY; FM_INVALID: a chart that cannot be drawn. */
fm_status paper_sections_add(fm_writer *to, const fm_text_list *names);

#endif
