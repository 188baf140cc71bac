#include "comparison_page.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "draw/dumbbell.h"
#include "html.h"
#include "page.h"

enum { DIGITS = 4 };

/* The colours of verdicts on claims (page.css): holds, unclear, fails, not testable. */
static const int verdict_class[] = {
    [FM_COMPARED_SLOWER] = 3, [FM_COMPARED_UNCLEAR] = 2, [FM_COMPARED_SAME] = 0,
    [FM_COMPARED_FASTER] = 0, [FM_COMPARED_UNTIMED] = 4,
};

static void add_cell(fm_text *page, const char *text)
{
    text_add(page, "<td>");
    html_add(page, text);
    text_add(page, "</td>");
}

static void add_run(fm_text *page, const char *name, const fm_result_files *run)
{
    text_add(page, "<dt>%s</dt><dd>", name);
    html_add(page, run->directory);
    text_add(page, "<br>");
    html_add(page, provenance_fact(run->manifest, "command"));
    text_add(page, "</dd>\n");
}

static void add_head(fm_text *page, const fm_comparison *comparison)
{
    fm_text summary = { 0 };
    comparison_add_summary(&summary, comparison);
    text_add(page, "<h1>fragmark compare</h1>\n<p>");
    html_add(page, summary.bytes != NULL ? summary.bytes : "");
    text_add(page, ".</p>\n<dl>\n");
    add_run(page, "BASE", comparison->base_run);
    add_run(page, "NEW", comparison->now_run);
    text_add(page, "</dl>\n");
    page->failed |= summary.failed;
    text_free(&summary);
}

static void add_machines(fm_text *page, const fm_machines *machines)
{
    text_add(page, "<h2>Where they were made</h2>\n<p>%s machine, %s day.</p>\n",
             machines->is_same_machine ? "One" : "Not known to be one",
             machines->is_same_day ? "one" : "not one");
    if (machines->count == 0)
        return;
    text_add(page, "<div class=table><table><thead><tr><th>differs</th><th>BASE</th><th>NEW</th>"
                   "</tr></thead><tbody>\n");
    for (size_t i = 0; i < machines->count; i++) {
        text_add(page, "<tr>");
        add_cell(page, machines->differing[i].name);
        add_cell(page, machines->differing[i].base);
        add_cell(page, machines->differing[i].now);
        text_add(page, "</tr>\n");
    }
    text_add(page, "</tbody></table></div>\n");
}

static fm_status add_chart(fm_text *page, const fm_comparison *comparison, fm_error *err)
{
    fm_chart chart;
    char *svg = NULL;
    fm_status status = dumbbell_chart(&chart, comparison, err);
    text_add(page, "<h2>Times</h2>\n");
    if (status == FM_OK)
        status = chart_svg(&svg, &chart, err);
    chart_free(&chart);
    if (status == FM_UNSUPPORTED) {
        text_add(page, "<p class=note>No chart: ");
        html_add(page, err->message);
        text_add(page, ".</p>\n");
        return FM_OK;
    }
    if (status == FM_OK)
        text_add(page, "<div class=chart>%s</div>\n", svg);
    free(svg);
    return status;
}

static void add_row(fm_text *page, const fm_compared *compared)
{
    char name[FM_COMPARED_NAME_BYTES];
    const char *verdict = compared_verdict_name(compared->verdict);
    fm_text changes = { 0 };
    compared_name(name, compared->pair.base);
    compared_add_changes(&changes, compared);
    text_add(page, "<tr data-verdict=\"%s\"><td class=name><span class=\"verdict v%d\">%s</span>",
             verdict, verdict_class[compared->verdict], verdict);
    text_add(page, "</td>");
    html_add_number(page, DIGITS, compared->ratio.median);
    html_add_number(page, DIGITS, compared->ratio.low);
    html_add_number(page, DIGITS, compared->ratio.high);
    html_add_number(page, DIGITS, compared->base.median);
    html_add_number(page, DIGITS, compared->now.median);
    add_cell(page, name);
    add_cell(page, changes.length > 0 ? changes.bytes : "equal");
    add_cell(page, compared->code);
    add_cell(page, compared->why);
    text_add(page, "</tr>\n");
    page->failed |= changes.failed;
    text_free(&changes);
}

static void add_cases(fm_text *page, const fm_comparison *comparison)
{
    char title[128];
    quantity_title(title, &comparison->quantity);
    text_add(page, "<p>");
    html_add(page, title);
    text_add(
        page,
        ", NEW over BASE, with its 95 %% interval by launches. <b>same</b>: the whole interval "
        "is within %g %% of 1; <b>slower</b>, <b>faster</b>: it lies beside 1, and the ratio "
        "is beyond that. Of a hundred equal cases up to five may come out so: measure again "
        "before you believe one.</p>\n",
        100.0 * comparison->band);
    text_add(page, "<div class=table><table><thead><tr><th>verdict</th><th>ratio</th><th>low</th>"
                   "<th>high</th><th>BASE</th><th>NEW</th><th>case</th><th>status, memory, "
                   "fragments, errors</th><th>other code</th><th>why</th></tr></thead><tbody>\n");
    for (size_t i = 0; i < comparison->count; i++)
        add_row(page, &comparison->cases[i]);
    text_add(page, "</tbody></table></div>\n");
}

static void add_lonely(fm_text *page, const fm_comparison *comparison)
{
    char name[FM_COMPARED_NAME_BYTES];
    if (comparison->only_base + comparison->only_now == 0)
        return;
    text_add(page, "<h2>In one run alone</h2>\n<div class=table><table><thead><tr><th>run</th>"
                   "<th>case</th><th>status</th></tr></thead><tbody>\n");
    for (size_t i = 0; i < comparison->pairs.count; i++) {
        const fm_pair *pair = &comparison->pairs.items[i];
        const fm_case_row *row = pair->base != NULL ? pair->base : pair->now;
        if (pair->base != NULL && pair->now != NULL)
            continue;
        compared_name(name, row);
        text_add(page, "<tr><td>%s</td>", pair->base != NULL ? "BASE" : "NEW");
        add_cell(page, name);
        add_cell(page, row->status);
        text_add(page, "</tr>\n");
    }
    text_add(page, "</tbody></table></div>\n");
}

fm_status comparison_page_write(const char *path, const fm_comparison *comparison, fm_error *err)
{
    fm_text page = { 0 };
    page_open(&page, "fragmark compare", 0);
    add_head(&page, comparison);
    fm_status status = add_chart(&page, comparison, err);
    add_cases(&page, comparison);
    add_lonely(&page, comparison);
    add_machines(&page, &comparison->machines);
    page_end(&page);
    if (status == FM_OK && page.failed)
        status = fm_fail(err, FM_NO_MEMORY, "%s: no memory for the page", path);
    if (status == FM_OK)
        status = text_write_file(path, page.bytes, page.length, err);
    text_free(&page);
    return status;
}
