#include "scene_kit.h"
#include "capture/truth_capture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "generators/generate.h"
#include "model/feeds.h"
#include "plan/plan_case.h"
#include "plugin/culling_apply.h"

void kit_open(scene_kit *kit, fm_device *device)
{
    fm_error err = { .message = "" };
    *kit = (scene_kit){ .device = device };
    if (plugin_list_open(&kit->plugins, NULL, &err) != FM_OK ||
        plugin_list_read_all(&kit->plugins, &err) != FM_OK)
        fail_msg("%s", err.message);
}

void kit_close(scene_kit *kit)
{
    if (kit->broken[0] != '\0') {
        char command[64];
        snprintf(command, sizeof command, "rm -r '%s'", kit->broken);
        assert_int_equal(system(command), 0);
    }
    plugin_list_close(&kit->plugins);
}

static void replace_once(const char *path, const kit_mistake *mistake)
{
    enum { LIMIT_BYTES = 1 << 20 };
    char *bytes = NULL;
    size_t count;
    fm_text edited = { .bytes = NULL };
    assert_int_equal(text_read_file(&bytes, &count, path, LIMIT_BYTES, NULL), FM_OK);
    const char *found = strstr(bytes, mistake->right);
    if (found == NULL)
        fail_msg("%s: no '%s' to break", mistake->file, mistake->right);
    text_add(&edited, "%.*s%s%s", (int)(found - bytes), bytes, mistake->wrong,
             found + strlen(mistake->right));
    assert_false(edited.failed);
    assert_int_equal(text_write_file(path, edited.bytes, edited.length, NULL), FM_OK);
    text_free(&edited);
    free(bytes);
}

void kit_break(scene_kit *kit, const kit_mistake *mistake)
{
    char path[FM_PATH_MAX_BYTES], command[FM_PATH_MAX_BYTES + 64];
    snprintf(kit->broken, sizeof kit->broken, "/tmp/fm-shaders-XXXXXX");
    assert_non_null(mkdtemp(kit->broken));
    snprintf(command, sizeof command, "cp -L '%s'/*.glsl '%s'", kit->plugins.common_folder,
             kit->broken);
    assert_int_equal(system(command), 0);
    snprintf(path, sizeof path, "%s/%s", kit->broken, mistake->file);
    replace_once(path, mistake);
    snprintf(kit->plugins.common_folder, sizeof kit->plugins.common_folder, "%s", kit->broken);
}

const fm_method_desc *kit_method(const scene_kit *kit, size_t index)
{
    const fm_plugin_entry *entry = &kit->plugins.entries[index];
    if (entry->plugin == NULL)
        fail_msg("%s: %s", entry->id, entry->error.message);
    return entry->plugin->method;
}

static bool takes_locks(const fm_method_desc *method)
{
    for (size_t i = 0; i < FM_MAX_PASSES && method->passes[i].name != NULL; i++)
        if (method->passes[i].exclusive)
            return true;
    return false;
}

uint32_t kit_feeds(const fm_method_desc *method)
{
    if (getenv("FRAGMARK_TEST_LOCKS") != NULL && !takes_locks(method))
        return 0;
    return (method->feeds != 0 ? method->feeds : FM_FEEDS_FRAGMENTS) &
           (FM_FEEDS_FRAGMENTS | FM_FEED_TRIANGLES);
}

bool kit_has(const scene_kit *kit, const char *method)
{
    const bool has = plugin_list_find(&kit->plugins, method) != NULL;
    if (!has)
        print_message("skipped: %s: plugin not found\n", method);
    return has;
}

bool kit_is_right(const fm_method_desc *method, bool any_ties)
{
    const uint32_t other = FM_TRAIT_SORTED_INPUT | FM_TRAIT_RACY | FM_TRAIT_APPROXIMATE;
    const uint32_t traits = method->traits;
    return (traits & FM_TRAIT_EXACT) != 0 ||
           (!any_ties && (traits & FM_TRAIT_LOSES_TIES) != 0 && (traits & other) == 0);
}

bool kit_races(const scene_kit *kit, const fm_method_desc *method, uint32_t feed)
{
    return (method->traits & FM_TRAIT_RACY) != 0 &&
           (feed != FM_FEED_RASTER || !kit->device->caps.is_software);
}

