/* Claims of which a part was judged: points left out, methods that were not run, another scene. */
#include "figure_kit.h"

/* b over a is 0.5 at each k; of b at k 16 there is no result. */
static fakes part_of(double b8)
{
    return (fakes){ { { ROW("a", 4, 0.25, 10), .bytes = 1 },
                      { ROW("a", 8, 0.25, 20), .bytes = 1 },
                      { ROW("a", 16, 0.25, 40), .bytes = 1 },
                      { ROW("b", 4, 0.25, 5), .bytes = 1 },
                      { ROW("b", 8, 0.25, b8), .bytes = 1 },
                      { ROW("b", 16, 0.25, 20), .status = "out_of_memory" } } };
}

static void expect(const char *claim, const fakes *rows, const char *wanted)
{
    char words[FM_VERDICT_WORDS_BYTES];
    const judged made = judge_beside(claim, rows, NULL);
    verdict_words(words, &made.verdict);
    if (strcmp(words, wanted) != 0)
        fail_msg("%s: \"%s\" (%s) where \"%s\" was expected", claim, words, made.verdict.reason,
                 wanted);
}

#define RATIO "of: { method: b }\nover: { method: a }\n"

static void points_left_out_are_no_plain_holds(void **state)
{
    (void)state;
    const fakes rows = part_of(10), slow = part_of(90);
    expect("at_most: 0.8\n" RATIO, &rows, "holds for 2 of 3 points");
    expect("at_most: 0.8\nof: { method: b, k: \"< 16\" }\nover: { method: a }\n", &rows, "holds");
    expect("at_most: 0.8\n" RATIO, &slow, "fails");
    expect("form: mean\nat_most: 0.8\n" RATIO, &rows, "holds for 2 of 3 points");
    expect("form: order\nof: [{ method: b }, { method: a }]\n", &rows, "holds for 5 of 6 points");
    expect("form: monotone\nalong: k\ngoes: rises\nof: { method: b }\n", &rows,
           "holds for 2 of 3 points");
}

/* One of b's densities has two points, which is a curve, the other has one. */
static void a_curve_of_too_few_points_is_left_out(void **state)
{
    (void)state;
    const fakes rows = {
        { { ROW("b", 4, 0.25, 5) }, { ROW("b", 8, 0.25, 10) }, { ROW("b", 4, 0.75, 5) } }
    };
    expect("form: monotone\nalong: k\ngoes: rises\nof: { method: b }\n", &rows,
           "holds for 2 of 3 points");
}

/* b at k 4 and 8 with five seeds: of k 4 two are lost, of k 8 what `lost8` says. */
static fakes seeds_of(unsigned lost8)
{
    fakes rows = { 0 };
    for (unsigned i = 0; i < 10; i++)
        rows.rows[i] = (fake){ ROW("b", i < 5 ? 4 : 8, 0.25, 5), .seed = i % 5 + 1,
                               .status = i == 0 || i == 3 || i >= 10 - lost8 ? "crash" : NULL };
    return rows;
}

static void seeds_of_a_point_are_counted_once(void **state)
{
    (void)state;
    const fakes whole = seeds_of(0), none = seeds_of(5);
    expect("at_most: 9\nof: { method: b }\n", &whole, "holds for 1 of 2 points");
    expect("at_most: 9\nof: { method: b, k: 8 }\n", &whole, "holds");
    expect("at_most: 9\nof: { method: b, k: 4 }\n", &whole, "unclear");
    expect("form: mean\nat_most: 9\nof: { method: b }\n", &whole, "holds for 8 of 10 points");
    expect("form: mean\nat_most: 9\nof: { method: b }\n", &none, "holds for 3 of 10 points");
    fakes other = none;
    other.rows[0].status = other.rows[3].status = NULL;
    expect("at_most: 9\nof: { method: b }\n", &other, "holds for 1 of 2 points");
}

/* Each method of a selection that takes the least of several has its own row that is lost. */
static void seeds_that_are_lost_to_the_least_are_counted_once(void **state)
{
    (void)state;
    fakes rows = seeds_of(0);
    static const char claim[] = "at_most: 9\nof: { method: [a, b], take: least }\n";
    for (int i = 0; i < 5; i++) {
        rows.rows[i].method = "a";
        rows.rows[i].k = 8;
        rows.rows[i].status = "crash";
    }
    expect(claim, &rows, "holds for 1 of 2 points");
    for (int i = 5; i < 10; i++)
        rows.rows[i].status = i < 7 ? "crash" : NULL;
    rows.rows[10] = (fake){ ROW("b", 16, 0.25, 5) };
    expect(claim, &rows, "holds for 1 of 3 points");
}

