#include "list_metrics.h"

#include "model/columns.h"
#include "simulator/counters.h"

static const char *const of_words[] = {
    [FM_OF_FRAME] = "frame",     [FM_OF_LAUNCH] = "launch", [FM_OF_CASE] = "case",
    [FM_OF_SUMMARY] = "summary", [FM_OF_REPORT] = "report",
};
static const char *const better_words[] = {
    [FM_BETTER_NEITHER] = "",
    [FM_BETTER_LESS] = "less",
    [FM_BETTER_MORE] = "more",
};

enum { ROW_COUNT = FM_METRIC_COUNT + FM_METRIC_FAMILY_COUNT };

static const fm_metric_info *row(size_t i)
{
    return i < FM_METRIC_COUNT ? &fm_metrics[i] : &fm_metric_families[i - FM_METRIC_COUNT].info;
}

void list_metrics_text(FILE *out)
{
    for (size_t i = 0; i < ROW_COUNT; i++)
        fprintf(out, "%-32s %-9s %s\n", row(i)->name, row(i)->unit, row(i)->definition);
    for (size_t i = 0; i < TBR_COUNTER_COUNT; i++)
        fprintf(out, "%-32s %-9s counter of the simulated GPU, all frames but the first\n",
                tbr_counter_infos[i].name, tbr_counter_infos[i].unit);
}

/* In which of the files it stands. */
static const char *files(const fm_metric_info *info)
{
    const bool has_column = summary_has_column(info->name);
    if (info->of == FM_OF_REPORT)
        return "none";
    if (info->of == FM_OF_LAUNCH)
        return has_column ? "samples, without frame; largest in summary" : "samples, without frame";
    if (info->of == FM_OF_FRAME)
        return has_column ? "samples, median in summary" : "samples";
    return has_column || info->of == FM_OF_SUMMARY ? "summary"
                                                   : "samples, without launch and frame";
}

void list_metrics_markdown(FILE *out)
{
    fputs("| metric | unit | of a | better | in | what it is |\n|---|---|---|---|---|---|\n", out);
    for (size_t i = 0; i < ROW_COUNT; i++) {
        const fm_metric_info *info = row(i);
        fprintf(out, "| `%s` | %s | %s | %s | %s | %s%s |\n", info->name, info->unit,
                info->of == FM_OF_FRAME    ? "frame"
                : info->of == FM_OF_LAUNCH ? "launch"
                                           : "case",
                better_words[info->better], files(info), info->definition,
                info->is_measured ? "" : " (deterministic)");
    }
}

json_t *list_metrics_json(void)
{
    json_t *rows = json_array();
    for (size_t i = 0; i < ROW_COUNT; i++) {
        const fm_metric_info *info = row(i);
        json_array_append_new(
            rows,
            json_pack("{s:s, s:s, s:s, s:s, s:s, s:b, s:b, s:s}", "name", info->name, "title",
                      info->title, "unit", info->unit, "of", of_words[info->of], "better",
                      better_words[info->better], "is_measured", (int)info->is_measured, "column",
                      (int)summary_has_column(info->name), "definition", info->definition));
    }
    return rows;
}
