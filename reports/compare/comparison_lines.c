#include <math.h>

#include "comparison.h"

static void add_machines(fm_text *text, const fm_comparison *comparison)
{
    const fm_machines *machines = &comparison->machines;
    for (size_t i = 0; i < machines->count; i++) {
        const fm_machine_fact *fact = &machines->differing[i];
        text_add(text, "differs: %s: %s -> %s\n", fact->name,
                 fact->base[0] != '\0' ? fact->base : "(not told)",
                 fact->now[0] != '\0' ? fact->now : "(not told)");
    }
    if (comparison->quantity.is_chosen)
        text_add(text, "%s: times are compared over the floor's of the same launch\n",
                 !machines->is_same_machine ? "two machines, or machines that are not known"
                                            : "two days");
}

static void add_case(fm_text *text, const fm_compared *compared)
{
    char name[FM_COMPARED_NAME_BYTES];
    compared_name(name, compared->pair.base);
    text_add(text, "%-8s", compared_verdict_name(compared->verdict));
    if (isnan(compared->ratio.median))
        text_add(text, "%6s  %-15s %9s %9s", "", "", "", "");
    else if (!interval_is_known(&compared->ratio))
        text_add(text, "%6.3f  %-15s %9.4g %9.4g", compared->ratio.median, "",
                 compared->base.median, compared->now.median);
    else
        text_add(text, "%6.3f  %6.3f - %6.3f %9.4g %9.4g", compared->ratio.median,
                 compared->ratio.low, compared->ratio.high, compared->base.median,
                 compared->now.median);
    text_add(text, "  %s", name);
    if (compared->why[0] != '\0')
        text_add(text, "; %s", compared->why);
    if (compared->code[0] != '\0')
        text_add(text, "; other code: %s", compared->code);
    if (compared->changes.count > 0)
        text_add(text, "; ");
    compared_add_changes(text, compared);
    text_add(text, "\n");
}

static void add_lonely(fm_text *text, const fm_comparison *comparison)
{
    char name[FM_COMPARED_NAME_BYTES];
    for (size_t i = 0; i < comparison->pairs.count; i++) {
        const fm_pair *pair = &comparison->pairs.items[i];
        if (pair->base != NULL && pair->now != NULL)
            continue;
        compared_name(name, pair->base != NULL ? pair->base : pair->now);
        text_add(text, "only in %s  %s\n", pair->base != NULL ? "BASE" : "NEW", name);
    }
}

void comparison_add_summary(fm_text *text, const fm_comparison *comparison)
{
    const size_t changed = comparison_changed(comparison);
    text_add(text, "%zu case%s:", comparison->count, comparison->count == 1 ? "" : "s");
    for (int i = 0; i < FM_COMPARED_COUNT; i++)
        text_add(text, "%s %zu %s", i > 0 ? "," : "",
                 comparison_verdicts(comparison, (fm_compared_verdict)i),
                 compared_verdict_name((fm_compared_verdict)i));
    text_add(text,
             "; status, memory, fragments and errors: %zu equal, %zu changed; %zu only in BASE, "
             "%zu only in NEW",
             comparison->count - changed, changed, comparison->only_base, comparison->only_now);
}

void comparison_add_lines(fm_text *text, const fm_comparison *comparison)
{
    char title[128];
    quantity_title(title, &comparison->quantity);
    add_machines(text, comparison);
    text_add(text, "%s, NEW over BASE, with 95 %% intervals; up to %g %% counts as same\n\n", title,
             100.0 * comparison->band);
    text_add(text, "%-8s%6s  %-15s %9s %9s  case\n", "verdict", "ratio", "interval", "BASE", "NEW");
    for (size_t i = 0; i < comparison->count; i++)
        add_case(text, &comparison->cases[i]);
    add_lonely(text, comparison);
    text_add(text, "\n");
    comparison_add_summary(text, comparison);
    text_add(text, "\n");
}
