/* Two runs compared: which cases are joined, what is compared, what comes of it. */
#include "compare_kit.h"

#include <time.h>

#include "base/launch_noise.h"

/* Ids of a changed method differ; what it was asked for names its case, defaults left out. */
static void cases_are_joined_by_id_and_then_by_name(void **state)
{
    static const char *const base[] = { "k=4", "k=8;options=x=1", "k=8;options=x=7", "k=2" };
    static const char *const now[] = { "k=4;case_id=c0", "k=8;case_id=d1;options=x=1 y=2",
                                       "k=8;case_id=d2;options=x=7", "k=3;case_id=d3" };
    kit_comparison kit;
    (void)state;
    kit_compare(&kit, &(kit_run_desc){ ROWS(base) }, &(kit_run_desc){ ROWS(now) }, NULL);
    assert_int_equal(kit.status, FM_OK);
    assert_int_equal(kit.made.count, 3);
    assert_int_equal(kit.made.only_base, 1);
    assert_int_equal(kit.made.only_now, 1);
    assert_false(kit_case(&kit, "c0")->pair.is_by_name);
    assert_string_equal(kit_case(&kit, "c1")->pair.now->id, "d1");
    assert_true(kit_case(&kit, "c1")->pair.is_by_name);
    assert_string_equal(kit_case(&kit, "c1")->changes.items[0].name, "options");
    assert_string_equal(kit_case(&kit, "c2")->pair.now->id, "d2");
    assert_int_equal(kit_case(&kit, "c2")->changes.count, 0);
    kit_end(&kit);
}

/* The default of layout and node differs between devices: what a row has tells it apart, and rows
 * of before there was a choice of nodes had split ones. */
static void cases_of_one_name_are_told_apart_by_what_auto_means(void **state)
{
    static const char *const base[] = { "k=4", "k=8;options=x=1", "k=2;options=node=whole",
                                        "k=1;options=layout=tile" };
    static const char *const now[] = { "case_id=d0;k=4;options=node=split",
                                       "case_id=d1;k=8;options=x=1 node=whole",
                                       "case_id=d2;k=2;options=node=whole",
                                       "case_id=d3;k=1;options=layout=image" };
    kit_comparison kit;
    (void)state;
    (void)state;
    kit_compare(&kit, &(kit_run_desc){ ROWS(base) }, &(kit_run_desc){ ROWS(now) }, NULL);
    assert_int_equal(kit.made.count, 2);
    assert_string_equal(kit_case(&kit, "c0")->pair.now->id, "d0");
    assert_string_equal(kit_case(&kit, "c2")->pair.now->id, "d2");
    kit_end(&kit);
}

/* Layers have an n each; of a mesh that crashed none is known. */
static void cases_of_one_name_are_told_apart_by_n(void **state)
{
    static const char *const base[] = { "n=8", "n=16", "scene=mesh;n=5", "scene=bunny;n=7" };
    static const char *const now[] = { "case_id=d0;n=16", "case_id=d1;n=8",
                                       "case_id=d2;scene=mesh;n=;status=crash",
                                       "case_id=d3;scene=bunny;n=9" };
    kit_comparison kit;
    (void)state;
    kit_compare(&kit, &(kit_run_desc){ ROWS(base) }, &(kit_run_desc){ ROWS(now) }, NULL);
    assert_int_equal(kit.made.count, 3);
    assert_string_equal(kit_case(&kit, "c0")->pair.now->id, "d1");
    assert_string_equal(kit_case(&kit, "c1")->pair.now->id, "d0");
    assert_string_equal(kit_case(&kit, "c2")->pair.now->id, "d2");
    kit_end(&kit);
}

static void runs_without_a_common_case_do_not_compare(void **state)
{
    static const char *const base[] = { "k=4" }, *const now[] = { "case_id=d;k=8" };
    kit_comparison kit;
    (void)state;
    kit_compare(&kit, &(kit_run_desc){ ROWS(base) }, &(kit_run_desc){ ROWS(now) }, NULL);
    assert_int_equal(kit.status, FM_UNSUPPORTED);
    assert_non_null(strstr(kit.err.message, "no case in common"));
    kit_end(&kit);
}

static const char *const one[] = { "k=4" };
static const kit_run_desc usual = { ROWS(one) };

