/* Claims on fabricated results: each form holds on one set of rows and fails on another. */
#include "claims_kit.h"

static judged judge(const char *claim, const fakes *rows)
{
    return judge_beside(claim, rows, NULL);
}

static void expect(const char *claim, const fakes *rows, fm_verdict_kind kind)
{
    const judged made = judge(claim, rows);
    if (made.verdict.kind != kind)
        fail_msg("%s: \"%s\" (%g, %g to %g; %s) where \"%s\" was expected", claim,
                 verdict_name(made.verdict.kind), made.verdict.measured.median,
                 made.verdict.measured.low, made.verdict.measured.high, made.verdict.reason,
                 verdict_name(kind));
}

/* Two methods at k 4, 8, 16; the shape of b differs. */
static fakes two_methods(double b4, double b8, double b16)
{
    return (fakes){ { { ROW("a", 4, 0.25, 10), .bytes = 100 },
                      { ROW("a", 8, 0.25, 20), .bytes = 200 },
                      { ROW("a", 16, 0.25, 40), .bytes = 400 },
                      { ROW("b", 4, 0.25, b4), .bytes = 50 },
                      { ROW("b", 8, 0.25, b8), .bytes = 50 },
                      { ROW("b", 16, 0.25, b16), .bytes = 50 } } };
}

static const char ratio_of_b_to_a[] = "of: { method: b }\nover: { method: a }\n";

static void expect_with(const char *head, const char *selections, const fakes *rows,
                        fm_verdict_kind kind)
{
    char claim[512];
    snprintf(claim, sizeof claim, "%s\n%s", head, selections);
    expect(claim, rows, kind);
}

static void bound_holds_only_if_every_point_is_within(void **state)
{
    (void)state;
    const fakes inside = two_methods(5, 10, 20), outside = two_methods(5, 10, 60);
    const fakes edge = two_methods(5, 10, 32);
    expect_with("form: bound\nat_most: 0.8", ratio_of_b_to_a, &inside, FM_VERDICT_HOLDS);
    expect_with("form: bound\nat_most: 0.8", ratio_of_b_to_a, &outside, FM_VERDICT_FAILS);
    expect_with("form: bound\nat_most: 0.8", ratio_of_b_to_a, &edge, FM_VERDICT_UNCLEAR);
    expect_with("form: bound\nat_most: 0.8\ntolerance: 0.1", ratio_of_b_to_a, &edge,
                FM_VERDICT_HOLDS);
    expect_with("form: bound\nat_least: 0.6", ratio_of_b_to_a, &inside, FM_VERDICT_FAILS);
}

static void any_needs_one_point_within(void **state)
{
    (void)state;
    const fakes one = two_methods(50, 60, 20), none = two_methods(50, 60, 90);
    expect_with("form: any\nat_most: 0.8", ratio_of_b_to_a, &one, FM_VERDICT_HOLDS);
    expect_with("form: any\nat_most: 0.8", ratio_of_b_to_a, &none, FM_VERDICT_FAILS);
}

static void order_compares_neighbours_at_each_workload(void **state)
{
    (void)state;
    static const char claim[] = "form: order\nof: [{ method: b }, { method: a }]\n";
    const fakes right = two_methods(5, 10, 20), wrong = two_methods(5, 10, 50);
    expect(claim, &right, FM_VERDICT_HOLDS);
    expect(claim, &wrong, FM_VERDICT_FAILS);
    expect_with("form: order\ntolerance: 0.3", "of: [{ method: b }, { method: a }]", &wrong,
                FM_VERDICT_HOLDS);
}

static void monotone_forbids_steps_back(void **state)
{
    (void)state;
    const fakes falling = two_methods(12, 20, 30), bent = two_methods(12, 30, 30);
    const fakes level = two_methods(12, 24, 48), back = two_methods(12, 26, 50);
    expect_with("form: monotone\nalong: k\ngoes: falls", ratio_of_b_to_a, &falling,
                FM_VERDICT_HOLDS);
    expect_with("form: monotone\nalong: k\ngoes: falls", ratio_of_b_to_a, &bent, FM_VERDICT_FAILS);
    expect_with("form: monotone\nalong: k\ngoes: rises", ratio_of_b_to_a, &falling,
                FM_VERDICT_FAILS);
    /* A tolerance forgives steps, not a curve that goes nowhere, or back. */
    expect_with("form: monotone\nalong: k\ngoes: falls\ntolerance: 0.1", ratio_of_b_to_a, &level,
                FM_VERDICT_UNCLEAR);
    expect_with("form: monotone\nalong: k\ngoes: falls\ntolerance: 0.1", ratio_of_b_to_a, &back,
                FM_VERDICT_FAILS);
}

