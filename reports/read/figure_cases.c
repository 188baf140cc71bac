#include "figure_cases.h"

fm_figure_cases figure_cases(const fm_result_files *results, const fm_paper_figure *figure)
{
    return (fm_figure_cases){ figure, results->figures != NULL,
                              result_files_figure(results, figure->id) };
}

/* A list that names none takes all. */
static bool list_takes(const fm_text_list *list, const char *name)
{
    return list->count == 0 || text_list_has(list, name);
}

bool figure_takes_case(const fm_case_row *result, const void *cases)
{
    const fm_figure_cases *wanted = cases;
    if (wanted->is_listed)
        return (result->figures & wanted->bit) != 0;
    return list_takes(&wanted->figure->methods, result->method) &&
           list_takes(&wanted->figure->scenes, result->scene) &&
           list_takes(&wanted->figure->feeds, result->feed);
}