/* What is compared, and the answer where it is refused, of two runs that differ so. */
static void expect_choice(const kit_run_desc *now, const char *metric, const char *reference,
                          const char *title, fm_status status)
{
    char made[128] = "";
    kit_comparison kit;
    kit_compare(&kit, &usual, now, &(fm_quantity_desc){ metric, reference });
    assert_int_equal(kit.status, status);
    if (status == FM_OK)
        quantity_title(made, &kit.made.quantity);
    assert_string_equal(made, title);
    kit_end(&kit);
}

#define HARDWARE(cpu, cores, bytes)                                                                \
    "\"cpu\": \"" cpu "\", \"cores\": " cores ", \"memory_bytes\": " bytes

static void milliseconds_of_two_machines_are_refused(void **state)
{
    const kit_run_desc others[] = {
        { ROWS(one), .machine = HARDWARE("Xeon", "2", "1000000") },
        { ROWS(one), .machine = HARDWARE("EPYC", "4", "1000000") },
        { ROWS(one), .machine = HARDWARE("EPYC", "2", "2000000") },
        { ROWS(one), .machine = "\"cores\": 2" }, /* which one is not known */
    };
    (void)state;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        expect_choice(&others[i], NULL, NULL, "frame_ms / floor", FM_OK);
        expect_choice(&others[i], "frame_ms", NULL, "", FM_UNSUPPORTED);
        expect_choice(&others[i], NULL, "none", "", FM_UNSUPPORTED);
        expect_choice(&others[i], "store_ms", "floor", "store_ms / floor", FM_OK);
        expect_choice(&others[i], "times_floor", NULL, "times_floor", FM_OK);
        expect_choice(&others[i], NULL, "a", "frame_ms / a", FM_OK);
    }
}

/* The manifest of a run that was interrupted lists no devices, and its rows know them; a name that
 * neither tells is nobody's. */
static void milliseconds_of_two_devices_are_refused(void **state)
{
    static const char *const other[] = { "k=4;device_name=H200" }, *const none[] = {
        "k=4;device_name="
    };
    static const char unnamed[] = "{\"selector\": \"vulkan\", \"name\": \"\"}";
    const kit_run_desc same = { ROWS(one), .devices = "" };
    const kit_run_desc others[] = {
        { ROWS(other), .devices = "" }, { ROWS(other), .devices = unnamed }, { ROWS(other) },
        { ROWS(none), .devices = "" },  { ROWS(none), .devices = unnamed },
    };
    kit_comparison kit;
    (void)state;
    expect_choice(&same, NULL, NULL, "frame_ms", FM_OK);
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        expect_choice(&others[i], NULL, NULL, "frame_ms / floor", FM_OK);
        expect_choice(&others[i], "frame_ms", NULL, "", FM_UNSUPPORTED);
    }
    kit_compare(&kit, &usual, &others[0], NULL);
    assert_int_equal(kit.made.machines.count, 1);
    assert_string_equal(kit.made.machines.differing[0].name, "vulkan name");
    assert_string_equal(kit.made.machines.differing[0].now, "H200");
    kit_end(&kit);
    kit_compare(&kit, &others[3], &others[3], NULL);
    assert_false(kit.made.machines.is_same_machine);
    kit_end(&kit);
}

/* A new kernel, and a memory that it counts a little otherwise, are no other machine. */
static void days_and_kernels_leave_the_machine_the_same(void **state)
{
    const kit_run_desc kernel = { ROWS(one), .machine = HARDWARE(
                                                 "EPYC", "2", "990000") ", \"kernel\": \"6.2\"" };
    const kit_run_desc tomorrow = { ROWS(one), .started = "2026-01-03T00:00:01Z" };
    kit_comparison kit;
    (void)state;
    expect_choice(&kernel, NULL, NULL, "frame_ms", FM_OK);
    expect_choice(&tomorrow, NULL, NULL, "frame_ms / floor", FM_OK);
    expect_choice(&tomorrow, "frame_ms", NULL, "frame_ms", FM_OK);
    expect_choice(&tomorrow, NULL, "none", "frame_ms", FM_OK);
    kit_compare(&kit, &usual, &kernel, NULL);
    assert_int_equal(kit.made.machines.count, 2);
    assert_string_equal(kit.made.machines.differing[0].name, "memory_bytes");
    assert_string_equal(kit.made.machines.differing[1].name, "kernel");
    assert_string_equal(kit.made.machines.differing[1].now, "6.2");
    kit_end(&kit);
}

