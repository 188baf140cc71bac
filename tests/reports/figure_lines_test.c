/* Line charts over k: where methods without a k of their own stand. */
#include "figure_kit.h"

static const char over_k[] = "id: f-1\npaper: f\ntitle: t\ncharts:\n"
                             "  - { id: c, title: c, x: k, y: frame_ms }\n";
static const char over_k_across_density[] =
    "id: f-1\npaper: f\ntitle: t\ncharts:\n"
    "  - { id: c, title: c, x: k, y: frame_ms, across: [pixel_density] }\n";

/* A case of n = 2 k layers. */
#define TWICE(of, keeps, layers, time_ms)                                                          \
    {                                                                                              \
        ROW(of, keeps, 0.25, time_ms), .n = (layers), .r = 2                                       \
    }

static const fm_series *find_series(const drawing *in, const char *label)
{
    for (size_t i = 0; i < in->chart.series_count; i++)
        if (strcmp(in->chart.series[i].label, label) == 0)
            return &in->chart.series[i];
    fail_msg("no curve %s", label);
    return NULL;
}

static void without_k_the_layers_tell_the_place(void **state)
{
    (void)state;
    const fakes rows = { { TWICE("a", 2, 4, 10), TWICE("a", 4, 8, 20), TWICE("a", 8, 16, 30),
                           TWICE("a", 16, 32, 40), TWICE("a", 32, 64, 50), TWICE("b", 0, 4, 1),
                           TWICE("b", 0, 8, 2), TWICE("b", 0, 16, 3), TWICE("b", 0, 32, 4),
                           TWICE("b", 0, 64, 5) } };
    drawing made;
    drawing_open(&made, &rows, over_k, NULL, 0);
    assert_int_equal(made.groups.count, 1);
    const fm_series *b = find_series(&made, "B");
    assert_int_equal(b->point_count, 5);
    for (size_t i = 0; i < 5; i++) {
        assert_true(b->points[i].x == 2 << i); /* k = n / r */
        assert_true(b->points[i].y == (double)i + 1.0);
        assert_true(isfinite(b->points[i].low)); /* an interval each */
    }
    drawing_close(&made);
}

static void many_level_cases_are_one_level_line(void **state)
{
    (void)state;
    const fakes rows = { { { ROW("a", 2, 1, 9) },
                           { ROW("a", 4, 1, 9) },
                           { ROW("a", 6, 1, 9) },
                           { ROW("a", 8, 1, 9) },
                           { ROW("a", 10, 1, 9) },
                           { ROW("a", 12, 1, 9) },
                           { ROW("b", 0, 0.1, 5) },
                           { ROW("b", 0, 0.2, 5) },
                           { ROW("b", 0, 0.3, 5) },
                           { ROW("b", 0, 0.4, 5) },
                           { ROW("b", 0, 0.5, 5) } } };
    drawing made;
    drawing_open(&made, &rows, over_k_across_density, NULL, 0);
    assert_int_equal(made.groups.count, 1);
    const fm_series *b = find_series(&made, "B");
    assert_int_equal(b->point_count, 2);
    assert_true(b->points[0].x == 2 && b->points[1].x == 12);
    assert_true(b->points[0].y == 5 && b->points[1].y == 5);
    drawing_close(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_k_the_layers_tell_the_place),
        cmocka_unit_test(many_level_cases_are_one_level_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