static void crossing_lies_in_the_interval_or_not(void **state)
{
    (void)state;
    static const char head[] = "form: crossing\nalong: k\nbetween: [8, 16]";
    const fakes inside = two_methods(12, 22, 30), early = two_methods(12, 10, 10);
    const fakes never = two_methods(12, 24, 48);
    expect_with(head, ratio_of_b_to_a, &inside, FM_VERDICT_HOLDS);
    expect_with(head, ratio_of_b_to_a, &early, FM_VERDICT_FAILS);
    expect_with(head, ratio_of_b_to_a, &never, FM_VERDICT_FAILS);
    /* It may still come beyond the last k that was measured. */
    expect_with("form: crossing\nalong: k\nbetween: [16, 32]", ratio_of_b_to_a, &never,
                FM_VERDICT_NOT_TESTABLE);
}

static void crossing_is_interpolated(void **state)
{
    (void)state;
    const fakes inside = two_methods(12, 24, 32); /* 1.2, 1.2, 0.8 */
    char claim[256];
    snprintf(claim, sizeof claim, "form: crossing\nalong: k\nbetween: [8, 16]\n%s",
             ratio_of_b_to_a);
    const judged made = judge(claim, &inside);
    assert_true(fabs(made.verdict.measured.median - 8 * sqrt(2.0)) < 0.05);
    assert_true(made.verdict.measured.low < made.verdict.measured.median);
    assert_true(made.verdict.measured.high > made.verdict.measured.median);
}

static void peak_is_interior_or_not(void **state)
{
    (void)state;
    static const char claim[] =
        "form: peak\nalong: k\nbetween: [8, 8]\nextreme: least\nof: { method: b }\n";
    const fakes interior = two_methods(12, 8, 30), at_end = two_methods(5, 8, 30);
    const fakes flat = two_methods(8, 8, 30);
    expect(claim, &interior, FM_VERDICT_HOLDS);
    expect(claim, &at_end, FM_VERDICT_FAILS);
    expect(claim, &flat, FM_VERDICT_UNCLEAR);
}

static void slope_is_the_exponent(void **state)
{
    (void)state;
    static const char claim[] =
        "form: slope\nalong: k\nequals: 1\ntolerance: 0.1\nof: { method: b }\n";
    const fakes linear = two_methods(7, 14, 28), flat = two_methods(7, 7, 7);
    expect(claim, &linear, FM_VERDICT_HOLDS);
    expect(claim, &flat, FM_VERDICT_FAILS);
    expect_with("form: slope\nscale: linear\nalong: k\nequals: 0\ntolerance: 0.05",
                "of: { method: b }", &flat, FM_VERDICT_HOLDS);
    expect_with("form: slope\nscale: linear\nalong: k\nequals: 0\ntolerance: 0.05",
                "of: { method: b }", &linear, FM_VERDICT_FAILS);
}

static void spread_is_greatest_over_least(void **state)
{
    (void)state;
    const fakes flat = two_methods(7, 7.2, 7.1), steep = two_methods(7, 7, 14);
    expect_with("form: spread\nalong: k\nat_most: 1.1", "of: { method: b }", &flat,
                FM_VERDICT_HOLDS);
    expect_with("form: spread\nalong: k\nat_most: 1.1", "of: { method: b }", &steep,
                FM_VERDICT_FAILS);
}

static void formula_gives_the_bytes(void **state)
{
    (void)state;
    static const char claim[] =
        "form: bound\nequals: 1\nof: { method: a, metric: bytes_allocated }\n"
        "over: { formula: { constant: 0, per_pixel: 8, per_pixel_k: 8 } }\n";
    fakes rows = { { { ROW("a", 4, 1, 10), .bytes = 64 * 32 * 40 } } };
    expect(claim, &rows, FM_VERDICT_HOLDS);
    rows.rows[0].bytes += 1;
    expect(claim, &rows, FM_VERDICT_FAILS);
}

