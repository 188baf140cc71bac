/* The parts of report.html that are the same in all reports, or told by the manifest alone. Out of
 * memory is remembered in the page's `failed`. */
#ifndef FM_PAGE_H
#define FM_PAGE_H

#include "base/text.h"
#include "read/result_files.h"

/* From <!doctype> to <body>, with the styles. missing_count: of the results (publish.h). */
void page_open(fm_text *page, const char *title, size_t missing_count);
/* page_open, and on to how far times are to be trusted, what, where and when. is_untimed: the run
 * is for figures without times alone (model/figure_file.h), which need no more than one launch. */
void page_begin(fm_text *page, const fm_result_files *results, bool is_untimed);
/* Links to the parts; papers: ids of those that have a part. */
void page_add_links(fm_text *page, const fm_text_list *papers);
/* How to read: floor, times_floor, intervals, errors, frontier. */
void page_add_guide(fm_text *page);
/* What limits these results: races that this machine cannot show, failed cases, few launches. */
void page_add_notes(fm_text *page, const fm_result_files *results, bool is_untimed);
/* Machine, devices, methods with version and citation. */
void page_add_machine(fm_text *page, const fm_result_files *results);
/* Scripts, and the end of the page. */
void page_end(fm_text *page);

#endif
