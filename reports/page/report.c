#include "report.h"

#include "page.h"
#include "paper_section.h"
#include "picture_section.h"
#include "publish.h"
#include "read/group.h"
#include "speed_section.h"
#include "stability/stability_csv.h"
#include "stability_section.h"
#include "tradeoff/tradeoff_csv.h"
#include "writer.h"

/* All its figures say so. */
static bool is_untimed(const fm_report_desc *desc)
{
    for (size_t i = 0; i < desc->figure_count; i++)
        if (!desc->figures[i]->file.is_untimed)
            return false;
    return desc->figure_count > 0;
}

static fm_status write_sections(fm_writer *to, fm_text *tradeoff, fm_text *stability,
                                const fm_report_desc *desc)
{
    fm_groups groups;
    const fm_groups_desc all = { 0 };
    fm_status status = groups_make(&groups, to->results, &all, to->err);
    if (status != FM_OK)
        return status;
    fm_text_list papers = { 0 };
    paper_sections_names(&papers, &to->page, desc);
    page_begin(&to->page, to->results, is_untimed(desc));
    page_add_links(&to->page, &papers);
    status = paper_sections_add(to, &papers);
    if (status == FM_OK)
        status = picture_section_add(to, &groups);
    if (status == FM_OK)
        status = speed_section_add(to, &groups, desc->figure_count > 0);
    if (status == FM_OK)
        status = hardware_section_add(to);
    if (status == FM_OK)
        status = stability_section_add(to);
    if (status == FM_OK)
        status = stability_csv_add(stability, to->results, to->err);
    if (status == FM_OK)
        status = tradeoff_csv_add(tradeoff, &groups, desc->error, to->err);
    page_add_notes(&to->page, to->results, is_untimed(desc));
    page_add_guide(&to->page);
    page_add_machine(&to->page, to->results);
    page_end(&to->page);
    text_list_free(&papers);
    groups_free(&groups);
    return status;
}

fm_status report_write(fm_report_outcome *outcome, const fm_report_desc *desc, fm_error *err)
{
    const char *directory = desc->results->directory;
    fm_writer to = { .desc = desc, .results = desc->results, .outcome = outcome, .err = err };
    *outcome = (fm_report_outcome){ 0 };
    fm_status status = publish_begin(directory, desc->results->missing.count, err);
    if (status != FM_OK)
        return status;
    fm_text tradeoff = { 0 }, stability = { 0 };
    status = write_sections(&to, &tradeoff, &stability, desc);
    if (status == FM_OK && to.page.failed)
        status = fm_fail(err, FM_NO_MEMORY, "report.html");
    const fm_publish_desc made = { directory, &to.page, desc->verdicts, &tradeoff, &stability };
    if (status == FM_OK)
        status = publish_end(&made, err);
    publish_drop(directory);
    text_free(&to.page);
    text_free(&tradeoff);
    text_free(&stability);
    return status;
}