/* A curve of one point, which lacks one of the methods that it is compared with. */
static void what_is_left_out_twice_is_counted_once(void **state)
{
    (void)state;
    const fakes rows = { { { ROW("a", 4, 0.25, 5) },
                           { ROW("a", 8, 0.25, 10) },
                           { ROW("a", 4, 0.75, 5) },
                           { ROW("b", 4, 0.25, 5) },
                           { ROW("b", 8, 0.25, 5) },
                           { ROW("b", 4, 0.75, 5) },
                           { ROW("c", 4, 0.25, 5) },
                           { ROW("c", 8, 0.25, 5) },
                           { ROW("c", 4, 0.75, 5), .status = "crash" } } };
    expect("form: monotone\nalong: k\ngoes: rises\nof: { method: a }\n"
           "over: { method: [b, c], take: least }\n",
           &rows, "holds for 2 of 3 points");
}

/* b has 0 bytes at k 8, and no k in its third row. */
static void a_value_that_is_not_finite_is_left_out(void **state)
{
    (void)state;
    const fakes rows = { { { ROW("b", 4, 0.25, 5), .bytes = 8 },
                           { ROW("b", 8, 0.25, 5) },
                           { ROW("b", 0, 0.75, 5), .bytes = 8 } } };
    expect("at_least: 1\nof: { method: b, metric: fragments_generated }\n"
           "over: { metric: bytes_allocated }\n",
           &rows, "holds for 2 of 3 points");
    expect("at_most: 1\nof: { method: b, metric: bytes_allocated }\n"
           "over: { formula: { per_pixel_k: 8 } }\n",
           &rows, "holds for 2 of 3 points");
}

static void any_needs_all_points_to_fail(void **state)
{
    (void)state;
    const fakes rows = part_of(10);
    expect("form: any\nat_most: 0.8\n" RATIO, &rows, "holds");
    expect("form: any\nat_most: 0.1\n" RATIO, &rows, "unclear");
    expect("form: any\nat_most: 0.1\nof: { method: b, k: \"< 16\" }\nover: { method: a }\n", &rows,
           "fails");
}

/* a is compared with the least of b and c: c was not run, then b alone has no result at k 16. */
static void rows_to_compare_with_may_lack(void **state)
{
    (void)state;
    static const char claim[] = "at_least: 1.5\nof: { method: a }\n"
                                "over: { method: [b, c], take: least }\n";
    fakes rows = part_of(10);
    expect(claim, &rows, "unclear");
    expect("at_least: 3\nof: { method: a }\nover: { method: [b, c], take: least }\n", &rows,
           "unclear");
    expect("required: true\nat_least: 3\nof: { method: a }\n"
           "over: { method: [b, c], take: least }\n",
           &rows, "fails");
    expect("form: any\nat_least: 1.5\nof: { method: a }\n"
           "over: { method: [b, c], take: least }\n",
           &rows, "unclear");
    rows.rows[6] = (fake){ ROW("c", 4, 0.25, 6) };
    rows.rows[7] = (fake){ ROW("c", 8, 0.25, 11) };
    rows.rows[8] = (fake){ ROW("c", 16, 0.25, 21) };
    expect(claim, &rows, "holds for 2 of 3 points");
    rows.rows[5].status = NULL;
    expect(claim, &rows, "holds");
}

static void a_method_that_was_not_run_is_left_out(void **state)
{
    (void)state;
    const fakes rows = part_of(10);
    expect("at_most: 30\nof: { method: [a, b], k: \"< 16\" }\n", &rows, "holds");
    expect("at_most: 30\nof: { method: [a, b, c], k: \"< 16\" }\n", &rows,
           "holds for 4 of 5 points");
}

static void a_number_that_memory_lacks_is_left_out(void **state)
{
    (void)state;
    static const char claim[] = "at_most: 10\nof: { table: memory, metric: mib, method: [a, b] }\n";
    assert_int_equal(kit_judge_memory("f-1,w,a,A,1,1,,,,\nf-1,w,b,B,1,2,,,,\n", claim),
                     FM_VERDICT_HOLDS);
    assert_int_equal(kit_judge_memory("f-1,w,a,A,1,1,,,,\nf-1,w,b,B,1,,,,,\n", claim),
                     FM_VERDICT_IN_PART);
}

/* The figure has the first three rows. */
static void judge_figure(char words[FM_VERDICT_WORDS_BYTES], const fakes *rows, const char *run,
                         const char *claim)
{
    fixture with;
    fm_claim_results verdicts;
    fm_text text = { 0 };
    text_add(&text,
             "id: f-1\npaper: f\ntitle: t\n%scharts:\n  - { id: c, title: c, x: k, y: frame_ms }\n"
             "claims:\n  - { id: F-1, text: t, of: { method: a }, %s }\n",
             run, claim);
    fixture_open(&with, rows, text.bytes, "figure,case_id\nf-1,c0\nf-1,c1\nf-1,c2\n");
    const fm_paper_figure *const figures[] = { with.figure };
    const fm_verdicts_desc desc = { with.results, NULL, figures, 1 };
    assert_int_equal(verdicts_make(&verdicts, &desc, NULL), FM_OK);
    verdict_words(words, &verdicts.items[0].verdict);
    verdicts_free(&verdicts);
    fixture_close(&with);
    text_free(&text);
}

