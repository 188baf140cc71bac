/* A method that declares a loss is not wrong for it, and is wrong for any other: scenes with layers
 * at depth exactly 1.0 and at equal depths, methods whose traits a test takes away or adds. */
#include <stdio.h>
#include <unistd.h>

#include "base/text.h"
#include "generators/generate.h"
#include "kit/scene_kit.h"
#include "worker/verdict.h"

enum { FRAME_WIDTH = 5, FRAME_HEIGHT = 4, QUADS_MAX = 4 };

/* Quads in order of arrival; those without pixels end the list. */
typedef struct quad {
    fm_rect px;
    float depth;
} quad;

#define WHOLE 0, 0, FRAME_WIDTH, FRAME_HEIGHT
#define SIX   1, 1, 4, 3

static const quad far_and_near[QUADS_MAX] = { { { WHOLE }, 1.0f }, { { SIX }, 0.5f } };
static const quad nearly_far[QUADS_MAX] = { { { WHOLE }, 0x1.fffffep-1f } };
static const quad far_and_tied[QUADS_MAX] = {
    { { WHOLE }, 1.0f }, { { SIX }, 0.5f }, { { WHOLE }, 0.25f }, { { WHOLE }, 0.25f }
};

static void declare_nothing_lost(fm_method_desc *method)
{
    method->traits &= ~(uint32_t)(FM_TRAIT_LOSES_DEPTH_ONE | FM_TRAIT_LOSES_TIES);
    method->traits |= FM_TRAIT_EXACT;
}

static void declare_depth_one(fm_method_desc *method)
{
    declare_nothing_lost(method);
    method->traits |= FM_TRAIT_LOSES_DEPTH_ONE;
}

static void declare_both(fm_method_desc *method)
{
    declare_depth_one(method);
    method->traits |= FM_TRAIT_LOSES_TIES;
}

/* edit: the traits with which the method runs; NULL: its own. */
typedef struct expected {
    const quad *quads;
    const char *method;
    void (*edit)(fm_method_desc *method);
    bool is_wrong;
    const char *says; /* of the loss, or why it is wrong; "": nothing */
} expected;

static const expected table[] = {
    { far_and_near, "z-buffer", NULL, false, "declared loss: 14 fragments at depth 1" },
    { far_and_near, "z-buffer", declare_nothing_lost, true, "declared exact, but missing 14," },
    { far_and_near, "exact", NULL, false, "" },
    { nearly_far, "z-buffer", NULL, false, "" },
    { nearly_far, "f2b", declare_depth_one, false, "" },
    { far_and_tied, "z-buffer", NULL, false, "" },
    { far_and_tied, "f2b", NULL, false,
      "declared loss: 20 fragments at depth 1, 20 of equal depths" },
    { far_and_tied, "f2b", declare_both, false,
      "declared loss: 20 fragments at depth 1, 20 of equal depths" },
    { far_and_tied, "f2b", declare_depth_one, true, "declared exact, but missing 20," },
    { far_and_tied, "f2b", declare_nothing_lost, true, "declared exact, but missing 40," },
};

static void take_quads(kit_scene *scene, scene_kit *kit, const quad quads[QUADS_MAX])
{
    uint32_t count = 0;
    while (count < QUADS_MAX && quads[count].px.x1 > 0)
        count++;
    fm_scene *made = kit_quads_create(FRAME_WIDTH, FRAME_HEIGHT, count);
    for (uint32_t i = 0; i < count; i++)
        kit_quad(made, i, quads[i].px, quads[i].depth, 0x80000000u + 16 * i);
    kit_scene_take(scene, kit, made);
}

static uint32_t traits_of(const scene_kit *kit, const expected *row)
{
    fm_method_desc method = *plugin_list_find(&kit->plugins, row->method)->plugin->method;
    if (row->edit != NULL)
        row->edit(&method);
    return method.traits;
}

static void expect(kit_scene *scene, const expected *row)
{
    const kit_way way = { row->method, FM_FEED_RASTER, "k=8" };
    char loss[VERDICT_LOSS_BYTES] = "";
    fm_error why = { .message = "" };
    fm_measurement m;
    scene->edit = row->edit;
    if (!kit_has(scene->kit, row->method))
        return;
    if (kit_measure(&m, scene, &way)) {
        const bool wrong =
            verdict_is_wrong(&why, &m, traits_of(scene->kit, row), kit_truth(scene, way.feed)->n);
        const bool has_loss = verdict_loss(loss, &m.check);
        const char *says = wrong ? why.message : has_loss ? loss : "";
        if (wrong != row->is_wrong || strstr(says, row->says) == NULL ||
            (row->says[0] == '\0' && says[0] != '\0'))
            fail_msg("%s: wrong %d, '%s', not %d, '%s'", row->method, wrong, says, row->is_wrong,
                     row->says);
    }
    measurement_free(&m);
}

static void declared_losses_are_excused_and_no_others(void **state)
{
    scene_kit kit;
    kit_open(&kit, device_of(state));
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        kit_scene scene;
        take_quads(&scene, &kit, table[i].quads);
        expect(&scene, &table[i]);
        kit_scene_close(&scene);
    }
    kit_close(&kit);
}

/* A plane at z = -4 fills the view, where the far plane is; before it lies a triangle. */
static fm_scene *make_far_plane(void)
{
    static const char mesh[] = "v -9 -9 -4\nv 9 -9 -4\nv 9 9 -4\nv -9 9 -4\nv -1 -1 -2\nv 1 -1 -2\n"
                               "v 1 1 -2\nf 1 2 3\nf 1 3 4\nf 5 6 7\n";
    static const struct {
        const char *key, *value;
    } view[] = { { "generator", "mesh" }, { "width_px", "8" },    { "height_px", "8" },
                 { "eye", "0 0 0" },      { "target", "0 0 -1" }, { "fov_deg", "90" },
                 { "near_plane", "1" },   { "far_plane", "4" } };
    char path[] = "/tmp/fragmark-far-XXXXXX.obj";
    fm_settings settings;
    fm_scene *made = NULL;
    fm_error err = { .message = "" };
    close(mkstemps(path, 4));
    assert_int_equal(text_write_file(path, mesh, sizeof mesh - 1, NULL), FM_OK);
    settings_default(&settings);
    for (size_t i = 0; i < sizeof view / sizeof view[0]; i++)
        if (settings_set(&settings, key_find(view[i].key), view[i].value, &err) != FM_OK)
            fail_msg("%s", err.message);
    if (settings_set(&settings, key_find("mesh"), path, &err) != FM_OK ||
        settings_finish(&settings, &err) != FM_OK || scene_create(&made, &settings, &err) != FM_OK)
        fail_msg("%s", err.message);
    unlink(path);
    return made;
}

static void a_mesh_on_the_far_plane_is_a_declared_loss(void **state)
{
    static const expected rows[] = {
        { NULL, "z-buffer", NULL, false, "fragments at depth 1" },
        { NULL, "z-buffer", declare_nothing_lost, true, "declared exact, but missing" },
        { NULL, "f2b", declare_depth_one, false, "declared loss: 64 fragments at depth 1" },
        { NULL, "exact", NULL, false, "" },
    };
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_take(&scene, &kit, make_far_plane());
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        expect(&scene, &rows[i]);
    kit_scene_close(&scene);
    kit_close(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(declared_losses_are_excused_and_no_others),
        ON_VULKAN_AND_OSMESA(a_mesh_on_the_far_plane_is_a_declared_loss),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
