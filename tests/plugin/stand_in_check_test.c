/* Descriptors of plugins with resources that hang on an option: what is refused, in which words. */
#include "check_kit.h"

enum { COUNTS, RECORDS, STAND_IN };
enum { CLEAR, STORE, SPREAD, RESOLVE };

/* A buffer `records` that the passes use, and behind it the image that layout=layer-major puts in
 * its place. */
static fm_method_desc with_stand_in(void)
{
    return (fm_method_desc){
        .abi = FM_ABI,
        .size_bytes = sizeof(fm_method_desc),
        .id = "sound",
        .title = "Sound",
        .citation = "none",
        .version = "1",
        .options = { { .name = "layout", .values = { "pixel", "layer-major" } },
                     { .name = "pages", .values = { "4", "8" } } },
        .resources = { { .name = "counts", .extent = { .per_pixel = 1 } },
                       { .name = "records",
                         .element = FM_ELEMENT_UVEC2,
                         .extent = { .per_pixel_k = 1 } },
                       { .name = "records",
                         .kind = FM_RESOURCE_IMAGE,
                         .format = FM_FORMAT_RG32UI,
                         .extent = { .per_pixel_k = 1 },
                         .when_option = "layout",
                         .when_value = "layer-major" } },
        .totals = { { .name = "stored", .resource = "counts", .sum = true, .pass = "store" } },
        .passes = { { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "counts", "records" } },
                    { .name = "store", .shader = "store.glsl", .writes = { "counts", "records" } },
                    { .name = "spread", .kind = FM_PASS_TILES, .shader = "spread.glsl" },
                    { .name = "resolve",
                      .kind = FM_PASS_PIXELS,
                      .shader = "resolve.glsl",
                      .reads = { "counts", "records" },
                      .emits = true } },
    };
}

/* The same with two pools, of words and of nodes: what is counted without room are elements of the
 * one that is there. */
static fm_method_desc with_pools(void)
{
    fm_method_desc m = with_stand_in();
    m.resources[RECORDS] = (fm_resource){ .name = "records",
                                          .extent = { .per_pixel = 3 },
                                          .sizing = FM_SIZE_GROW,
                                          .overflow = "stored",
                                          .grown = { .per_fragment = 3 } };
    m.resources[STAND_IN] = m.resources[RECORDS];
    m.resources[STAND_IN].element = FM_ELEMENT_UVEC4;
    m.resources[STAND_IN].extent.per_pixel = 1;
    m.resources[STAND_IN].grown.per_fragment = 1;
    m.resources[STAND_IN].when_option = "layout";
    m.resources[STAND_IN].when_value = "layer-major";
    m.totals[1] = (fm_total){ .name = "other", .resource = "counts", .sum = true, .pass = "store" };
    return m;
}

/* CHANGE works on `m`, a sound descriptor. */
#define REFUSES(CHANGE, MESSAGE)                                                                   \
    do {                                                                                           \
        fm_method_desc m = with_stand_in();                                                        \
        CHANGE;                                                                                    \
        assert_check_fails(&m, MESSAGE);                                                           \
    } while (0)

static void plugin_check_takes_a_stand_in(void **state)
{
    (void)state;
    fm_error err = { .message = "" };
    fm_method_desc m = with_stand_in();
    if (plugin_check(&m, "test", &err) != FM_OK)
        fail_msg("%s", err.message);
    m.resources[STAND_IN + 1] = m.resources[STAND_IN]; /* one for each value, and one for none */
    m.resources[STAND_IN + 1].when_value = "pixel";
    if (plugin_check(&m, "test", &err) != FM_OK)
        fail_msg("%s", err.message);
}

static void plugin_check_takes_pools_that_grow_alike(void **state)
{
    (void)state;
    fm_error err = { .message = "" };
    const fm_method_desc m = with_pools();
    if (plugin_check(&m, "test", &err) != FM_OK)
        fail_msg("%s", err.message);
}