/* Sets keys; what is no key becomes a choice of the method's, if there is room for choices. */
static void apply(fm_settings *settings, fm_choice *choices, size_t *count, const char *texts)
{
    char copy[512];
    char *rest = NULL;
    fm_error err = { .message = "" };
    snprintf(copy, sizeof copy, "%s", texts);
    for (char *word = strtok_r(copy, " ", &rest); word != NULL; word = strtok_r(NULL, " ", &rest)) {
        char *value = strchr(word, '=');
        if (value == NULL)
            fail_msg("'%s' is not KEY=VALUE", word);
        *value++ = '\0';
        const fm_key *key = key_find(word);
        if (key == NULL && choices != NULL && *count < FM_MAX_OPTIONS) {
            snprintf(choices[*count].name, sizeof choices->name, "%s", word);
            snprintf(choices[*count].value, sizeof choices->value, "%s", value);
            ++*count;
        } else if (key == NULL || settings_set(settings, key, value, &err) != FM_OK) {
            fail_msg("%s: %s", word, key == NULL ? "no such key" : err.message);
        }
    }
}

/* The file is gone once it is open: a test that is killed leaves nothing behind. */
static void capture(fm_truth **truth, const kit_scene *scene, uint32_t feed)
{
    fm_error err = { .message = "" };
    char path[] = "/tmp/fm-truth-XXXXXX";
    const char *common = scene->kit->plugins.common_folder;
    const fm_shader_folders folders = { .method = common, .common = common };
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    close(fd);
    if (truth_capture(path, scene->kit->device, scene->scene, feed, &folders, &err) != FM_OK)
        fail_msg("%s", err.message);
    const fm_status status = truth_open(truth, path, &err);
    unlink(path);
    if (status != FM_OK)
        fail_msg("%s", err.message);
}

void kit_scene_take(kit_scene *scene, scene_kit *kit, fm_scene *made)
{
    *scene = (kit_scene){ .kit = kit, .scene = made };
    capture(&scene->truth, scene, FM_FEED_RASTER);
}

const fm_truth *kit_truth(kit_scene *scene, uint32_t feed)
{
    fm_error err = { .message = "" };
    if (feed != FM_FEED_TRIANGLES)
        return scene->truth;
    if (scene->triangles == NULL && scene_hold(scene->scene, &err) != FM_OK)
        fail_msg("%s", err.message);
    if (scene->triangles == NULL)
        capture(&scene->triangles, scene, feed);
    return scene->triangles;
}

void kit_scene_open(kit_scene *scene, scene_kit *kit, const char *texts)
{
    fm_settings settings;
    fm_error err = { .message = "" };
    fm_scene *made = NULL;
    settings_default(&settings);
    apply(&settings, NULL, NULL, texts);
    if (settings_finish(&settings, &err) != FM_OK || scene_create(&made, &settings, &err) != FM_OK)
        fail_msg("%s: %s", texts, err.message);
    kit_scene_take(scene, kit, made);
}

void kit_scene_close(kit_scene *scene)
{
    truth_close(scene->truth);
    truth_close(scene->triangles);
    scene_destroy(scene->scene);
}

bool kit_wants_all(void)
{
    return getenv("FRAGMARK_TEST_ALL") != NULL;
}

bool kit_has_ties(const fm_truth *truth)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    for (uint64_t pixel = 0; pixel < pixels; pixel++)
        for (uint64_t i = truth->offsets[pixel] + 1; i < truth->offsets[pixel + 1]; i++)
            if (!(truth->fragments[i - 1].depth < truth->fragments[i].depth))
                return true;
    return false;
}

/* One value of an option, if the method has it, behind the texts. */
static void add_in_turn(char texts[96], const fm_method_desc *method, const char *name,
                        size_t number)
{
    const fm_option *option = option_find(method, name);
    const size_t used = strlen(texts);
    size_t count = 0;
    while (option != NULL && count < FM_MAX_OPTION_VALUES && option->values[count] != NULL)
        count++;
    if (count > 0)
        assert_true((size_t)snprintf(texts + used, 96 - used, " %s=%s", name,
                                     option->values[number % count]) < 96 - used);
}

