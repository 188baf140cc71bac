#include "claim.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "model/metrics.h"

#define WORDS(list) (list), sizeof(list) / sizeof((list)[0])

static const char *const claim_keys[] = {
    "id",     "text",      "source",     "where",   "why",   "required", "paper",
    "plot",   "form",      "of",         "minus",   "over",  "along",    "across",
    "level",  "between",   "goes",       "extreme", "scale", "at_least", "at_most",
    "equals", "tolerance", "over_minus", "basis",
};
static const char *const forms[FM_CLAIM_FORM_COUNT] = {
    [FM_CLAIM_BOUND] = "bound",       [FM_CLAIM_ANY] = "any",
    [FM_CLAIM_MEAN] = "mean",         [FM_CLAIM_ORDER] = "order",
    [FM_CLAIM_MONOTONE] = "monotone", [FM_CLAIM_CROSSING] = "crossing",
    [FM_CLAIM_PEAK] = "peak",         [FM_CLAIM_SLOPE] = "slope",
    [FM_CLAIM_SPREAD] = "spread",     [FM_CLAIM_IMAGES] = "images",
};

static const char *const bases[FM_BASIS_COUNT] = {
    [FM_BASIS_STATED] = "stated", [FM_BASIS_PLOT] = "plot",
    [FM_BASIS_OURS] = "ours",     [FM_BASIS_PREDICTED] = "predicted",
    [FM_BASIS_TUNED] = "tuned",   [FM_BASIS_CALIBRATED] = "calibrated",
};

const char *claim_basis_name(fm_claim_basis basis)
{
    return bases[basis];
}

/* What a form cannot do without. */
static const struct {
    bool along, between, bounds, over;
} needs[FM_CLAIM_FORM_COUNT] = {
    [FM_CLAIM_BOUND] = { .bounds = true },
    [FM_CLAIM_ANY] = { .bounds = true },
    [FM_CLAIM_MEAN] = { .bounds = true },
    [FM_CLAIM_MONOTONE] = { .along = true },
    [FM_CLAIM_CROSSING] = { .along = true, .between = true },
    [FM_CLAIM_PEAK] = { .along = true, .between = true },
    [FM_CLAIM_SLOPE] = { .along = true, .bounds = true },
    [FM_CLAIM_SPREAD] = { .bounds = true },
    [FM_CLAIM_IMAGES] = { .bounds = true, .over = true },
};

static const char *const formula_keys[FM_FORMULA_TERMS] = { "constant", "per_pixel", "per_pixel_k",
                                                            "per_pixel_n", "per_fragment" };

static fm_status read_formula(fm_claim_selection *selection, const fm_yaml *map,
                              const fm_yaml_place *at)
{
    fm_status status = field_check_keys(map, "formula", WORDS(formula_keys), at);
    selection->is_formula = true;
    for (int i = 0; i < FM_FORMULA_TERMS && status == FM_OK; i++)
        status = field_number(&selection->formula[i], map, formula_keys[i], at);
    return status;
}

static bool is_reserved(const char *key)
{
    static const char *const reserved[] = { "metric", "take", "formula", "table" };
    for (size_t i = 0; i < sizeof reserved / sizeof reserved[0]; i++)
        if (strcmp(key, reserved[i]) == 0)
            return true;
    return false;
}

/* A test replaces the one that was taken over for the same key. */
static fm_status add_test(fm_claim_selection *selection, const fm_yaml *value,
                          const fm_yaml_place *at)
{
    size_t i = 0;
    while (i < selection->test_count && strcmp(selection->tests[i].key, value->key) != 0)
        i++;
    if (i == FM_CLAIM_TESTS)
        return fm_fail(at->err, FM_INVALID, "%s:%u: more than %d tests in a selection", at->path,
                       value->line, FM_CLAIM_TESTS);
    if (value->kind == FM_YAML_MAP)
        return fm_fail(at->err, FM_INVALID, "%s:%u: %s: a value or a list is expected", at->path,
                       value->line, value->key);
    for (size_t j = 0; j < value->count; j++)
        if (value->items[j].kind != FM_YAML_SCALAR)
            return fm_fail(at->err, FM_INVALID, "%s:%u: %s: a list of values is expected", at->path,
                           value->line, value->key);
    if (!text_list_add(&selection->own_columns, value->key))
        return fm_fail(at->err, FM_NO_MEMORY, "%s:%u: %s", at->path, value->line, value->key);
    selection->tests[i] = (fm_claim_test){ .key = value->key, .value = value };
    selection->test_count += i == selection->test_count;
    return FM_OK;
}

