/* Claims of the project's figure files: each of the papers' is there, and none selects by a name
 * that no result has, which would match every row or none. */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/table.h"
#include "claims_kit.h"
#include "read/paper_figure.h"

enum { FIGURES_MAX = 64, FAMILIES = 4, CLAIMS_MAX = 26 };

static const struct {
    const char *prefix;
    int count;
} families[FAMILIES] = { { "KP-", 26 }, { "SB-", 17 }, { "OM-", 14 }, { "E", 14 } };

typedef struct figure_file {
    fm_paper_figure *figure;
    char *text; /* what stands before its claims: cases, charts, points */
} figure_file;

typedef struct project {
    figure_file files[FIGURES_MAX];
    size_t count;
    fm_table *summary, *memory; /* of the reference: for their columns */
} project;

static char *read_text(const char *path)
{
    FILE *file = fopen(path, "rb");
    char *text = calloc(1, 1 << 20);
    assert_non_null(file);
    assert_non_null(text);
    assert_in_range(fread(text, 1, (1 << 20) - 1, file), 1, (1 << 20) - 2);
    fclose(file);
    return text;
}

static void open_file(project *of, const char *name)
{
    char path[1024];
    fm_error err = { .message = "" };
    figure_file *file = &of->files[of->count++];
    assert_true(of->count < FIGURES_MAX);
    snprintf(path, sizeof path, FM_FIGURES_SOURCE_DIR "/%s", name);
    if (paper_figure_read(&file->figure, path, &err) != FM_OK)
        fail_msg("%s", err.message);
    file->text = read_text(path);
    char *claims = strstr(file->text, "\nclaims:");
    if (claims != NULL)
        *claims = '\0';
}

static int open_project(void **state)
{
    project *of = calloc(1, sizeof *of);
    DIR *folder = opendir(FM_FIGURES_SOURCE_DIR);
    const struct dirent *entry;
    fm_error err;
    if (of == NULL || folder == NULL)
        return -1;
    while ((entry = readdir(folder)) != NULL)
        if (entry->d_name[0] != '.')
            open_file(of, entry->d_name);
    closedir(folder);
    *state = of;
    return table_read(&of->summary, FM_FIGURES_SOURCE_DIR "/../reference/h100/summary.csv", &err) !=
               FM_OK ||
           table_read(&of->memory, FM_FIGURES_SOURCE_DIR "/../reference/h100/memory.csv", &err) !=
               FM_OK;
}

static int close_project(void **state)
{
    project *of = *state;
    for (size_t i = 0; i < of->count; i++) {
        paper_figure_close(of->files[i].figure);
        free(of->files[i].text);
    }
    table_close(of->summary);
    table_close(of->memory);
    free(of);
    return 0;
}

/* "KP-8", "KP-8b": the number of the paper's claim; 0: of another family. */
static int number_of(const char *id, const char *prefix)
{
    char *end;
    const size_t length = strlen(prefix);
    if (strncmp(id, prefix, length) != 0)
        return 0;
    const long number = strtol(id + length, &end, 10);
    return end > id + length && number > 0 && number <= CLAIMS_MAX ? (int)number : 0;
}

static void each_claim_of_the_papers_is_in_a_figure(void **state)
{
    const project *of = *state;
    for (int f = 0; f < FAMILIES; f++) {
        bool found[CLAIMS_MAX + 1] = { false };
        for (size_t i = 0; i < of->count; i++)
            for (size_t c = 0; c < of->files[i].figure->claim_count; c++)
                found[number_of(of->files[i].figure->claims[c].id, families[f].prefix)] = true;
        for (int number = 1; number <= families[f].count; number++)
            if (!found[number])
                fail_msg("no figure has a claim %s%d", families[f].prefix, number);
    }
}