void kit_memory_in_turn(char texts[96], const char *given, const fm_method_desc *method,
                        size_t number)
{
    snprintf(texts, 96, "%s", given);
    for (size_t i = 0; i < AUTO_OPTION_COUNT; i++)
        add_in_turn(texts, method, auto_options[i].name, number);
    add_in_turn(texts, method, "count_in", number);
}

void kit_tell(char text[256], const kit_way *way)
{
    snprintf(text, 256, "%s, %s, %s", way->method, feed_name(way->feed), way->texts);
}

static void fill_desc(fm_instance_desc *desc, const kit_scene *scene, const fm_truth *truth,
                      const fm_plugin *plugin, const fm_settings *settings)
{
    const uint32_t places = measure_places(plugin->method, settings->k);
    *desc = (fm_instance_desc){
        .method = plugin->method,
        .folders = { .method = plugin->folder, .common = scene->kit->plugins.common_folder },
        .settings = settings,
        .fragments = truth->fragment_count,
        .fragments_kept = truth_kept(truth, places),
    };
}

/* The texts of a way, as a method takes them. */
typedef struct asked_case {
    fm_settings settings;
    fm_choice choices[FM_MAX_OPTIONS]; /* all of the method's options */
    fm_method_desc method;             /* with culling, if asked for */
    fm_instance_desc desc;
    fm_stage *stage;
} asked_case;

static fm_status ask(asked_case *asked, kit_scene *scene, const kit_way *way, fm_error *err)
{
    const fm_plugin_entry *entry = plugin_list_find(&scene->kit->plugins, way->method);
    const fm_truth *truth = kit_truth(scene, way->feed);
    fm_choice given[FM_MAX_OPTIONS];
    size_t choice_count = 0;
    if (entry == NULL || entry->plugin == NULL)
        fail_msg("%s: %s", way->method, entry == NULL ? "plugin not found" : entry->error.message);
    asked->settings = scene->scene->settings;
    asked->settings.buffers = FM_BUFFERS_AUTO;
    apply(&asked->settings, given, &choice_count, way->texts);
    for (size_t i = 0; i < choice_count; i++)
        if (option_find(entry->plugin->method, given[i].name) == NULL)
            fail_msg("%s has no option '%s'", way->method, given[i].name);
    if (!plugin_has_k(entry->plugin->method))
        asked->settings.k = 0;
    scene->scene->settings.buffers = asked->settings.buffers;
    fill_desc(&asked->desc, scene, truth, entry->plugin, &asked->settings);
    asked->desc.choices = given;
    asked->desc.choice_count = choice_count;
    fm_status status =
        stage_create(&asked->stage, scene->kit->device, scene->scene, truth, way->feed, err);
    if (status != FM_OK)
        return status;
    if (scene->told_n != 0)
        asked->stage->n = scene->told_n;
    asked->desc.stage = asked->stage;
    asked->desc.choice_count = instance_choices(asked->choices, &asked->desc);
    asked->desc.choices = asked->choices;
    asked->desc.method = &asked->method;
    const fm_culling_desc culling = { .settings = &asked->settings,
                                      .choices = asked->choices,
                                      .choice_count = asked->desc.choice_count,
                                      .n = asked->stage->n,
                                      .feed = way->feed };
    status = culling_apply(&asked->method, entry->plugin->method, &culling, err);
    if (status == FM_OK && scene->edit != NULL)
        scene->edit(&asked->method);
    return status;
}

fm_status kit_try(fm_measurement *measurement, kit_scene *scene, const kit_way *way, bool check,
                  fm_error *err)
{
    asked_case asked = { .stage = NULL };
    fm_instance_desc floor_desc;
    const fm_plugin *floor;
    *measurement = (fm_measurement){ .samples = NULL };
    fm_status status = ask(&asked, scene, way, err);
    if (plugin_list_floor(&floor, &scene->kit->plugins, way->feed, err) != FM_OK)
        fail_msg("%s", err->message);
    fill_desc(&floor_desc, scene, kit_truth(scene, way->feed), floor, &asked.settings);
    floor_desc.stage = asked.stage;
    const fm_measure_desc desc = { .method = &asked.desc,
                                   .floor = &floor_desc,
                                   .truth = kit_truth(scene, way->feed),
                                   .frames = 1,
                                   .warmup = 1,
                                   .check = check };
    if (status == FM_OK)
        status = measure_case(measurement, &desc, err);
    stage_destroy(asked.stage);
    return status;
}

