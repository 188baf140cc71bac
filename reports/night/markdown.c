#include <math.h>
#include <string.h>

#include "compare/comparison.h"
#include "night.h"

enum { FINDINGS = 50, STEPS = 10 };

/* A cell of a table: one line, without what ends it. */
static void add_cell(fm_text *text, const char *cell)
{
    for (const char *at = cell; *at != '\0'; at++)
        if (*at == '|')
            text_add(text, "\\|");
        else
            text_add(text, "%c", *at == '\n' || *at == '\r' ? ' ' : *at);
}

static void add_findings(fm_text *text, const fm_night_result *night)
{
    if (night->count == 0)
        return;
    text_add(text, "| what | case | |\n|---|---|---|\n");
    for (size_t i = 0; i < night->count && i < FINDINGS; i++) {
        char name[FM_COMPARED_NAME_BYTES];
        const fm_finding *finding = &night->findings[i];
        compared_name(name, &night->desc->now->cases[finding->case_index]);
        text_add(text, "| %s%s | ", finding_kind_name(finding->kind), finding_standing(finding));
        add_cell(text, name);
        text_add(text, " | ");
        add_cell(text, finding->text);
        text_add(text, " |\n");
    }
    if (night->count > FINDINGS)
        text_add(text, "\n%zu more are in night.json.\n", night->count - FINDINGS);
    text_add(text, "\n");
}

/* Whoever acts on a time should know whether it was measured again. */
static void add_unconfirmed(fm_text *text, const fm_night_result *night)
{
    const char *why = night->desc->unconfirmed;
    for (size_t i = 0; i < night->count; i++) {
        const fm_finding *finding = &night->findings[i];
        if (finding->kind != FM_FINDING_SLOWER || finding->is_confirmed || finding->is_dismissed)
            continue;
        text_add(text, "%s\n\n", why != NULL ? why : "Findings on time are unconfirmed.");
        return;
    }
}

static void add_counts(fm_text *text, const fm_night_result *night)
{
    size_t of[FM_CASE_STATUS_COUNT] = { 0 }, noisy = 0;
    const fm_result_files *now = night->desc->now;
    for (size_t i = 0; i < now->count; i++) {
        of[now->cases[i].outcome]++;
        noisy += now->cases[i].noisy[0] != '\0';
    }
    text_add(text, "%zu case%s:", now->count, now->count == 1 ? "" : "s");
    bool is_first = true;
    for (int i = 0; i < FM_CASE_STATUS_COUNT; i++)
        if (of[i] > 0) {
            text_add(text, "%s %zu %s", is_first ? "" : ",", of[i],
                     case_status_name((fm_case_status)i));
            is_first = false;
        }
    text_add(text, "; %zu measured on a busy machine.\n\n", noisy);
}

static void add_newer(fm_text *text, const fm_newer_runs *newer)
{
    if (newer->count > 0)
        text_add(
            text,
            "The history has %zu later run%s of these cases, the last of %s. This page is about "
            "the run above, and about those before it.\n\n",
            newer->count, newer->count == 1 ? "" : "s", newer->last);
}

static void add_certainty(fm_text *text, const fm_night_result *night)
{
    const double effect = night->desc->effect > 0 ? night->desc->effect : 1.06;
    if (night->early > 0)
        text_add(text, "%zu case%s too few nights for an alarm on time so far.\n\n", night->early,
                 night->early == 1 ? " has" : "s have");
    if (isnan(night->noisiest))
        return;
    text_add(text,
             "The noisiest case is known to %.1f %%. To find a step of %.0f %% in its first three "
             "nights takes %zu launches a night.\n\n",
             100.0 * night->noisiest, 100.0 * (effect - 1.0), night->launches_needed);
}

/* Series are in the order of their steps: the newest first. */
static void add_steps(fm_text *text, const fm_night_result *night)
{
    size_t told = 0;
    for (size_t i = 0; i < night->series.count && told < STEPS; i++) {
        const fm_series *series = &night->series.items[i];
        const fm_step *step = series_last_step(series);
        if (step == NULL)
            break;
        if (told++ == 0)
            text_add(text, "## Last steps\n\n| from | by | case | machine |\n|---|---|---|---|\n");
        text_add(text, "| %s | %+.1f %% | ", series->nights[step->index].started,
                 100.0 * (exp(step->shift) - 1.0));
        add_cell(text, series->title);
        text_add(text, " | %s |\n", series->machine);
    }
    if (told > 0)
        text_add(text, "\n");
}

void night_add_markdown(fm_text *text, const fm_night_result *night)
{
    const fm_provenance *manifest = night->desc->now->manifest;
    const fm_text_list *notes = night->desc->notes;
    text_add(text, "# fragmark nightly: %s\n\n",
             night->alarms > 0         ? "ALARM"
             : night->new_failures > 0 ? "cases failed"
                                       : "quiet");
    text_add(text, "%s, commit %.12s, reference %s%s%s.\n\n", provenance_fact(manifest, "started"),
             provenance_fact(manifest, "git_commit"),
             night->desc->reference != NULL ? night->desc->reference : "floor",
             night->desc->baseline != NULL ? ", baseline " : "",
             night->desc->baseline_name != NULL ? night->desc->baseline_name : "");
    add_findings(text, night);
    add_unconfirmed(text, night);
    add_counts(text, night);
    for (size_t i = 0; notes != NULL && i < notes->count; i++)
        text_add(text, "%s\n\n", notes->items[i]);
    add_newer(text, &night->newer);
    add_certainty(text, night);
    add_steps(text, night);
    text_add(text, "Files: `history.html`, `junit.xml`, `night.json`, `run/summary.csv`.\n");
}