static fm_status read_metrics(fm_claim_selection *selection, const fm_claim_selection *from,
                              const fm_yaml *map, const fm_yaml_place *at)
{
    const fm_status status = field_list(&selection->metrics, map, "metric", at);
    if (status != FM_OK || selection->metrics.count > 0)
        return status;
    if (from != NULL ? text_list_add_all(&selection->metrics, &from->metrics)
                     : text_list_add(&selection->metrics, fm_metrics[FM_METRIC_FRAME_MS].name))
        return FM_OK;
    return fm_fail(at->err, FM_NO_MEMORY, "%s:%u: metric", at->path, map->line);
}

/* `from`: what is taken over; NULL for `of`. */
static fm_status read_selection(fm_claim_selection *selection, const fm_claim_selection *from,
                                const fm_yaml *map, const fm_yaml_place *at)
{
    static const char *const takes[] = { "each", "least", "greatest" };
    static const char *const tables[] = { "summary", "memory" };
    int take = 0, table = 0;
    *selection = from != NULL ? *from : (fm_claim_selection){ 0 };
    selection->own_columns = selection->metrics = (fm_text_list){ 0 }; /* not to be owned twice */
    if (map->kind != FM_YAML_MAP)
        return fm_fail(at->err, FM_INVALID, "%s:%u: a selection has keys and values", at->path,
                       map->line);
    fm_status status = read_metrics(selection, from, map, at);
    if (status == FM_OK)
        status = field_word(&take, map, "take", WORDS(takes), at);
    if (status == FM_OK && yaml_tree_find(map, "table") != NULL) {
        status = field_word(&table, map, "table", WORDS(tables), at);
        selection->table = (fm_claim_table)table;
    }
    if (status == FM_OK && yaml_tree_find(map, "formula") != NULL)
        status = read_formula(selection, yaml_tree_find(map, "formula"), at);
    for (size_t i = 0; i < map->count && status == FM_OK; i++)
        if (!is_reserved(map->items[i].key))
            status = add_test(selection, &map->items[i], at);
    selection->take = (fm_claim_take)take;
    return status;
}

static fm_status read_of(fm_claim *claim, const fm_yaml *map, const fm_yaml_place *at)
{
    const fm_yaml *value = yaml_tree_find(map, "of");
    const bool wants_list = claim->form == FM_CLAIM_ORDER;
    fm_status status = FM_OK;
    if (value == NULL || (value->kind == FM_YAML_LIST) != wants_list ||
        (wants_list && (value->count < 2 || value->count > FM_CLAIM_SELECTIONS)))
        return fm_fail(at->err, FM_INVALID, "%s:%u: %s: of: %s is expected", at->path,
                       value == NULL ? map->line : value->line, claim->id,
                       wants_list ? "a list of 2 to 12 selections" : "a selection");
    if (!wants_list) {
        claim->of_count = 1;
        return read_selection(&claim->of[0], NULL, value, at);
    }
    for (size_t i = 0; i < value->count && status == FM_OK; i++)
        status = read_selection(&claim->of[claim->of_count++], i > 0 ? &claim->of[0] : NULL,
                                &value->items[i], at);
    return status;
}

