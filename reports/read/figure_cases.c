#include "figure_cases.h"

fm_figure_cases figure_cases(const fm_result_files *results, const fm_paper_figure *figure)
{
    return (fm_figure_cases){ figure, results->figures != NULL,
                              result_files_figure(results, figure->id) };
}

bool figure_takes_case(const fm_case_row *result, const void *cases)
{
    const fm_figure_cases *wanted = cases;
    if (wanted->is_listed)
        return (result->figures & wanted->bit) != 0;
    return name_list_has(&wanted->figure->methods, result->method) &&
           name_list_has(&wanted->figure->scenes, result->scene) &&
           name_list_has(&wanted->figure->feeds, result->feed);
}
