/* Every method that hands over the right fragments, on every feed and both devices: 200 random
 * layer scenes and the bunny. FRAGMARK_TEST_SLICE=3/20 runs the third twentieth of the scenes. What
 * fails is printed as the command that shows it. */
#include <stdio.h>
#include <unistd.h>

#include "kit/scene_kit.h"
#include "model/feeds.h"
#include "random_kit.h"

enum { LAYER_SCENES = 200, SCENES = LAYER_SCENES + 1, FAILURES_SHOWN = 20, TRIES = 4 };

#define BUNNY "/usr/share/glmark2/models/bunny.obj"

/* Half of the scenes have about k layers, where methods change what they do; the others rather few
 * than many. */
static uint32_t draw_n(uint64_t *state, uint32_t k)
{
    const uint32_t at = draw_in(state, 0, 4095);
    return draw_in(state, 0, 1) == 0 ? k - 1 + draw_in(state, 0, 2) : at * at / 65504;
}

typedef struct random_scene {
    char texts[320];
    char k[16];
} random_scene;

static void make_random(random_scene *made, uint32_t number)
{
    static const char *const orders[] = { "random", "random-cell", "ascending", "descending",
                                          "cell-major" };
    static const char *const depths[] = { "uniform", "clustered", "coplanar", "ulp", "sloped" };
    uint64_t state = 0x5EED0000u + number;
    const uint32_t k = draw_in(&state, 1, 64), n = draw_n(&state, k);
    const uint32_t width = draw_in(&state, 1, 97), height = draw_in(&state, 1, 61);
    const uint32_t density = draw_in(&state, 1, 10), probability = draw_in(&state, 1, 10);
    const uint32_t tessellation = draw_in(&state, 1, 9), alpha = draw_in(&state, 0, 10);
    snprintf(made->texts, sizeof made->texts,
             "n=%u width_px=%u height_px=%u order=%s depths=%s pixel_density=%u.%u "
             "fragment_probability=%u.%u tessellation=%u alphas=%s alpha=%u.%u seed=%u",
             n, width, height, orders[number % 5], depths[number / 5 % 5], density / 10,
             density % 10, probability / 10, probability % 10, tessellation,
             draw_in(&state, 0, 1) == 0 ? "random" : "constant", alpha / 10, alpha % 10,
             draw_in(&state, 1, 1000000));
    snprintf(made->k, sizeof made->k, "k=%u", k);
    if (number == LAYER_SCENES) {
        snprintf(made->texts, sizeof made->texts,
                 "generator=mesh mesh=" BUNNY " width_px=200 height_px=200");
        snprintf(made->k, sizeof made->k, "k=8");
    }
}

/* `fragmark run ...` of one case. */
static void print_command(const random_scene *scene, const kit_way *way, const char *device)
{
    char copy[420];
    char *rest = NULL;
    const bool is_layers = strncmp(scene->texts, "n=", 2) == 0;
    print_error("  fragmark run --scene %s --method %s --device %s --feed %s",
                is_layers ? "layers" : "bunny", way->method, device, feed_name(way->feed));
    snprintf(copy, sizeof copy, "%s", way->texts);
    for (char *word = strtok_r(copy, " ", &rest); word != NULL; word = strtok_r(NULL, " ", &rest))
        print_error(" -a %s", word);
    snprintf(copy, sizeof copy, "%s", scene->texts);
    for (char *word = strtok_r(copy, " ", &rest); word != NULL; word = strtok_r(NULL, " ", &rest))
        if (is_layers || strstr(word, "_px") != NULL)
            print_error(" -a %s", word);
    print_error(" -a launches=1\n");
}

/* A thread that owns a lock of a software rasteriser may be suspended longer than others wait for
 * it: what is lost then is counted, and the case is tried again. */
static fm_status try_again_if_lossy(fm_measurement *m, kit_scene *scene, const kit_way *way,
                                    fm_error *err)
{
    fm_status status = kit_try(m, scene, way, true, err);
    for (int i = 1; i < TRIES && status == FM_OK && m->lost != 0; i++) {
        measurement_free(m);
        status = kit_try(m, scene, way, true, err);
    }
    return status;
}