static fm_status read_operand(fm_claim_selection *selection, bool *has, const fm_claim *claim,
                              const fm_yaml *map, const char *key, const fm_yaml_place *at)
{
    const fm_yaml *operand = yaml_tree_find(map, key);
    *has = operand != NULL;
    return operand == NULL ? FM_OK : read_selection(selection, &claim->of[0], operand, at);
}

static fm_status read_bounds(fm_claim *claim, const fm_yaml *map, const fm_yaml_place *at)
{
    double equals = NAN;
    claim->low = -INFINITY;
    claim->high = INFINITY;
    fm_status status = field_number(&claim->low, map, "at_least", at);
    if (status == FM_OK)
        status = field_number(&claim->high, map, "at_most", at);
    if (status == FM_OK)
        status = field_number(&equals, map, "equals", at);
    if (status == FM_OK)
        status = field_number(&claim->tolerance, map, "tolerance", at);
    if (!isnan(equals))
        claim->low = claim->high = equals;
    if (status == FM_OK && needs[claim->form].bounds && isinf(claim->low) && isinf(claim->high))
        return fm_fail(at->err, FM_INVALID, "%s:%u: %s: at_least, at_most or equals is missing",
                       at->path, map->line, claim->id);
    if (status == FM_OK && (claim->low > claim->high || claim->tolerance < 0.0))
        return fm_fail(at->err, FM_INVALID, "%s:%u: %s: bounds that nothing can be within",
                       at->path, map->line, claim->id);
    return status;
}

static fm_status read_between(fm_claim *claim, const fm_yaml *map, const fm_yaml_place *at)
{
    const fm_yaml *between = yaml_tree_find(map, "between");
    if (between == NULL && !needs[claim->form].between)
        return FM_OK;
    if (between == NULL || between->kind != FM_YAML_LIST || between->count != 2 ||
        between->items[0].text == NULL || between->items[1].text == NULL ||
        !text_to_double(&claim->between[0], between->items[0].text) ||
        !text_to_double(&claim->between[1], between->items[1].text) ||
        claim->between[0] > claim->between[1])
        return fm_fail(at->err, FM_INVALID, "%s:%u: %s: between: [LOW, HIGH] is expected", at->path,
                       between == NULL ? map->line : between->line, claim->id);
    return FM_OK;
}

static fm_status read_head(fm_claim *claim, const fm_yaml *map, const fm_yaml_place *at)
{
    static const char *const places[] = { "any", "gpu", "hazards", "software" };
    int where = 0, form = 0, basis = 0;
    fm_status status = field_check_keys(map, "a claim", WORDS(claim_keys), at);
    if (status == FM_OK)
        status = field_text(&claim->id, map, "id", true, at);
    if (status == FM_OK)
        status = field_text(&claim->text, map, "text", true, at);
    if (status == FM_OK)
        status = field_text(&claim->source, map, "source", false, at);
    if (status == FM_OK)
        status = field_text(&claim->why, map, "why", false, at);
    if (status == FM_OK)
        status = field_text(&claim->paper, map, "paper", false, at);
    if (status == FM_OK)
        status = field_text(&claim->plot, map, "plot", false, at);
    if (status == FM_OK)
        status = field_bool(&claim->is_required, map, "required", at);
    if (status == FM_OK)
        status = field_word(&where, map, "where", WORDS(places), at);
    if (status == FM_OK)
        status = field_word(&form, map, "form", WORDS(forms), at);
    if (status == FM_OK)
        status = field_word(&basis, map, "basis", WORDS(bases), at);
    claim->where = (fm_claim_where)where;
    claim->form = (fm_claim_form)form;
    claim->basis = (fm_claim_basis)basis;
    return status;
}