/* As a key of a case, "culling: occupancy", or in a method's options, "culling=occupancy". */
static bool is_axis(const char *text, const char *key)
{
    const size_t length = strlen(key);
    for (const char *at = strstr(text, key); at != NULL; at = strstr(at + 1, key)) {
        const char before = at == text ? ' ' : at[-1];
        if (strchr(" {\n\"", before) != NULL && (at[length] == ':' || at[length] == '='))
            return true;
    }
    return false;
}

static void expect_names(const project *of, const figure_file *file, const fm_claim *claim,
                         const fm_claim_selection *selection)
{
    for (size_t i = 0; i < selection->test_count; i++) {
        const char *key = selection->tests[i].key;
        if (table_column(of->summary, key) == FM_TABLE_NO_COLUMN &&
            table_column(of->memory, key) == FM_TABLE_NO_COLUMN && !is_axis(file->text, key))
            fail_msg("%s, claim %s: '%s' is no column, and no case of the figure sets it",
                     file->figure->id, claim->id, key);
    }
}

static void claims_select_by_what_results_have(void **state)
{
    const project *of = *state;
    size_t count = 0;
    for (size_t i = 0; i < of->count; i++)
        for (size_t c = 0; c < of->files[i].figure->claim_count; c++) {
            const fm_claim *claim = &of->files[i].figure->claims[c];
            for (size_t s = 0; s < claim->of_count; s++, count++)
                expect_names(of, &of->files[i], claim, &claim->of[s]);
            if (claim->has_minus)
                expect_names(of, &of->files[i], claim, &claim->minus);
            if (claim->has_over)
                expect_names(of, &of->files[i], claim, &claim->over);
            if (claim->has_over_minus)
                expect_names(of, &of->files[i], claim, &claim->over_minus);
        }
    assert_true(count > 100);
}

static void a_mistyped_name_is_no_axis(void **state)
{
    (void)state;
    assert_true(is_axis("run:\n  - { culling: [occupancy] }\n", "culling"));
    assert_true(is_axis("run:\n  - { methods: [a culling=occupancy] }\n", "culling"));
    assert_false(is_axis("run:\n  - { culling: [occupancy] }\n", "culing"));
    assert_false(is_axis("run:\n  - { own_culling: [on] }\n", "culling"));
}

/* "within 10 points" has two sides. A spread has one: the greatest over the least is never below 1.
 */
static void within_has_two_sides(void **state)
{
    const project *of = *state;
    for (size_t i = 0; i < of->count; i++)
        for (size_t c = 0; c < of->files[i].figure->claim_count; c++) {
            const fm_claim *claim = &of->files[i].figure->claims[c];
            if (strstr(claim->text, "within") != NULL && claim->form != FM_CLAIM_SPREAD &&
                (isinf(claim->low) || isinf(claim->high)))
                fail_msg("claim %s: \"%s\", and one bound", claim->id, claim->text);
        }
}

/* A scene that --smoke puts in the place of another is none of the figure's own: what holds on it
 * would seem to hold on the paper's. */
static void smoke_scenes_are_not_the_figures(void **state)
{
    const project *of = *state;
    for (size_t i = 0; i < of->count; i++) {
        const fm_paper_figure *figure = of->files[i].figure;
        const fm_yaml *scenes =
            figure->file.smoke != NULL ? yaml_tree_find(figure->file.smoke, "scenes") : NULL;
        for (size_t s = 0; scenes != NULL && figure->claim_count > 0 && s < scenes->count; s++)
            if (text_list_has(&figure->own_scenes, scenes->items[s].text))
                fail_msg("%s: smoke has scene %s, and so has run", figure->id,
                         scenes->items[s].text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_claim_of_the_papers_is_in_a_figure),
        cmocka_unit_test(claims_select_by_what_results_have),
        cmocka_unit_test(a_mistyped_name_is_no_axis),
        cmocka_unit_test(within_has_two_sides),
        cmocka_unit_test(smoke_scenes_are_not_the_figures),
    };
    return cmocka_run_group_tests(tests, open_project, close_project);
}
