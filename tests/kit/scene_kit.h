/* Short ways to run the whole chain in tests: a scene from texts, its truth, a method measured on
 * it. What fails fails the test. Tests that use it are registered with fm_add_scene_test. */
#ifndef FM_TESTS_SCENE_KIT_H
#define FM_TESTS_SCENE_KIT_H

#include <stdlib.h>

#include "device/device_kit.h"
#include "plugin/plugin.h"
#include "worker/measure.h"

/* A device and all methods of FRAGMARK_PLUGIN_PATH. */
typedef struct scene_kit {
    fm_device *device; /* borrowed */
    fm_plugin_list plugins;
    char broken[32]; /* folder of kit_break; empty: none */
} scene_kit;

/* A scene and what the device rasterises of it. */
typedef struct kit_scene {
    scene_kit *kit;
    fm_scene *scene;
    fm_truth *truth;
    fm_truth *triangles; /* of that feed; NULL until a method was measured on it */
    uint32_t told_n;     /* the most fragments of a pixel as methods are told; 0: as it is */
    void (*edit)(fm_method_desc *); /* changes methods, with culling if asked for, before they run;
                                       NULL: as they are */
} kit_scene;

/* Every test runs on a fresh device of each kind; *state is the device. */
#define ON_VULKAN_AND_OSMESA(test)                                                                 \
    { #test " [vulkan]", test, open_vulkan, close_opened, NULL },                                  \
    {                                                                                              \
#test " [osmesa]", test, open_osmesa, close_opened, NULL                                   \
    }

void kit_open(scene_kit *kit, fm_device *device);
void kit_close(scene_kit *kit);

/* A mistake in one of the runner's own GLSL files, as a test for tests: this text in its place. */
typedef struct kit_mistake {
    const char *file, *right, *wrong;
} kit_mistake;
/* From here on the kit's methods are compiled with a copy of the files that has it. */
void kit_break(scene_kit *kit, const kit_mistake *mistake);

/* The plugin's descriptor. Fails the test if the plugin was refused. */
const fm_method_desc *kit_method(const scene_kit *kit, size_t index);
/* Feeds that the method takes, as FM_FEED_* bits; where FRAGMARK_TEST_LOCKS is set, none for
 * methods without a pass that takes locks. */
uint32_t kit_feeds(const fm_method_desc *method);

/* Whether the method is installed; what is not is printed as skipped. */
bool kit_has(const scene_kit *kit, const char *method);
/* Hands over exactly the wanted fragments: always, or where no two depths of a pixel are equal. */
bool kit_is_right(const fm_method_desc *method, bool any_ties);

/* Whether fragments of a pixel may damage each other: methods without a lock race on compute feeds,
 * and on a GPU on every feed. */
bool kit_races(const scene_kit *kit, const fm_method_desc *method, uint32_t feed);

/* texts: "width_px=5 n=3 ..."; every key of fm_keys; k is 8 unless given. */
void kit_scene_open(kit_scene *scene, scene_kit *kit, const char *texts);
/* A scene that the test made by hand: owned from here on. */
void kit_scene_take(kit_scene *scene, scene_kit *kit, fm_scene *made);
void kit_scene_close(kit_scene *scene);
/* What a feed's methods are compared with. */
const fm_truth *kit_truth(kit_scene *scene, uint32_t feed);
/* FRAGMARK_TEST_ALL is set: the slow tests, of which the fast ones are a part. */
bool kit_wants_all(void);
/* Whether a pixel has two fragments of one depth: which of them comes first is then open. */
bool kit_has_ties(const fm_truth *truth);

/* How a method is measured: texts are keys of a case ("k=8 buffers=bound pool=per-frame") and the
 * method's own options ("layout=layer"). */
typedef struct kit_way {
    const char *method;
    uint32_t feed; /* one FM_FEED_* */
    const char *texts;
} kit_way;

/* One warm-up frame, one timed frame, and with `check` the check of every fragment. The measurement
 * is to be freed, also after a failure. */
fm_status kit_try(fm_measurement *measurement, kit_scene *scene, const kit_way *way, bool check,
                  fm_error *err);
/* The same; a failure other than FM_UNSUPPORTED fails the test. False: not supported, printed. */
bool kit_measure(fm_measurement *measurement, kit_scene *scene, const kit_way *way);
/* The same without the check of fragments: bytes and image only. */
bool kit_measure_times(fm_measurement *measurement, kit_scene *scene, const kit_way *way);
/* Sets the method up, resources and pipelines of the timed or the checked build, and runs nothing.
 */
fm_status kit_build(kit_scene *scene, const kit_way *way, bool is_capture, fm_error *err);
/* TEXTS with a value of each option whose `auto` is the runner's, and of count_in, others for each
 * number: "k=8 layout=tile". These options say how fragments, or what is kept beside them, lie in
 * memory, and change nothing that is handed over. */
void kit_memory_in_turn(char texts[96], const char *given, const fm_method_desc *method,
                        size_t number);
/* "kplus-array, compute-layer, k=8": for messages. */
void kit_tell(char text[256], const kit_way *way);

/* A mesh scene without a file: room for quads, no camera. Every quad is a fragment source of its
 * own; later quads arrive later. */
fm_scene *kit_quads_create(uint32_t width_px, uint32_t height_px, uint32_t quads);
/* Quad i covers these pixels at this depth. */
void kit_quad(fm_scene *scene, uint32_t i, fm_rect px, float depth, uint32_t colour);

/* Largest difference of any channel of two images of one size. */
double kit_apart(const fm_image *a, const fm_image *b);

#endif