static fm_status read_shape(fm_claim *claim, const fm_yaml *map, const fm_yaml_place *at)
{
    static const char *const directions[] = { "falls", "rises" };
    static const char *const extremes[] = { "least", "greatest" };
    static const char *const scales[] = { "log", "linear" };
    int goes = 0, extreme = 0, scale = 0;
    fm_status status = field_text(&claim->along, map, "along", needs[claim->form].along, at);
    claim->level = 1.0;
    if (status == FM_OK)
        status = field_list(&claim->free_columns, map, "across", at);
    if (status == FM_OK && claim->along[0] != '\0' &&
        !text_list_add(&claim->free_columns, claim->along))
        status = fm_fail(at->err, FM_NO_MEMORY, "%s: claim %s", at->path, claim->id);
    if (status == FM_OK)
        status = field_number(&claim->level, map, "level", at);
    if (status == FM_OK)
        status = field_word(&goes, map, "goes", WORDS(directions), at);
    if (status == FM_OK)
        status = field_word(&extreme, map, "extreme", WORDS(extremes), at);
    if (status == FM_OK)
        status = field_word(&scale, map, "scale", WORDS(scales), at);
    claim->rises = goes == 1;
    claim->wants_greatest = extreme == 1;
    claim->is_linear = scale == 1;
    return status == FM_OK ? read_between(claim, map, at) : status;
}

static fm_status read_claim(fm_claim *claim, const fm_yaml *map, const fm_yaml_place *at)
{
    fm_status status = read_head(claim, map, at);
    if (status == FM_OK)
        status = read_of(claim, map, at);
    if (status == FM_OK)
        status = read_operand(&claim->minus, &claim->has_minus, claim, map, "minus", at);
    if (status == FM_OK)
        status = read_operand(&claim->over, &claim->has_over, claim, map, "over", at);
    if (status == FM_OK)
        status =
            read_operand(&claim->over_minus, &claim->has_over_minus, claim, map, "over_minus", at);
    if (status == FM_OK && claim->has_over_minus && !claim->has_over)
        status = fm_fail(at->err, FM_INVALID, "%s:%u: %s: over_minus needs over", at->path,
                         map->line, claim->id);
    if (status == FM_OK)
        status = read_bounds(claim, map, at);
    if (status == FM_OK)
        status = read_shape(claim, map, at);
    if (status == FM_OK && needs[claim->form].over && !claim->has_over)
        return fm_fail(at->err, FM_INVALID, "%s:%u: %s: over is missing", at->path, map->line,
                       claim->id);
    return status;
}

fm_status claims_read(fm_claim **claims, size_t *count, const fm_yaml *list,
                      const fm_yaml_place *at)
{
    *claims = NULL;
    *count = 0;
    if (list == NULL)
        return FM_OK;
    if (list->kind != FM_YAML_LIST || list->count > FM_CLAIMS)
        return fm_fail(at->err, FM_INVALID, "%s:%u: claims: a list of at most %d is expected",
                       at->path, list->line, FM_CLAIMS);
    fm_claim *made = calloc(list->count + 1, sizeof *made);
    if (made == NULL)
        return fm_fail(at->err, FM_NO_MEMORY, "%s: %zu claims", at->path, list->count);
    fm_status status = FM_OK;
    for (size_t i = 0; i < list->count && status == FM_OK; i++) {
        status = read_claim(&made[i], &list->items[i], at);
        for (size_t j = 0; j < i && status == FM_OK; j++)
            if (strcmp(made[i].id, made[j].id) == 0)
                status = fm_fail(at->err, FM_INVALID, "%s:%u: there are two claims %s", at->path,
                                 list->items[i].line, made[i].id);
    }
    if (status != FM_OK) {
        claims_free(made, list->count);
        return status;
    }
    *claims = made;
    *count = list->count;
    return FM_OK;
}

static void selection_free(fm_claim_selection *selection)
{
    text_list_free(&selection->own_columns);
    text_list_free(&selection->metrics);
}

void claims_free(fm_claim *claims, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < claims[i].of_count; k++)
            selection_free(&claims[i].of[k]);
        selection_free(&claims[i].minus);
        selection_free(&claims[i].over);
        selection_free(&claims[i].over_minus);
        text_list_free(&claims[i].free_columns);
    }
    free(claims);
}