fm_status kit_build(kit_scene *scene, const kit_way *way, bool is_capture, fm_error *err)
{
    asked_case asked = { .stage = NULL };
    fm_instance *instance = NULL;
    fm_status status = ask(&asked, scene, way, err);
    asked.desc.is_capture = is_capture;
    asked.desc.capture_slots = is_capture ? asked.stage->n + 1 : 0;
    if (status == FM_OK && is_capture)
        status = stage_create_capture(asked.stage,
                                      (uint64_t)scene->scene->width_px * scene->scene->height_px,
                                      asked.desc.capture_slots, err);
    if (status == FM_OK)
        status = instance_create(&instance, &asked.desc, err);
    instance_destroy(instance);
    stage_destroy(asked.stage);
    return status;
}

static bool measure(fm_measurement *measurement, kit_scene *scene, const kit_way *way, bool check)
{
    fm_error err = { .message = "" };
    char where[256];
    const fm_status status = kit_try(measurement, scene, way, check, &err);
    kit_tell(where, way);
    if (status == FM_UNSUPPORTED)
        print_message("skipped: %s: %s\n", where, err.message);
    else if (status != FM_OK)
        fail_msg("%s: %s", where, err.message);
    return status == FM_OK;
}

bool kit_measure(fm_measurement *measurement, kit_scene *scene, const kit_way *way)
{
    return measure(measurement, scene, way, true);
}

bool kit_measure_times(fm_measurement *measurement, kit_scene *scene, const kit_way *way)
{
    return measure(measurement, scene, way, false);
}

fm_scene *kit_quads_create(uint32_t width_px, uint32_t height_px, uint32_t quads)
{
    static const uint32_t corner[6] = { 0, 1, 2, 2, 1, 3 };
    fm_scene *scene = calloc(1, sizeof *scene);
    assert_non_null(scene);
    settings_default(&scene->settings);
    scene->settings.generator = FM_GENERATOR_MESH;
    scene->settings.n = 0;
    scene->width_px = scene->settings.width_px = width_px;
    scene->height_px = scene->settings.height_px = height_px;
    scene->triangles = 2ull * quads;
    scene->vertex_count = 4 * quads;
    scene->index_count = 6 * quads;
    scene->instances = 1;
    scene->vertices = calloc(scene->vertex_count, sizeof scene->vertices[0]);
    scene->indices = calloc(scene->index_count, sizeof scene->indices[0]);
    scene->clip_from_object = calloc(16, sizeof scene->clip_from_object[0]);
    assert_true(scene->vertices != NULL && scene->indices != NULL &&
                scene->clip_from_object != NULL);
    for (uint32_t i = 0; i < scene->index_count; i++)
        scene->indices[i] = 4 * (i / 6) + corner[i % 6];
    for (int i = 0; i < 4; i++)
        scene->clip_from_object[5 * i] = 1.0f;
    return scene;
}

static float ndc(uint32_t px, uint32_t size_px)
{
    return (float)px * 2.0f / (float)size_px - 1.0f;
}

void kit_quad(fm_scene *scene, uint32_t i, fm_rect px, float depth, uint32_t colour)
{
    for (uint32_t corner = 0; corner < 4; corner++)
        scene->vertices[4 * i + corner] = (fm_vertex){
            .position = { ndc((corner & 1u) != 0 ? px.x1 : px.x0, scene->width_px),
                          ndc((corner & 2u) != 0 ? px.y1 : px.y0, scene->height_px), depth },
            .colour = colour,
        };
}

double kit_apart(const fm_image *a, const fm_image *b)
{
    double most = 0;
    assert_int_equal(a->width_px, b->width_px);
    assert_int_equal(a->height_px, b->height_px);
    for (size_t i = 0; i < 4ull * a->width_px * a->height_px; i++) {
        const double apart = fabs((double)a->rgba[i] - (double)b->rgba[i]);
        most = !(apart <= most) ? apart : most;
    }
    return most;
}
