#include "figure_kit.h"

void fixture_open(fixture *made, const fakes *rows, const char *figure, const char *figures_csv)
{
    char path[256];
    fm_error err = { 0 };
    kit_make_results(made->directory, rows);
    kit_write_file(made->directory, "f-1.yml", figure);
    if (figures_csv != NULL)
        kit_write_file(made->directory, "figures.csv", figures_csv);
    snprintf(path, sizeof path, "%s/f-1.yml", made->directory);
    if (paper_figure_read(&made->figure, path, &err) != FM_OK ||
        result_files_read(&made->results, made->directory, &err) != FM_OK)
        fail_msg("%s", err.message);
}

void fixture_close(fixture *made)
{
    paper_figure_close(made->figure);
    result_files_close(made->results);
    kit_remove_directory(made->directory);
}

void fixture_groups(fm_groups *groups, const fixture *in, const fm_figure_chart *chart)
{
    const fm_figure_cases cases = figure_cases(in->results, in->figure);
    const fm_groups_desc desc = { .filter = figure_takes_case,
                                  .context = &cases,
                                  .free_columns = &chart->free_columns };
    assert_int_equal(groups_make(groups, in->results, &desc, NULL), FM_OK);
}

void drawing_open(drawing *made, const fakes *rows, const char *figure, const char *figures_csv,
                  size_t chart)
{
    fm_error err = { 0 };
    fixture_open(&made->with, rows, figure, figures_csv);
    const fm_figure_chart *from = &made->with.figure->charts[chart];
    fixture_groups(&made->groups, &made->with, from);
    const fm_figure_source own = { made->with.results, &made->groups.groups[0] };
    const fm_figure_source none = { NULL, NULL };
    if (figure_chart_make(&made->chart, made->with.figure, from, &own, &none, &err) != FM_OK)
        fail_msg("%s", err.message);
}

void drawing_close(drawing *made)
{
    chart_free(&made->chart);
    groups_free(&made->groups);
    fixture_close(&made->with);
}