static void differences_are_taken_before_ratios(void **state)
{
    (void)state;
    static const char claim[] = "form: bound\nat_least: 0.45\nat_most: 0.55\nof: { method: a }\n"
                                "minus: { method: b }\nover: { metric: frame_ms }\n";
    const fakes half = two_methods(5, 10, 20), more = two_methods(1, 2, 4);
    expect(claim, &half, FM_VERDICT_HOLDS);
    expect(claim, &more, FM_VERDICT_FAILS);
}

static void counts_of_fragments_can_be_claimed(void **state)
{
    (void)state;
    static const char claim[] =
        "form: bound\nequals: 0\nof: { method: a, metric: [missing, extra, misordered] }\n";
    fakes rows = { { { ROW("a", 4, 1, 10) } } };
    expect(claim, &rows, FM_VERDICT_HOLDS);
    rows.rows[0].missing = 3;
    expect(claim, &rows, FM_VERDICT_FAILS);
}

static void a_share_is_a_ratio_of_the_same_row(void **state)
{
    (void)state;
    static const char claim[] =
        "form: bound\nat_most: 0.05\nof: { method: a, metric: resolve_ms }\n"
        "over: { metric: frame_ms }\n";
    fakes rows = { { { ROW("a", 4, 1, 100) } } };
    expect(claim, &rows, FM_VERDICT_HOLDS);
    rows.rows[0].resolve_ms = 20;
    expect(claim, &rows, FM_VERDICT_FAILS);
}

static void the_least_of_several_is_compared(void **state)
{
    (void)state;
    static const char claim[] = "form: bound\nat_most: 1\nof: { method: [a, b], take: least }\n"
                                "over: { method: [c, d], take: least }\n";
    fakes rows = { { { ROW("a", 4, 1, 10) },
                     { ROW("b", 4, 1, 30) },
                     { ROW("c", 4, 1, 20) },
                     { ROW("d", 0, 1, 90) } } };
    expect(claim, &rows, FM_VERDICT_HOLDS);
    rows.rows[3].frame_ms = 5; /* of a method that knows no k */
    expect(claim, &rows, FM_VERDICT_FAILS);
}

static void options_select_and_pair(void **state)
{
    (void)state;
    static const char claim[] = "form: bound\nat_most: 1\nof: { method: a, lock: spin }\n"
                                "over: { lock: interlock }\n";
    fakes rows = { { { ROW("a", 4, 1, 10), .options = "layout=tile lock=spin" },
                     { ROW("a", 4, 1, 20), .options = "layout=tile lock=interlock" },
                     { ROW("a", 4, 1, 1), .options = "layout=pixel lock=interlock" } } };
    expect(claim, &rows, FM_VERDICT_HOLDS);
    rows.rows[1].frame_ms = 5;
    expect(claim, &rows, FM_VERDICT_FAILS);
}

static void pairs_differ_only_in_what_is_named(void **state)
{
    (void)state;
    static const char claim[] =
        "form: bound\nat_least: 2.5\nat_most: 3\nof: { method: a, pixel_density: 0.75 }\n"
        "over: { pixel_density: 0.25 }\n";
    fakes rows = { { { ROW("a", 4, 0.25, 10) },
                     { ROW("a", 4, 0.75, 28) },
                     { ROW("a", 8, 0.25, 30) },
                     { ROW("a", 8, 0.75, 82) } } };
    expect(claim, &rows, FM_VERDICT_HOLDS);
    rows.rows[3].frame_ms = 60;
    expect(claim, &rows, FM_VERDICT_FAILS);
}

static void comparisons_select_ranges(void **state)
{
    (void)state;
    const fakes rows = two_methods(50, 10, 20);
    expect("form: bound\nat_most: 0.8\nof: { method: b, k: \">= 8\" }\nover: { method: a }\n",
           &rows, FM_VERDICT_HOLDS);
    expect("form: bound\nat_most: 0.8\nof: { method: b, k: not 8 }\nover: { method: a }\n", &rows,
           FM_VERDICT_FAILS);
}

