#include "stability_section.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "html.h"
#include "read/group.h"
#include "stability/matrix.h"

static double number_of(const fm_stability_cell *cell, fm_metric metric)
{
    return cell->row->metric[metric];
}

/* Of all frames, where that is known. */
static double worst_rmse(const fm_stability_cell *cell)
{
    return fmax(number_of(cell, FM_METRIC_RMSE), number_of(cell, FM_METRIC_FRAMES_RMSE_MAX));
}

/* What a cell shows of a wrong case: of an approximation its error; else the share of fragments
 * that are missing, or what else is wrong. */
static void add_size(fm_text *page, const fm_blame *blame, double rmse)
{
    if ((blame->traits & FM_TRAIT_APPROXIMATE) != 0) {
        text_add(page, "~%.1g", rmse);
        return;
    }
    if ((blame->wrong & FM_WRONG_MISSING) != 0)
        text_add(page, blame->missing_share < 0.01 ? "&lt;1" : "%.0f", 100 * blame->missing_share);
    for (unsigned bit = 1; (blame->wrong & FM_WRONG_MISSING) == 0 && wrong_name(bit) != NULL; bit++)
        if ((blame->wrong & 1u << bit) != 0) {
            text_add(page, "%.3s", wrong_name(bit));
            return;
        }
}

static void add_mark(fm_text *page, const fm_stability_cell *cell)
{
    const fm_blame *blame = &cell->blame;
    static const char *const marks[FM_STABILITY_COUNT] = {
        [FM_STABILITY_EXACT] = "=",
        [FM_STABILITY_TOLERATED] = "&asymp;",
        [FM_STABILITY_NOT_SUPPORTED] = "&ndash;",
        [FM_STABILITY_UNKNOWN] = "?",
        [FM_STABILITY_FAILED] = "!",
    };
    if (blame->verdict == FM_STABILITY_WRONG)
        add_size(page, blame, worst_rmse(cell));
    else
        text_add(page, "%s", marks[blame->verdict]);
}

/* "missing 12 of 40, extra 3; RMSE 0.01: loses ties": what a pointer over the cell shows. */
static void add_title(fm_text *page, const fm_stability_cell *cell, const char *scene)
{
    static const fm_metric counts[] = { FM_METRIC_MISSING, FM_METRIC_EXTRA, FM_METRIC_MISORDERED,
                                        FM_METRIC_FRAGMENTS_LOST };
    char words[BLAME_WORDS_BYTES], series[96];
    blame_words(words, &cell->blame, cell->row);
    group_series_title(series, cell->row, NULL);
    html_add(page, series);
    text_add(page, " on ");
    html_add(page, scene);
    text_add(page, ": %s", stability_name(cell->blame.verdict));
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        if (number_of(cell, counts[i]) > 0)
            text_add(page, ", %s %.0f", fm_metrics[counts[i]].name, number_of(cell, counts[i]));
    if (worst_rmse(cell) > 0)
        text_add(page, ", rmse %.2g", worst_rmse(cell));
    if (words[0] != '\0')
        text_add(page, ": ");
    html_add(page, words);
    if (cell->open > 0)
        text_add(page, "; unexplained");
}

static void add_cell(fm_text *page, const fm_stability_cell *cell, const char *scene)
{
    if (cell->row == NULL) {
        text_add(page, "<td></td>");
        return;
    }
    text_add(page, "<td class=\"%s%d\" title=\"", cell->open > 0 ? "open s" : "s",
             (int)cell->blame.verdict);
    add_title(page, cell, scene);
    text_add(page, "\">");
    add_mark(page, cell);
    text_add(page, "</td>");
}

static void add_matrix(fm_text *page, const fm_stability_matrix *matrix)
{
    text_add(page, "<div class=\"table matrix\"><table><thead><tr><th>method</th>");
    for (size_t scene = 0; scene < matrix->scene_count; scene++) {
        text_add(page, "<th class=scene>");
        html_add(page, matrix->scenes[scene]);
        text_add(page, "</th>");
    }
    text_add(page, "</tr></thead><tbody>\n");
    for (size_t method = 0; method < matrix->method_count; method++) {
        text_add(page, "<tr><td class=name>");
        html_add(page, matrix->methods[method]->look.title);
        text_add(page, "</td>");
        for (size_t scene = 0; scene < matrix->scene_count; scene++)
            add_cell(page, matrix_cell(matrix, method, scene), matrix->scenes[scene]);
        text_add(page, "</tr>\n");
    }
    text_add(page, "</tbody></table></div>\n");
}

/* A method's cells of one verdict, all told. */
typedef struct row_sums {
    size_t scenes, open;
    uint32_t traits;
    double missing, extra, misordered, share, rmse; /* of approximations rmse alone */
    fm_text_list why; /* words of those that were not measured; owned */
    const fm_stability_cell *first;
    bool failed; /* no memory */
} row_sums;

static double of_kind(const fm_stability_cell *cell, uint32_t kind, fm_metric metric)
{
    const bool counts = (cell->blame.wrong & kind) != 0 && number_of(cell, metric) > 0;
    return counts ? number_of(cell, metric) : 0;
}

static void sum_cell(row_sums *sums, const fm_stability_cell *cell)
{
    char words[BLAME_WORDS_BYTES];
    sums->scenes++;
    sums->open += cell->open > 0;
    sums->traits |= cell->blame.traits;
    sums->missing += of_kind(cell, FM_WRONG_MISSING, FM_METRIC_MISSING);
    sums->extra += of_kind(cell, FM_WRONG_EXTRA, FM_METRIC_EXTRA);
    sums->misordered += of_kind(cell, FM_WRONG_MISORDERED, FM_METRIC_MISORDERED);
    sums->rmse = fmax(sums->rmse, worst_rmse(cell));
    blame_words(words, &cell->blame, cell->row);
    sums->failed |= !text_list_has(&sums->why, words) && !text_list_add(&sums->why, words);
    if (sums->first == NULL)
        sums->first = cell;
    sums->share = fmax(sums->share, cell->blame.missing_share);
}

