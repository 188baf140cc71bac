/* Techniques of the simulated GPU: what is refused of their descriptors, and in which words. */
#include "check_kit.h"
#include "fragmark/technique.h"

static fm_method_desc technique_method(const fm_technique *technique)
{
    return (fm_method_desc){
        .abi = FM_ABI,
        .size_bytes = sizeof(fm_method_desc),
        .id = "sound-3",
        .title = "Sound",
        .citation = "none",
        .version = "1",
        .feeds = FM_FEED_FRAMES,
        .keeps = FM_KEEPS_NEAREST,
        .options = { { .name = "tie", .values = { "exact", "paper" } } },
        .technique = technique,
    };
}

static fm_prediction see_all(const fm_pair *pair)
{
    (void)pair;
    return FM_VISIBLE;
}

static bool skip_none(const fm_tile_start *tile)
{
    (void)tile;
    return false;
}

static void plugin_check_takes_a_sound_technique(void **state)
{
    (void)state;
    const fm_technique technique = { .parts = FM_PART_VISIBILITY | FM_PART_SIGNATURES,
                                     .choices = { { "tie", "exact", FM_PART_EXACT_TIES } },
                                     .predict = see_all,
                                     .skip = skip_none };
    const fm_method_desc m = technique_method(&technique);
    fm_error err = { 0 };
    if (plugin_check(&m, "x.so", &err) != FM_OK)
        fail_msg("%s", err.message);
}

/* CHANGE works on `m` and its technique `t`. */
#define REFUSES_TECHNIQUE(CHANGE, MESSAGE)                                                         \
    do {                                                                                           \
        fm_technique t = { 0 };                                                                    \
        fm_method_desc m = technique_method(&t);                                                   \
        CHANGE;                                                                                    \
        assert_check_fails(&m, MESSAGE);                                                           \
    } while (0)

static void plugin_check_rejects_bad_techniques(void **state)
{
    (void)state;
    REFUSES_TECHNIQUE((m.feeds |= FM_FEED_RASTER, m.technique = NULL), "methods with a technique");
    REFUSES_TECHNIQUE(m.feeds |= FM_FEED_RASTER, "'frames' alone");
    REFUSES_TECHNIQUE(m.passes[0].name = "store", "are for methods of passes");
    REFUSES_TECHNIQUE(m.keeps = FM_KEEPS_ALL, "keeps");
    REFUSES_TECHNIQUE(t.parts = 1u << 31, "parts: unknown bits 0x80000000");
    REFUSES_TECHNIQUE(t.choices[0].option = "ties", "choices[0]: option 'ties'");
    REFUSES_TECHNIQUE(t.choices[1] = ((fm_part_choice){ "tie", "maybe", 0 }), "no value 'maybe'");
    REFUSES_TECHNIQUE(t.choices[1] = ((fm_part_choice){ "tie", "paper", 1u << 30 }), "unknown");
    REFUSES_TECHNIQUE(t.predict = see_all, "predict: needs FM_PART_VISIBILITY");
    REFUSES_TECHNIQUE(t.skip = skip_none, "skip: needs FM_PART_SIGNATURES");
    REFUSES_TECHNIQUE(t.parts = FM_PART_TAINT, "taint needs");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plugin_check_takes_a_sound_technique),
        cmocka_unit_test(plugin_check_rejects_bad_techniques),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