static void few_launches_and_noise_are_unclear(void **state)
{
    (void)state;
    static const char claim[] = "form: bound\nat_most: 1\nof: { method: a }\nover: { method: b }\n";
    fakes rows = { { { ROW("a", 4, 1, 10) }, { ROW("b", 4, 1, 11) } } };
    expect(claim, &rows, FM_VERDICT_HOLDS);
    rows.rows[0].launches = rows.rows[1].launches = 2;
    expect(claim, &rows, FM_VERDICT_UNCLEAR);
    rows.rows[0].launches = rows.rows[1].launches = 6;
    rows.rows[0].noise = 0.4;
    expect(claim, &rows, FM_VERDICT_UNCLEAR);
}

static void images_are_compared(void **state)
{
    (void)state;
    char directory[64], path[256];
    fm_error err = { 0 };
    const fakes rows = { { { ROW("a", 1, 1, 10) }, { ROW("b", 0, 1, 11) } } };
    fm_image *image = NULL;
    double verdicts_wanted[] = { 0.0, 0.5 };
    for (int i = 0; i < 2; i++) {
        fm_result_files *results = NULL;
        fm_paper_figure *figure = NULL;
        fm_claim_results verdicts;
        kit_make_results(directory, &rows);
        snprintf(path, sizeof path, "%s/images", directory);
        assert_int_equal(mkdir(path, 0777), 0);
        assert_int_equal(image_create(&image, 16, 16, &err), FM_OK);
        snprintf(path, sizeof path, "%s/images/c0.rgba32f", directory);
        assert_int_equal(image_write(path, image, &err), FM_OK);
        image->rgba[17] = (float)verdicts_wanted[i];
        snprintf(path, sizeof path, "%s/images/c1.rgba32f", directory);
        assert_int_equal(image_write(path, image, &err), FM_OK);
        image_destroy(image);
        assert_int_equal(kit_read_figure(&figure, directory,
                                         "form: images\nat_most: 1e-6\nof: { method: a, k: 1 }\n"
                                         "over: { method: b, k: [\"\", 1] }\n",
                                         &err),
                         FM_OK);
        assert_int_equal(result_files_read(&results, directory, &err), FM_OK);
        const fm_paper_figure *const figures[] = { figure };
        const fm_verdicts_desc desc = { results, NULL, figures, 1 };
        assert_int_equal(verdicts_make(&verdicts, &desc, &err), FM_OK);
        assert_int_equal(verdicts.items[0].verdict.kind,
                         i == 0 ? FM_VERDICT_HOLDS : FM_VERDICT_FAILS);
        assert_true(verdicts.items[0].verdict.measured.median == verdicts_wanted[i]);
        verdicts_free(&verdicts);
        paper_figure_close(figure);
        result_files_close(results);
        kit_remove_directory(directory);
    }
}

static void gpu_claims_are_not_testable_in_software(void **state)
{
    (void)state;
    static const char claim[] = "where: gpu\nwhy: threads take turns there\nform: bound\n"
                                "at_most: 1\nof: { method: a }\nover: { method: b }\n";
    fakes rows = { { { ROW("a", 4, 1, 10) }, { ROW("b", 4, 1, 20) } } };
    judged made = judge(claim, &rows);
    assert_int_equal(made.verdict.kind, FM_VERDICT_NOT_TESTABLE);
    assert_non_null(strstr(made.verdict.reason, "threads take turns there"));
    rows.rows[0].device = rows.rows[1].device = "hard";
    expect(claim, &rows, FM_VERDICT_HOLDS);
}

static void reference_decides_what_is_not_testable_here(void **state)
{
    (void)state;
    static const char claim[] = "where: gpu\nform: bound\nrequired: true\n"
                                "at_most: 1\nof: { method: a }\nover: { method: b }\n";
    const fakes here = { { { ROW("a", 4, 1, 10) }, { ROW("b", 4, 1, 20) } } };
    const fakes gpu = { { { ROW("a", 4, 1, 30), .device = "hard" },
                          { ROW("b", 4, 1, 20), .device = "hard" } } };
    const judged made = judge_beside(claim, &here, &gpu);
    assert_int_equal(made.count, 1);
    assert_int_equal(made.verdict.kind, FM_VERDICT_FAILS);
    assert_string_equal(made.device, "H100 (reference)");
    assert_non_null(strstr(made.verdict.reason, "not testable on llvmpipe"));
    assert_int_equal(made.required_failed, 0); /* another machine's */
}