/* Empty: right, or not supported; else what is wrong. */
static void measure_one(char wrong[600], kit_scene *scene, const kit_way *way)
{
    fm_measurement m;
    fm_error err = { .message = "" };
    const fm_status status = try_again_if_lossy(&m, scene, way, &err);
    const fm_check *check = &m.check;
    wrong[0] = '\0';
    if (status != FM_OK && status != FM_UNSUPPORTED)
        snprintf(wrong, 600, "%.590s", err.message);
    else if (status == FM_OK && check->missing + check->extra + check->misordered + m.lost != 0)
        snprintf(wrong, 600, "missing %u, extra %u, misordered %u, lost %u in %u pixels",
                 (unsigned)check->missing, (unsigned)check->extra, (unsigned)check->misordered,
                 (unsigned)m.lost, (unsigned)check->wrong_pixels);
    else if (status == FM_OK && !(m.self_max_abs <= image_rounding(scene->truth->n)))
        snprintf(wrong, 600, "the image is %.3g from its fragments", m.self_max_abs);
    else if (status == FM_OK && !(m.error.region[FM_REGION_VIEWPORT].difference.max_abs <=
                                  image_rounding(scene->truth->n)))
        snprintf(wrong, 600, "the image is %.3g from what truth allows",
                 m.error.region[FM_REGION_VIEWPORT].difference.max_abs);
    else if (status == FM_OK && m.bytes_allocated != m.bytes_predicted)
        snprintf(wrong, 600, "%llu bytes allocated, %llu predicted",
                 (unsigned long long)m.bytes_allocated, (unsigned long long)m.bytes_predicted);
    measurement_free(&m);
}

typedef struct outcomes {
    const char *device;
    unsigned measured, failed;
} outcomes;

static void measure_all(outcomes *seen, kit_scene *scene, const random_scene *from)
{
    const bool any_ties = kit_has_ties(scene->truth);
    char wrong[600], where[256];
    for (size_t i = 0; i < scene->kit->plugins.count; i++) {
        const fm_method_desc *method = kit_method(scene->kit, i);
        for (uint32_t feed = FM_FEED_RASTER; feed <= FM_FEED_TRIANGLES; feed <<= 1) {
            char texts[96];
            kit_memory_in_turn(texts, from->k, method, seen->measured);
            const kit_way way = { .method = method->id, .feed = feed, .texts = texts };
            if ((kit_feeds(method) & feed) == 0 || !kit_is_right(method, any_ties))
                continue;
            measure_one(wrong, scene, &way);
            seen->measured++;
            if (wrong[0] == '\0' || seen->failed++ >= FAILURES_SHOWN)
                continue;
            kit_tell(where, &way);
            print_error("%s: %s\n", where, wrong);
            print_command(from, &way, seen->device);
        }
    }
}

/* True: the scene belongs to the slice; without the variable all do. */
static bool is_in_slice(uint32_t number)
{
    const char *text = getenv("FRAGMARK_TEST_SLICE");
    unsigned slice = 1, slices = 1;
    if (text != NULL && (sscanf(text, "%u/%u", &slice, &slices) != 2 || slices == 0 || slice == 0 ||
                         slice > slices))
        fail_msg("FRAGMARK_TEST_SLICE=%s: not like 3/20", text);
    return number % slices == slice - 1;
}

static bool is_there(uint32_t number)
{
    if (number != LAYER_SCENES || access(BUNNY, R_OK) == 0)
        return true;
    print_message("skipped: %s is not there\n", BUNNY);
    return false;
}

static void check_slice(void **state, const char *device)
{
    scene_kit kit;
    random_scene from;
    outcomes seen = { .device = device };
    kit_open(&kit, device_of(state));
    for (uint32_t number = 0; number < SCENES; number++) {
        kit_scene scene;
        if (!is_in_slice(number) || !is_there(number))
            continue;
        make_random(&from, number);
        kit_scene_open(&scene, &kit, from.texts);
        measure_all(&seen, &scene, &from);
        kit_scene_close(&scene);
    }
    kit_close(&kit);
    print_message("%u measured, %u failed\n", seen.measured, seen.failed);
    assert_int_equal(seen.failed, 0);
}

static void methods_are_exact_on_random_scenes_by_vulkan(void **state)
{
    check_slice(state, "vulkan");
}

static void methods_are_exact_on_random_scenes_by_osmesa(void **state)
{
    check_slice(state, "osmesa");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(methods_are_exact_on_random_scenes_by_vulkan, open_vulkan,
                                        close_opened),
        cmocka_unit_test_setup_teardown(methods_are_exact_on_random_scenes_by_osmesa, open_osmesa,
                                        close_opened),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