static void expect_refusal(const char *metric, const char *reference, const char *words)
{
    kit_comparison kit;
    kit_compare(&kit, &usual, &usual, &(fm_quantity_desc){ metric, reference });
    assert_int_equal(kit.status, FM_INVALID);
    if (strstr(kit.err.message, words) == NULL)
        fail_msg("'%s' is not in: %s", words, kit.err.message);
    kit_end(&kit);
}

static void unknown_metrics_and_methods_are_refused_with_the_nearest(void **state)
{
    (void)state;
    expect_refusal("frame_mss", NULL, "the nearest is 'frame_ms'");
    expect_refusal("bytes_allocated", NULL, "not a time of frames");
    expect_refusal("fps", NULL, "not a time of frames"); /* more is better */
    expect_refusal(NULL, "aa", "has no case of that method; the nearest is 'a'");
    expect_refusal("times_floor", "floor", "over the floor already");
}

/* Launches of one machine, one of them twice as slow as the others: within each the ratio is 3. */
static void ratios_to_the_floor_are_taken_within_launches(void **state)
{
    static const char base[] = "c0 0 frame_ms 3\nc0 0 floor_frame_ms 1\n"
                               "c0 1 frame_ms 6\nc0 1 floor_frame_ms 2\n"
                               "c0 2 frame_ms 3\nc0 2 floor_frame_ms 1\nc0 3 frame_ms 9\n";
    static const char now[] = "c0 0 frame_ms 12\nc0 1 frame_ms 6\nc0 0 floor_frame_ms 2\n"
                              "c0 1 floor_frame_ms 1\n";
    const kit_run_desc with_base = { ROWS(one), .samples = base };
    const kit_run_desc with_now = { ROWS(one), .samples = now };
    kit_comparison kit;
    (void)state;
    kit_compare(&kit, &with_base, &with_now, &(fm_quantity_desc){ NULL, "floor" });
    const fm_compared *compared = kit_case(&kit, "c0");
    assert_true(compared->base.median == 3.0 && compared->base.high == 3.0);
    assert_true(compared->now.median == 6.0 && compared->now.low == 6.0);
    assert_true(compared->ratio.median == 2.0);
    assert_int_equal(compared->verdict, FM_COMPARED_SLOWER);
    kit_end(&kit);
}

/* Of two launches the interval is 5.85 times their range to both sides, and it decides. */
static void two_launches_are_judged(void **state)
{
    static const char base[] = "c0 0 frame_ms 10\nc0 1 frame_ms 10.1\n"
                               "c0 0 floor_frame_ms 1\nc0 1 floor_frame_ms 1\n";
    static const char now[] = "c0 0 frame_ms 12\nc0 1 frame_ms 12.1\n"
                              "c0 0 floor_frame_ms 1\nc0 1 floor_frame_ms 1\n";
    static const char wide[] = "c0 0 frame_ms 11\nc0 1 frame_ms 12\n"
                               "c0 0 floor_frame_ms 1\nc0 1 floor_frame_ms 1\n";
    static const char *const two[] = { "k=4;launches=2" };
    const kit_run_desc runs[] = { { ROWS(two), .samples = base },
                                  { ROWS(two), .samples = now },
                                  { ROWS(two), .samples = wide } };
    static const fm_compared_verdict expected[] = { FM_COMPARED_UNCLEAR, FM_COMPARED_SLOWER,
                                                    FM_COMPARED_UNCLEAR };
    (void)state;
    for (int i = 1; i < 3; i++) {
        kit_comparison kit;
        kit_compare(&kit, &runs[0], &runs[i], &(fm_quantity_desc){ NULL, "floor" });
        assert_int_equal(kit_case(&kit, "c0")->verdict, expected[i]);
        kit_end(&kit);
    }
}