static void plugin_check_rejects_pools_that_do_not(void **state)
{
    (void)state;
    static const char message[] = "need a fixed size or one overflow";
    fm_method_desc m = with_pools();
    m.resources[STAND_IN].overflow = "other";
    assert_check_fails(&m, message);
    m = with_pools();
    m.resources[STAND_IN] = (fm_resource){ .name = "records",
                                           .extent = { .per_pixel = 1 },
                                           .when_option = "layout",
                                           .when_value = "layer-major" };
    assert_check_fails(&m, message);
    m = with_pools();
    m.resources[RECORDS] = (fm_resource){ .name = "records", .extent = { .per_pixel = 1 } };
    assert_check_fails(&m, message);
    m = with_pools();
    m.resources[RECORDS].overflow = NULL;
    assert_check_fails(&m, "sizing that grows: needs overflow");
    m.resources[COUNTS] = m.resources[STAND_IN]; /* what it replaces is checked behind it */
    m.resources[STAND_IN] = (fm_resource){ .name = "counts", .extent = { .per_pixel = 1 } };
    assert_check_fails(&m, message);
    m = with_pools();
    for (int i = RECORDS; i <= STAND_IN; i++) {
        m.resources[i].sizing = FM_SIZE_AFTER_TOTAL;
        m.resources[i].overflow = NULL;
        m.resources[i].grown = (fm_extent){ 0 };
        m.resources[i].extent = (fm_extent){ .per_total = 1, .total = "stored" };
    }
    assert_check_fails(&m, message);
}

static void plugin_check_rejects_bad_conditions(void **state)
{
    (void)state;
    REFUSES(m.resources[STAND_IN].when_option = NULL, "'records' is there twice");
    REFUSES(m.resources[STAND_IN].when_value = NULL, "'records' is there twice");
    REFUSES(m.resources[COUNTS].when_value = "pixel", "when_value 'pixel': needs when_option");
    REFUSES(m.resources[COUNTS].when_option = "layout", "when_option 'layout': needs when_value");
    REFUSES(m.resources[STAND_IN].when_option = "layot",
            "resource 'records': when_option 'layot': no such option; nearest is 'layout'");
    REFUSES(m.resources[STAND_IN].when_value = "image",
            "when_value 'image': option 'layout' has no such value");
    REFUSES(m.resources[STAND_IN].name = "recorded", "no resource of this name without");
    REFUSES((m.resources[STAND_IN + 1] = m.resources[STAND_IN]),
            "when_value 'layer-major' is there twice");
    REFUSES((m.resources[STAND_IN + 1] = m.resources[STAND_IN],
             m.resources[STAND_IN + 1].when_option = "pages",
             m.resources[STAND_IN + 1].when_value = "8"),
            "when_option 'pages': another one has 'layout'");
}

/* What is sized, shared, counted or drawn into is always the same resource. */
static void plugin_check_rejects_stand_ins_that_others_lean_on(void **state)
{
    (void)state;
    REFUSES(m.resources[RECORDS].ping_pong = true, "need a fixed size");
    REFUSES(m.resources[STAND_IN].ping_pong = true, "need a fixed size");
    REFUSES((m.resources[RECORDS].sizing = FM_SIZE_GROW, m.resources[RECORDS].overflow = "stored"),
            "need a fixed size");
    REFUSES(
        (m.resources[STAND_IN + 1] =
             (fm_resource){ .name = "sharer", .extent = { .constant = 2 }, .shares = "records" }),
        "when_option: 'sharer' shares its memory");
    REFUSES((m.resources[RECORDS].element = FM_ELEMENT_UINT, m.totals[0].resource = "records"),
            "resource 'records': with another value of 'layout' it is another resource");
    REFUSES(m.passes[STORE].targets[0].resource = "records",
            "'records': with another value of 'layout'");
    REFUSES(m.passes[STORE].state.depth_stencil = "records",
            "'records': with another value of 'layout'");
    REFUSES((m.passes[SPREAD].kind = FM_PASS_INDIRECT, m.passes[SPREAD].indirect = "records"),
            "indirect 'records': with another value of 'layout'");
    REFUSES(m.resources[STAND_IN].samples = 4,
            "writes 'records': shaders store into colour images of one sample only");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plugin_check_takes_a_stand_in),
        cmocka_unit_test(plugin_check_takes_pools_that_grow_alike),
        cmocka_unit_test(plugin_check_rejects_pools_that_do_not),
        cmocka_unit_test(plugin_check_rejects_bad_conditions),
        cmocka_unit_test(plugin_check_rejects_stand_ins_that_others_lean_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