static void hazards_need_a_gpu_or_adjacent_lanes(void **state)
{
    (void)state;
    static const char claim[] =
        "where: hazards\nform: bound\nat_least: 1\nof: { method: a, metric: missing }\n";
    fakes rows = { { { ROW("a", 4, 1, 10), .missing = 0 } } };
    expect(claim, &rows, FM_VERDICT_NOT_TESTABLE);
    rows.rows[0].feed = "compute-adjacent";
    rows.rows[0].missing = 7;
    expect(claim, &rows, FM_VERDICT_HOLDS);
}

static void cases_without_a_result_are_told(void **state)
{
    (void)state;
    static const char claim[] = "form: bound\nat_most: 1\nof: { method: a }\nover: { method: b }\n";
    fakes rows = { { { ROW("a", 4, 1, 10) }, { ROW("b", 4, 1, 20), .status = "timeout" } } };
    const judged made = judge(claim, &rows);
    assert_int_equal(made.verdict.kind, FM_VERDICT_NOT_TESTABLE);
    assert_non_null(strstr(made.verdict.reason, "timeout"));
}

static void required_claims_that_fail_are_counted(void **state)
{
    (void)state;
    const fakes rows = two_methods(50, 60, 70);
    const judged made = judge(
        "required: true\nform: bound\nat_most: 1\nof: { method: b }\nover: { method: a }\n", &rows);
    assert_int_equal(made.required_failed, 1);
}

static void memory_rows_are_claimed_by_formula(void **state)
{
    (void)state;
    const char *claim = "form: bound\nequals: 0.5\n"
                        "of: { table: memory, method: a, metric: bytes }\n"
                        "over: { method: b }\n";
    assert_int_equal(
        kit_judge_memory("f-1,small,a,A,50,1,1,0,exact,\nf-1,small,b,B,100,2,2,0,exact,\n", claim),
        FM_VERDICT_HOLDS);
    assert_int_equal(
        kit_judge_memory("f-1,small,a,A,150,1,1,0,exact,\nf-1,small,b,B,100,2,2,0,exact,\n", claim),
        FM_VERDICT_FAILS);
}

static void memory_rows_are_compared_with_the_least_or_greatest(void **state)
{
    (void)state;
    const char *rows = "f-1,small,a,A,50,1,1,0,exact,\nf-1,small,b,B,100,2,2,0,exact,\n"
                       "f-1,small,c,C,25,2,2,0,exact,\nf-1,small,d,D,200,2,2,0,exact,\n";
    assert_int_equal(kit_judge_memory(rows, "form: bound\nequals: 2\n"
                                            "of: { table: memory, method: a, metric: bytes }\n"
                                            "over: { method: [b, c, d], take: least }\n"),
                     FM_VERDICT_HOLDS);
    assert_int_equal(kit_judge_memory(rows, "form: bound\nequals: 0.25\n"
                                            "of: { table: memory, method: a, metric: bytes }\n"
                                            "over: { method: [b, c, d], take: greatest }\n"),
                     FM_VERDICT_HOLDS);
}

static void claims_csv_has_the_columns_and_both_of_the_papers_values(void **state)
{
    (void)state;
    char directory[64], path[256];
    fm_error err = { 0 };
    const fakes rows = two_methods(5, 10, 20);
    fm_result_files *results = NULL;
    fm_paper_figure *figure = NULL;
    fm_claim_results verdicts;
    fm_table *table = NULL;
    kit_make_results(directory, &rows);
    assert_int_equal(kit_read_figure(&figure, directory,
                                     "paper: 25\nplot: 8.9\nat_most: 1\nof: { method: b }\n"
                                     "over: { method: a }\n",
                                     &err),
                     FM_OK);
    assert_int_equal(result_files_read(&results, directory, &err), FM_OK);
    const fm_paper_figure *const figures[] = { figure };
    const fm_verdicts_desc desc = { results, NULL, figures, 1 };
    assert_int_equal(verdicts_make(&verdicts, &desc, &err), FM_OK);
    snprintf(path, sizeof path, "%s/claims.csv", directory);
    assert_int_equal(verdicts_write(&verdicts, path, &err), FM_OK);
    assert_int_equal(table_read(&table, path, &err), FM_OK);
    assert_string_equal(table_cell(table, 0, table_column(table, "claim")), "F-1");
    assert_string_equal(table_cell(table, 0, table_column(table, "paper_value")),
                        "25; its own plot: 8.9");
    assert_string_equal(table_cell(table, 0, table_column(table, "verdict")), "holds");
    assert_string_equal(table_cell(table, 0, table_column(table, "basis")), "stated");
    assert_true(atof(table_cell(table, 0, table_column(table, "measured"))) == 0.5);
    table_close(table);
    verdicts_free(&verdicts);
    paper_figure_close(figure);
    result_files_close(results);
    kit_remove_directory(directory);
}