/* Many samples cost no more each than few: pairs of these would take a minute. */
static void ratios_to_the_floor_need_one_pass(void **state)
{
    enum { LAUNCHES = 10, FRAMES = 20000 };
    fm_text samples = { 0 };
    kit_comparison kit;
    (void)state;
    for (unsigned i = 0; i < LAUNCHES * FRAMES; i++) /* the floor's in another order */
        text_add(&samples, "c0 %u frame_ms %u\nc0 %u floor_frame_ms %u\n", i / FRAMES,
                 3 * (i % 7 + 1), LAUNCHES - 1 - i / FRAMES, i % 7 + 1);
    const kit_run_desc run = { ROWS(one), .samples = samples.bytes };
    const clock_t start = clock();
    kit_compare(&kit, &run, &run, &(fm_quantity_desc){ NULL, "floor" });
    assert_true(clock() - start < 10 * CLOCKS_PER_SEC);
    const fm_compared *compared = kit_case(&kit, "c0");
    assert_true(compared->base.low == 3.0 && compared->base.high == 3.0);
    assert_int_equal(compared->verdict, FM_COMPARED_SAME);
    kit_end(&kit);
    text_free(&samples);
}

static void ratios_to_a_method_are_of_the_same_workload(void **state)
{
    static const char *const base[] = {
        "method=b;k=4;frame_ms=20;frame_ms_low=20;frame_ms_high=20",
        "k=4;options=x=1 y=2;frame_ms=10;frame_ms_low=10;frame_ms_high=10",
        "k=4;options=x=9 y=2;frame_ms=1;frame_ms_low=1;frame_ms_high=1", /* not at its defaults */
        "k=4;seed=2;frame_ms=1;frame_ms_low=1;frame_ms_high=1",
        "method=b;k=4;seed=3;frame_ms=20;frame_ms_low=20;frame_ms_high=20",
    };
    static const char *const now[] = {
        "method=b;k=4;frame_ms=60;frame_ms_low=60;frame_ms_high=60",
        "k=4;options=x=1 y=2;frame_ms=20;frame_ms_low=20;frame_ms_high=20",
        "k=4;options=x=9 y=2;frame_ms=1;frame_ms_low=1;frame_ms_high=1",
        "k=4;seed=2;frame_ms=1;frame_ms_low=1;frame_ms_high=1",
        "method=b;k=4;seed=3;frame_ms=20;frame_ms_low=20;frame_ms_high=20",
    };
    kit_comparison kit;
    (void)state;
    kit_compare(&kit, &(kit_run_desc){ ROWS(base) }, &(kit_run_desc){ ROWS(now) },
                &(fm_quantity_desc){ NULL, "a" });
    const fm_compared *compared = kit_case(&kit, "c0");
    assert_true(compared->base.median == 2.0 && compared->now.median == 3.0);
    assert_true(compared->ratio.median == 1.5 && compared->ratio.low == 1.5);
    assert_int_equal(kit_case(&kit, "c1")->verdict, FM_COMPARED_SAME);    /* over itself */
    assert_int_equal(kit_case(&kit, "c4")->verdict, FM_COMPARED_UNTIMED); /* no a of seed 3 */
    kit_end(&kit);
}

/* A time with its interval, of NEW; BASE has 10, exactly. */
#define TIME(median, low, high) "frame_ms=" #median ";frame_ms_low=" #low ";frame_ms_high=" #high

static void verdicts_follow_from_interval_and_band(void **state)
{
    static const char *const base[] = {
        "k=1;" TIME(10, 10, 10), "k=2;" TIME(10, 10, 10), "k=3;" TIME(10, 10, 10),
        "k=4;" TIME(10, 10, 10), "k=5;" TIME(10, 10, 10), "k=6;" TIME(10, 10, 10),
        "k=7;" TIME(10, 10, 10), "k=8;" TIME(10, 10, 10), "k=9;" TIME(10, 10, 10),
    };
    static const char *const now[] = {
        "k=1;" TIME(11, 10.5, 11.5),
        "k=2;" TIME(9, 8.5, 9.5),
        "k=3;" TIME(10, 9.9, 10.1),
        "k=4;" TIME(11, 9.9, 12),
        "k=5;" TIME(10.1, 10.05, 10.15), /* certain, and too small to count */
        "k=6;" TIME(10.1, 10.05, 10.5),  /* it may count */
        "k=7;noisy=busy;" TIME(11, 10.5, 11.5),
        "k=8;launches=1;" TIME(20, 20, 20),
        "k=9;status=crash;frame_ms=;frame_ms_low=;frame_ms_high=",
    };
    static const fm_compared_verdict expected[] = {
        FM_COMPARED_SLOWER,  FM_COMPARED_FASTER,  FM_COMPARED_SAME,
        FM_COMPARED_UNCLEAR, FM_COMPARED_SAME,    FM_COMPARED_UNCLEAR,
        FM_COMPARED_UNCLEAR, FM_COMPARED_UNCLEAR, FM_COMPARED_UNTIMED,
    };
    static const char *const order[] = { "c8", "c0", "c7", "c3", "c6", "c5", "c4", "c2", "c1" };
    kit_comparison kit;
    (void)state;
    kit_compare(&kit, &(kit_run_desc){ ROWS(base) }, &(kit_run_desc){ ROWS(now) }, NULL);
    assert_int_equal(kit.made.count, 9);
    for (size_t i = 0; i < 9; i++) {
        char id[8];
        snprintf(id, sizeof id, "c%zu", i);
        if (kit_case(&kit, id)->verdict != expected[i])
            fail_msg("%s is %s", id, compared_verdict_name(kit_case(&kit, id)->verdict));
        assert_string_equal(kit.made.cases[i].pair.base->id, order[i]);
    }
    assert_string_equal(kit_case(&kit, "c6")->why, "NEW's row is noisy");
    assert_string_equal(kit_case(&kit, "c7")->why, "one launch has no interval");
    assert_int_equal(comparison_verdicts(&kit.made, FM_COMPARED_UNCLEAR), 4);
    assert_int_equal(comparison_changed(&kit.made), 1); /* the crash */
    kit_end(&kit);
}