static row_sums sum_row(const fm_stability_matrix *matrix, size_t method, fm_stability verdict)
{
    row_sums sums = { 0 };
    for (size_t scene = 0; scene < matrix->scene_count; scene++) {
        const fm_stability_cell *cell = matrix_cell(matrix, method, scene);
        if (cell->row != NULL && cell->blame.verdict == verdict)
            sum_cell(&sums, cell);
    }
    return sums;
}

static void add_wrong_row(fm_text *page, const char *title, const row_sums *sums)
{
    char words[BLAME_WORDS_BYTES];
    const fm_blame all = { .verdict = FM_STABILITY_WRONG,
                           .wrong = sums->first->blame.wrong,
                           .traits = sums->traits };
    blame_words(words, &all, sums->first->row);
    text_add(page, "<tr><td class=name>");
    html_add(page, title);
    text_add(page, "</td>");
    html_add_number(page, 8, (double)sums->scenes);
    html_add_number(page, 12, sums->missing);
    html_add_number(page, 3, 100 * sums->share);
    html_add_number(page, 12, sums->extra);
    html_add_number(page, 12, sums->misordered);
    html_add_number(page, 3, sums->rmse);
    text_add(page, "<td>");
    html_add(page, words);
    if (sums->open > 0)
        text_add(page, "%s<b class=bad>unexplained on %zu</b>", words[0] != '\0' ? ", " : "",
                 sums->open);
    text_add(page, "</td></tr>\n");
}

static void add_wrong(fm_text *page, const fm_stability_matrix *matrix)
{
    bool has_head = false;
    for (size_t method = 0; method < matrix->method_count; method++) {
        row_sums sums = sum_row(matrix, method, FM_STABILITY_WRONG);
        if (sums.scenes == 0)
            continue;
        if (!has_head)
            text_add(page,
                     "<div class=\"table sortable\"><table><thead><tr><th>wrong</th><th>scenes</th>"
                     "<th>missing</th><th title=\"of the wanted fragments of a scene, at most\">%%"
                     "</th><th>extra</th><th>misordered</th><th>largest rmse</th><th>why</th></tr>"
                     "</thead><tbody>\n");
        has_head = true;
        add_wrong_row(page, matrix->methods[method]->look.title, &sums);
        page->failed |= sums.failed;
        text_list_free(&sums.why);
    }
    if (has_head)
        text_add(page, "</tbody></table></div>\n");
}

/* Those that have no errors to show: not supported, or failed. */
static void add_without(fm_text *page, const fm_stability_matrix *matrix, fm_stability verdict)
{
    bool has_head = false;
    for (size_t method = 0; method < matrix->method_count; method++) {
        row_sums sums = sum_row(matrix, method, verdict);
        if (sums.scenes == 0)
            continue;
        if (!has_head)
            text_add(page,
                     "<div class=\"table sortable\"><table><thead><tr><th>%s</th><th>scenes</th>"
                     "<th>why</th><th>the first one's message</th></tr></thead><tbody>\n",
                     stability_name(verdict));
        has_head = true;
        text_add(page, "<tr><td class=name>");
        html_add(page, matrix->methods[method]->look.title);
        text_add(page, "</td>");
        html_add_number(page, 8, (double)sums.scenes);
        text_add(page, "<td>");
        for (size_t i = 0; i < sums.why.count; i++) {
            text_add(page, i > 0 ? ", " : "");
            html_add(page, sums.why.items[i]);
        }
        text_add(page, "</td><td class=message>");
        html_add(page, sums.first->row->message);
        text_add(page, "</td></tr>\n");
        page->failed |= sums.failed;
        text_list_free(&sums.why);
    }
    if (has_head)
        text_add(page, "</tbody></table></div>\n");
}

static void add_one(fm_text *page, const fm_stability_matrix *matrix)
{
    text_add(page, "<h3>");
    html_add(page, matrix->device);
    text_add(page, ": ");
    html_add(page, matrix->device_name);
    text_add(page, ", ");
    html_add(page, matrix->feed);
    text_add(page, "</h3>\n");
    add_matrix(page, matrix);
    add_wrong(page, matrix);
    add_without(page, matrix, FM_STABILITY_NOT_SUPPORTED);
    add_without(page, matrix, FM_STABILITY_FAILED);
}

fm_status stability_section_add(fm_writer *to)
{
    fm_stability_matrices matrices;
    const fm_status status = matrices_make(&matrices, to->results, to->err);
    fm_text *page = &to->page;
    text_add(page, "<h2 id=stability>Stability</h2>\n");
    if (matrices.open > 0)
        text_add(
            page,
            "<p class=note>%zu of %zu cases have errors that no trait of their method explains, "
            "or failed: they are red.</p>\n",
            matrices.open, matrices.cases);
    text_add(
        page,
        "<p class=faint><span class=s1>=</span> exact; <span class=s2>&asymp;</span> off by "
        "no more than rounding; <span class=s5>12</span> wrong as its traits say: %% of the "
        "wanted fragments that are missing, or what else is wrong, of approximations ~rmse; "
        "<span class=s3>&ndash;"
        "</span> not supported; <span class=open>!</span> unexplained, or failed. A cell shows "
        "the worst case of its method and scene; point at it for numbers.</p>\n");
    for (size_t i = 0; i < matrices.count && status == FM_OK; i++)
        add_one(page, &matrices.items[i]);
    to->outcome->unexplained_count = matrices.open;
    matrices_free(&matrices);
    return status;
}
