#include "paper_section.h"

#include <stdio.h>
#include <string.h>

#include "draw/figure_charts.h"
#include "html.h"
#include "memory_rows.h"
#include "read/figure_cases.h"
#include "verdict_table.h"

static const struct {
    const char *id, *title;
} papers[] = {
    { "kplus", "k+-buffer: Fragment Synchronized k-buffer (Vasilakis and Fudos, I3D 2014)" },
    { "sbuffer", "S-buffer: Sparsity-aware Multi-fragment Rendering (Vasilakis and Fudos, "
                 "Eurographics 2012)" },
    { "occupancy", "Improving k-buffer methods via Occupancy Maps (Vasilakis and Papaioannou, "
                   "Eurographics 2015)" },
    { "evr", "Early Visibility Resolution (Anglada et al., HPCA 2019)" },
};

static const char *paper_title(const char *id)
{
    for (size_t i = 0; i < sizeof papers / sizeof papers[0]; i++)
        if (strcmp(papers[i].id, id) == 0)
            return papers[i].title;
    return strcmp(id, "none") == 0 ? "Figures of no paper" : id;
}

/* Groups of one chart: cases of the figure that differ in its x only. */
static fm_status make_groups(fm_groups *groups, const fm_result_files *results,
                             const fm_paper_figure *figure, const fm_figure_chart *chart,
                             fm_error *err)
{
    *groups = (fm_groups){ 0 };
    if (results == NULL)
        return FM_OK;
    const fm_figure_cases cases = figure_cases(results, figure);
    const fm_groups_desc desc = { .filter = figure_takes_case,
                                  .context = &cases,
                                  .free_columns = &chart->free_columns };
    return groups_make(groups, results, &desc, err);
}

/* Milliseconds of two machines in one chart say little: ratios only, unless it is asked for. */
static bool shows_reference(const fm_writer *to, const fm_figure_chart *chart)
{
    return chart->ratio_to != NULL || to->desc->draws_reference;
}

static fm_status add_chart(fm_writer *to, const fm_paper_figure *figure,
                           const fm_figure_chart *from, const fm_figure_source *own,
                           const fm_figure_source *reference)
{
    char name[256];
    fm_chart chart;
    snprintf(name, sizeof name, "%.60s-%.40s-%.120s", figure->id, from->id, own->group->name);
    const fm_status status = figure_chart_make(&chart, figure, from, own, reference, to->err);
    return writer_add_chart(to, &chart, status, name);
}

static fm_status add_charts(fm_writer *to, const fm_paper_figure *figure,
                            const fm_figure_chart *from, size_t *drawn)
{
    fm_groups groups, reference_groups;
    const fm_result_files *reference = shows_reference(to, from) ? to->desc->reference : NULL;
    fm_status status = make_groups(&groups, to->results, figure, from, to->err);
    if (status != FM_OK)
        return status;
    status = make_groups(&reference_groups, reference, figure, from, to->err);
    for (size_t i = 0; i < groups.count && status == FM_OK; i++) {
        const fm_figure_source own = { to->results, &groups.groups[i] };
        fm_figure_source other = { .results = reference };
        status = figure_reference_group(&other.group, &reference_groups, own.group, from, to->err);
        if (status == FM_OK)
            status = add_chart(to, figure, from, &own, &other);
        (*drawn)++;
    }
    groups_free(&groups);
    groups_free(&reference_groups);
    return status;
}

static void add_deviations(fm_text *page, const fm_paper_figure *figure)
{
    if (figure->deviations.count == 0)
        return;
    text_add(page, "<p>Deviations:</p>\n<ul>\n");
    for (size_t i = 0; i < figure->deviations.count; i++) {
        text_add(page, "<li>");
        html_add(page, figure->deviations.items[i]);
        text_add(page, "</li>\n");
    }
    text_add(page, "</ul>\n");
}

static fm_status add_figure(fm_writer *to, const fm_paper_figure *figure)
{
    fm_status status = FM_OK;
    size_t drawn = 0;
    text_add(&to->page, "<h3 id=\"figure-%s\">", figure->id);
    html_add(&to->page, figure->title);
    text_add(&to->page, "</h3>\n<p class=faint>");
    html_add(&to->page, figure->source);
    text_add(&to->page,
             "</p>\n<p class=links>Data: <a href=\"summary.csv\">summary.csv</a> "
             "<a href=\"samples.csv\">samples.csv</a>%s</p>\n",
             figure->has_table ? " <a href=\"memory.csv\">memory.csv</a>" : "");
    for (size_t i = 0; i < figure->chart_count && status == FM_OK; i++)
        status = add_charts(to, figure, &figure->charts[i], &drawn);
    if (drawn == 0 && figure->chart_count > 0)
        text_add(&to->page, "<p class=note>No case of this run belongs to this figure.</p>\n");
    memory_rows_add(&to->page, to->results->memory, figure->id);
    add_deviations(&to->page, figure);
    return status;
}

static fm_status add_paper(fm_writer *to, const char *paper)
{
    const fm_report_desc *desc = to->desc;
    fm_status status = FM_OK;
    text_add(&to->page, "<h2 id=\"paper-");
    html_add(&to->page, paper);
    text_add(&to->page, "\">");
    html_add(&to->page, paper_title(paper));
    text_add(&to->page, "</h2>\n");
    verdict_table_add(&to->page, desc->verdicts, paper);
    for (size_t i = 0; i < desc->figure_count && status == FM_OK; i++)
        if (strcmp(desc->figures[i]->paper, paper) == 0)
            status = add_figure(to, desc->figures[i]);
    return status;
}

void paper_sections_names(fm_text_list *names, fm_text *page, const fm_report_desc *desc)
{
    for (size_t i = 0; i < desc->figure_count; i++)
        if (!text_list_has(names, desc->figures[i]->paper))
            page->failed |= !text_list_add(names, desc->figures[i]->paper);
}

fm_status paper_sections_add(fm_writer *to, const fm_text_list *names)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < names->count && status == FM_OK; i++)
        status = add_paper(to, names->items[i]);
    return status;
}
