#include "verdict_table.h"

#include <math.h>
#include <string.h>

#include "html.h"

static bool is_of(const fm_claim_result *item, const char *paper)
{
    return strcmp(item->figure->paper, paper) == 0;
}

/* "12 hold, 3 fail, ...": buttons that choose rows; without scripts they only tell. */
static void add_counts(fm_text *page, const fm_claim_results *verdicts, const char *paper)
{
    text_add(page, "<p class=counts data-table=\"verdicts-%s\">", paper);
    for (int kind = 0; kind < FM_VERDICT_COUNT; kind++) {
        size_t count = 0;
        for (size_t i = 0; i < verdicts->count; i++)
            count += is_of(&verdicts->items[i], paper) &&
                     verdicts->items[i].verdict.kind == (fm_verdict_kind)kind;
        text_add(page,
                 "<button type=button data-verdict=\"%s\" aria-pressed=false><b>%zu</b> %s"
                 "</button>\n",
                 verdict_name((fm_verdict_kind)kind), count, verdict_name((fm_verdict_kind)kind));
    }
    text_add(page, "</p>\n");
}

/* A row for each basis: what was read off a plot, tuned or calibrated is no part of what is stated
 * or predicted. */
static void add_bases(fm_text *page, const fm_claim_results *verdicts, const char *paper)
{
    const fm_verdict_counts counts = verdicts_count(verdicts, paper);
    text_add(page, "<div class=table><table class=bases><thead><tr><th>basis</th>");
    for (int kind = 0; kind < FM_VERDICT_COUNT; kind++)
        text_add(page, "<th>%s</th>", verdict_name((fm_verdict_kind)kind));
    text_add(page, "</tr></thead><tbody>\n");
    for (int basis = 0; basis < FM_BASIS_COUNT; basis++) {
        if (!verdict_counts_has(&counts, (fm_claim_basis)basis))
            continue;
        text_add(page, "<tr><td class=name>%s</td>", claim_basis_name((fm_claim_basis)basis));
        for (int kind = 0; kind < FM_VERDICT_COUNT; kind++)
            text_add(page, "<td class=n>%zu</td>", counts.counts[basis][kind]);
        text_add(page, "</tr>\n");
    }
    text_add(page, "</tbody></table></div>\n");
}

static void add_measured(fm_text *page, const fm_interval *measured)
{
    if (isnan(measured->median))
        return;
    text_add(page, "%.4g", measured->median);
    if (!interval_is_known(measured))
        text_add(page, " <span class=faint>one launch, no interval</span>");
    else if (measured->low != measured->median || measured->high != measured->median)
        text_add(page, " <span class=faint>%.4g to %.4g</span>", measured->low, measured->high);
}

static void add_cell(fm_text *page, const char *label, const char *text)
{
    text_add(page, "<td data-label=\"%s\">", label);
    html_add(page, text);
    text_add(page, "</td>");
}

static void add_row(fm_text *page, const fm_claim_result *item)
{
    char paper[256], words[FM_VERDICT_WORDS_BYTES];
    verdict_words(words, &item->verdict);
    claim_paper_value(paper, item->claim);
    text_add(page, "<tr data-verdict=\"%s\"><td class=name data-label=claim>",
             verdict_name(item->verdict.kind));
    html_add(page, item->claim->id);
    text_add(page, "%s</td>", item->claim->is_required ? " <abbr title=required>*</abbr>" : "");
    text_add(page, "<td data-label=verdict><span class=\"verdict v%d\">%s</span></td>",
             (int)item->verdict.kind, words);
    text_add(page, "<td class=text data-label=text>");
    html_add(page, item->claim->text);
    text_add(page, "<br><span class=faint>");
    html_add(page, item->verdict.reason);
    text_add(page, "</span></td><td data-label=measured>");
    add_measured(page, &item->verdict.measured);
    text_add(page, "</td>");
    add_cell(page, "paper", paper);
    add_cell(page, "basis", claim_basis_name(item->claim->basis));
    text_add(page, "<td data-label=figure><a href=\"#figure-%s\">%s</a></td>", item->figure->id,
             item->figure->id);
    add_cell(page, "device", item->device);
    text_add(page, "</tr>\n");
}

void verdict_table_add(fm_text *page, const fm_claim_results *verdicts, const char *paper)
{
    size_t count = 0;
    for (size_t i = 0; verdicts != NULL && i < verdicts->count; i++)
        count += is_of(&verdicts->items[i], paper);
    if (count == 0)
        return;
    text_add(page, "<p>What the paper says, and what was measured, with 95 %% intervals (<a "
                   "href=\"claims.csv\">claims.csv</a>; * must hold):</p>\n");
    add_counts(page, verdicts, paper);
    add_bases(page, verdicts, paper);
    text_add(page,
             "<div class=\"table cards\"><table class=verdicts "
             "id=\"verdicts-%s\"><thead><tr><th>claim</th>"
             "<th>verdict</th><th>what</th><th>measured</th><th>paper</th><th>basis</th>"
             "<th>figure</th>"
             "<th>device</th></tr></thead><tbody>\n",
             paper);
    for (size_t i = 0; i < verdicts->count; i++)
        if (is_of(&verdicts->items[i], paper))
            add_row(page, &verdicts->items[i]);
    text_add(page, "</tbody></table></div>\n");
}