static void another_scene_than_the_figures_is_no_plain_holds(void **state)
{
    (void)state;
    static const char own[] = "run:\n  - { scenes: [bunny] }\n  - { scenes: [hotel, layers] }\n";
    static const char other[] = "run:\n  - { scenes: [bunny] }\n  - { scenes: [hotel] }\n";
    const fakes rows = part_of(10);
    static const char large[] = "run: { scenes: [bunny] }\nlarge:\n  - { scenes: [layers] }\n";
    static const struct {
        const char *run, *claim, *words;
    } all[] = { { own, "at_most: 99", "holds" },
                { large, "at_most: 99", "holds" },
                { "", "at_most: 99", "holds" },
                { other, "at_most: 99", "holds on another scene" },
                { own, "at_most: 1", "fails" },
                { other, "at_most: 1", "not testable here" },
                { other, "at_most: 1, required: true", "fails" } };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        char words[FM_VERDICT_WORDS_BYTES];
        judge_figure(words, &rows, all[i].run, all[i].claim);
        assert_string_equal(words, all[i].words);
    }
}

/* a takes 10, 20 and 40, the last of them on a scene that the figure has not. */
static void what_fails_on_the_figures_own_scene_fails(void **state)
{
    (void)state;
    static const char run[] = "run: { scenes: [layers] }\n";
    static const struct {
        const char *claim, *words;
    } all[] = { { "at_most: 15", "fails" },
                { "at_most: 25", "holds for 2 of 3 points" },
                { "at_most: 45", "holds on another scene" },
                { "at_most: 25, required: true", "fails" },
                { "form: mean, at_most: 17", "holds for 2 of 3 points" },
                { "form: mean, at_most: 13", "fails" },
                { "form: any, at_most: 5", "fails" } };
    fakes rows = part_of(10);
    rows.rows[2].scene = "bunny";
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        char words[FM_VERDICT_WORDS_BYTES];
        judge_figure(words, &rows, run, all[i].claim);
        assert_string_equal(words, all[i].words);
    }
}

/* Five claims of four bases; all but one hold. */
static void verdicts_are_counted_by_what_claims_rest_on(void **state)
{
    (void)state;
    fixture with;
    fm_claim_results verdicts;
    const fakes rows = part_of(10);
    fixture_open(&with, &rows,
                 "id: f-1\npaper: f\ntitle: t\n"
                 "charts:\n  - { id: c, title: c, x: k, y: frame_ms }\nclaims:\n"
                 "  - { id: F-1, text: t, of: { method: a }, at_most: 99 }\n"
                 "  - { id: F-2, text: t, basis: plot, of: { method: a }, at_most: 99 }\n"
                 "  - { id: F-3, text: t, basis: plot, of: { method: a }, at_most: 9 }\n"
                 "  - { id: F-4, text: t, basis: tuned, of: { method: a }, at_most: 99 }\n"
                 "  - { id: F-5, text: t, basis: calibrated, of: { method: a }, at_most: 99 }\n",
                 NULL);
    const fm_paper_figure *const figures[] = { with.figure };
    const fm_verdicts_desc desc = { with.results, NULL, figures, 1 };
    assert_int_equal(verdicts_make(&verdicts, &desc, NULL), FM_OK);
    const fm_verdict_counts all = verdicts_count(&verdicts, NULL);
    const fm_verdict_counts other = verdicts_count(&verdicts, "g");
    assert_int_equal(all.counts[FM_BASIS_STATED][FM_VERDICT_HOLDS], 1);
    assert_int_equal(all.counts[FM_BASIS_PLOT][FM_VERDICT_HOLDS], 1);
    assert_int_equal(all.counts[FM_BASIS_PLOT][FM_VERDICT_FAILS], 1);
    assert_int_equal(all.counts[FM_BASIS_TUNED][FM_VERDICT_HOLDS], 1);
    assert_int_equal(all.counts[FM_BASIS_CALIBRATED][FM_VERDICT_HOLDS], 1);
    assert_false(verdict_counts_has(&all, FM_BASIS_PREDICTED));
    assert_false(verdict_counts_has(&other, FM_BASIS_STATED));
    verdicts_free(&verdicts);
    fixture_close(&with);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_left_out_are_no_plain_holds),
        cmocka_unit_test(a_curve_of_too_few_points_is_left_out),
        cmocka_unit_test(seeds_of_a_point_are_counted_once),
        cmocka_unit_test(seeds_that_are_lost_to_the_least_are_counted_once),
        cmocka_unit_test(what_is_left_out_twice_is_counted_once),
        cmocka_unit_test(a_value_that_is_not_finite_is_left_out),
        cmocka_unit_test(any_needs_all_points_to_fail),
        cmocka_unit_test(rows_to_compare_with_may_lack),
        cmocka_unit_test(a_method_that_was_not_run_is_left_out),
        cmocka_unit_test(a_number_that_memory_lacks_is_left_out),
        cmocka_unit_test(another_scene_than_the_figures_is_no_plain_holds),
        cmocka_unit_test(what_fails_on_the_figures_own_scene_fails),
        cmocka_unit_test(verdicts_are_counted_by_what_claims_rest_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