static void claims_name_the_line_of_a_mistake(void **state)
{
    (void)state;
    static const struct {
        const char *claim, *says;
    } wrong[] = {
        { "of: { method: a }\n", "f-1.yml:7: F-1: at_least, at_most or equals is missing" },
        { "form: bund\nat_most: 1\nof: { method: a }\n", "is \"bound\" meant?" },
        { "at_moste: 1\nof: { method: a }\n", "is \"at_most\" meant?" },
        { "at_most: 1\n", "of: a selection is expected" },
        { "form: order\nof: { method: a }\n", "of: a list of 2 to 12 selections" },
        { "form: crossing\nalong: k\nof: { method: a }\n", "between: [LOW, HIGH]" },
        { "form: peak\nbetween: [1, 2]\nof: { method: a }\n", "along is missing" },
        { "form: images\nat_most: 1\nof: { method: a }\n", "over is missing" },
        { "at_most: 1x\nof: { method: a }\n", "at_most: a number is expected" },
        { "at_least: 3\nat_most: 2\nof: { method: a }\n", "nothing can be within" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char directory[64];
        fm_error err = { 0 };
        fm_paper_figure *figure = NULL;
        const fakes rows = { { { ROW("a", 4, 1, 10) } } };
        kit_make_results(directory, &rows);
        assert_int_equal(kit_read_figure(&figure, directory, wrong[i].claim, &err), FM_INVALID);
        if (strstr(err.message, wrong[i].says) == NULL)
            fail_msg("\"%s\" does not say \"%s\"", err.message, wrong[i].says);
        kit_remove_directory(directory);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bound_holds_only_if_every_point_is_within),
        cmocka_unit_test(any_needs_one_point_within),
        cmocka_unit_test(order_compares_neighbours_at_each_workload),
        cmocka_unit_test(monotone_forbids_steps_back),
        cmocka_unit_test(crossing_lies_in_the_interval_or_not),
        cmocka_unit_test(crossing_is_interpolated),
        cmocka_unit_test(peak_is_interior_or_not),
        cmocka_unit_test(slope_is_the_exponent),
        cmocka_unit_test(spread_is_greatest_over_least),
        cmocka_unit_test(formula_gives_the_bytes),
        cmocka_unit_test(differences_are_taken_before_ratios),
        cmocka_unit_test(counts_of_fragments_can_be_claimed),
        cmocka_unit_test(a_share_is_a_ratio_of_the_same_row),
        cmocka_unit_test(the_least_of_several_is_compared),
        cmocka_unit_test(options_select_and_pair),
        cmocka_unit_test(pairs_differ_only_in_what_is_named),
        cmocka_unit_test(comparisons_select_ranges),
        cmocka_unit_test(few_launches_and_noise_are_unclear),
        cmocka_unit_test(images_are_compared),
        cmocka_unit_test(gpu_claims_are_not_testable_in_software),
        cmocka_unit_test(reference_decides_what_is_not_testable_here),
        cmocka_unit_test(hazards_need_a_gpu_or_adjacent_lanes),
        cmocka_unit_test(cases_without_a_result_are_told),
        cmocka_unit_test(required_claims_that_fail_are_counted),
        cmocka_unit_test(memory_rows_are_claimed_by_formula),
        cmocka_unit_test(memory_rows_are_compared_with_the_least_or_greatest),
        cmocka_unit_test(claims_csv_has_the_columns_and_both_of_the_papers_values),
        cmocka_unit_test(claims_name_the_line_of_a_mistake),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