enum { MANY = 1200, MOST_LAUNCHES = 10 };

/* A case whose launches are drawn from measured ones. */
static void draw_row(char row[128], const launch_noise *noise, size_t index, size_t launches,
                     uint64_t *seed)
{
    double values[MOST_LAUNCHES];
    for (size_t i = 0; i < launches; i++)
        values[i] = launch_noise_draw(noise, index % NOISE_CASES, seed);
    const fm_interval interval = stats_interval(values, launches);
    snprintf(row, 128, "seed=%zu;launches=%zu;frame_ms=%.9g;frame_ms_low=%.9g;frame_ms_high=%.9g",
             index, launches, interval.median, interval.low, interval.high);
}

/* Of equal cases at most one of twenty comes out as slower or faster. */
static void equal_runs_are_same_or_unclear(void **state)
{
    static char cells[2][MANY][128];
    static const char *rows[2][MANY];
    static const size_t counts[] = { 2, 3, 5, MOST_LAUNCHES };
    launch_noise noise;
    uint64_t seed = 5;
    (void)state;
    launch_noise_read(&noise);
    for (size_t round = 0; round < sizeof counts / sizeof counts[0]; round++) {
        const size_t launches = counts[round];
        kit_comparison kit;
        for (size_t i = 0; i < (size_t)2 * MANY; i++) {
            draw_row(cells[i / MANY][i % MANY], &noise, i % MANY, launches, &seed);
            rows[i / MANY][i % MANY] = cells[i / MANY][i % MANY];
        }
        kit_compare(&kit, &(kit_run_desc){ ROWS(rows[0]) }, &(kit_run_desc){ ROWS(rows[1]) }, NULL);
        const size_t wrong = comparison_verdicts(&kit.made, FM_COMPARED_SLOWER) +
                             comparison_verdicts(&kit.made, FM_COMPARED_FASTER);
        print_message("%zu launches: %zu of %d equal cases are not\n", launches, wrong, MANY);
        assert_true(wrong <= MANY / 20);
        kit_end(&kit);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cases_are_joined_by_id_and_then_by_name),
        cmocka_unit_test(cases_of_one_name_are_told_apart_by_what_auto_means),
        cmocka_unit_test(cases_of_one_name_are_told_apart_by_n),
        cmocka_unit_test(runs_without_a_common_case_do_not_compare),
        cmocka_unit_test(milliseconds_of_two_machines_are_refused),
        cmocka_unit_test(milliseconds_of_two_devices_are_refused),
        cmocka_unit_test(days_and_kernels_leave_the_machine_the_same),
        cmocka_unit_test(unknown_metrics_and_methods_are_refused_with_the_nearest),
        cmocka_unit_test(ratios_to_the_floor_are_taken_within_launches),
        cmocka_unit_test(two_launches_are_judged),
        cmocka_unit_test(ratios_to_the_floor_need_one_pass),
        cmocka_unit_test(ratios_to_a_method_are_of_the_same_workload),
        cmocka_unit_test(verdicts_follow_from_interval_and_band),
        cmocka_unit_test(equal_runs_are_same_or_unclear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
