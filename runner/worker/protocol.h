/* clang-format off */
/* The protocol between the parent of a run and its workers: the only place that spells its fields.
 *
 * The parent executes `fragmark worker REQUEST.json ANSWER.json`. The request says what to do:
 *   { "protocol": 1,                        FM_PROTOCOL; a worker refuses another one
 *     "job": "measure", "truth", "mesh" or "device",
 *     "plugin": "path of the method's .so",
 *     "floor": "path of the floor's .so, or empty",
 *     "common": "folder of the runner's GLSL",
 *     "device": "vulkan:0", "validation": false, "no_timers": false,
 *     "feed": "raster",
 *     "settings": { "k": "8", ... },        every key of fm_keys, as text
 *     "options": { "layout": "layer" },     the method's own, each with its value
 *     "truth": "path of the truth file", "launch": 0,
 *     "cache": "folder of what other launches left, or empty",
 *     "check": true,                        capture and compare all fragments
 *     "image": "path to write the image to, or empty",
 *     "range": "path, without its ending, for what its new images reach, or empty",
 *     "known_images": ["16 hex digits"],    hashes of images that earlier launches of the case drew
 *     "keep_fragments": "path to write captured fragments to, or empty", "keep_truth": "truth",
 *     "keep_frames": "wrong frames of a sequence" }
 *
 * The answer is written at the end; a worker that dies leaves none:
 *   { "status": "a word of model/outcome.h", "message": "",
 *     "reason": "another one",              with not_supported, and only with it; journals of older
 *                                           programs have none
 *     "is_runs_fault": false,               true: the run's own files failed; nothing was measured,
 *                                           and status is "skipped"
 *     "is_truth_unusable": false,           true, with is_runs_fault: the truth file is to be made
 *                                           anew
 *     "is_starved": false,                  true, with wrong_image: a lock gave up, perhaps since
 *                                           the machine is busy
 *     "code": { "program": "16 hex digits", ... },   what was loaded and read: code/code_json.h
 *     "device_name": "...", "device_driver": "...", "device_api": "...", "has_gpu_clock": false,
 *     "is_software": true, "image_layers": 2048, "image_max_bytes": 1073741824,   its largest image
 *     "modelled": { "scene": [...], "passes": [...], "buffers": [...] },    names
 *     "image_hashes": ["16 hex digits"],    of all timed frames, each once; a sequence has one
 *     "mesh": { "file": "...", "told": "a sentence", "triangles": 12, ... },   what a scene's file
 *                                           held, not of launches without "check"
 *     "metrics": { "n": 128, ... },         one number a case, by its metric's name
 *     "launch": { "timed_s": 0.21, ... },   one number a launch, the same
 *     "samples": [ { "frame": 0, "metric": "store_ms", "value": 1.25, "unit": "ms" }, ... ] }
 *
 * Names, units and meanings of metrics are in model/metrics.h. With "check" the answer has the
 * metrics that come from comparing with truth; of images that are not known each launch answers how
 * far they are from it; with timers=frame it has no times of passes. A
 * "truth" job writes the truth file and answers status, message and the metrics of truth; a
 * "device" job only opens the device, and answers what it is. */
/* clang-format on */
#ifndef FM_PROTOCOL_H
#define FM_PROTOCOL_H

#include <jansson.h>
#include <stdbool.h>

#include "base/error.h"
#include "code/code.h"
#include "device/device.h"
#include "mesh/facts.h"
#include "model/descriptor.h"
#include "model/outcome.h"
#include "model/settings.h"
#include "truth/kept_file.h"

/* Raised when a field above is added, goes, or means something else: workers of a build with
 * another number are not asked (program/handshake.h). */
enum { FM_PROTOCOL = 1 };

/* What a worker is asked. All borrowed. */
typedef struct fm_request {
    bool is_truth_job;
    bool is_mesh_job;   /* only to read the scene, and to say what its mesh holds */
    bool is_device_job; /* only to open the device, and to say what it is */
    const char *plugin, *floor, *common; /* paths; floor "": a feed without times */
    const char *device, *feed;           /* as the case names them */
    const fm_settings *settings;
    const fm_choice *choices; /* of the method's options; its first value for what is missing */
    size_t choice_count;
    const char *truth; /* path of the truth file */
    const char *cache; /* folder of the cache (cache/cache.h); "" or NULL: none */
    const char *image; /* path of the image to be written; "": none */
    const char *range; /* prefix of image/image_range.h; "" or NULL: none */
    /* [known_count]: hashes of what earlier launches drew. Of very many only the first are written:
     * the others are compared again, which gives the same. */
    const uint64_t *known_images;
    size_t known_count;
    const char *keep[KEPT_KIND_COUNT]; /* the same for files of kept_file.h; NULL is "" */
    bool check, validation, no_timers;
    uint32_t launch;
} fm_request;

/* The longest message of an answer, in bytes. */
enum { FM_MESSAGE_MAX_BYTES = 8191 };

/* Beside its answer, from the answer's path: what of the plugin runs (plugin/hook_mark.h). Whoever
 * started the worker removes it. */
#define WORKER_HOOK_FILE "%s.hook"

/* What a worker exits with when its answer could not be written. */
enum { WORKER_EXIT_NO_ANSWER = 74 };

/* Writes the request whole or not at all. FM_IO; FM_INVALID: no memory, or a path that is not
 * UTF-8.
 */
fm_status request_write(const char *path, const fm_request *request, fm_error *err);

/* A request that was read, with what it borrows from. Starts as {0}. */
typedef struct fm_read_request {
    fm_request request;
    fm_settings settings;
    fm_choice choices[FM_MAX_OPTIONS];
    uint64_t *known_images; /* owned */
    json_t *json;           /* holds the texts */
} fm_read_request;

/* FM_IO: no such file, or no JSON. FM_INVALID: another protocol, an unknown key, an illegal value,
 * too many options;
 * FM_NO_MEMORY.
 * request_free also after a failure. */
fm_status request_read(fm_read_request *read, const char *path, fm_error *err);
void request_free(fm_read_request *read);

/* Writing an answer: the worker's side. */

void answer_set_device(json_t *answer, const fm_device_caps *caps);
void answer_set_code(json_t *answer, const fm_code *code);
/* reason: of FM_CASE_NOT_SUPPORTED; FM_REASON_NONE of others. Bytes of the message that are no
 * UTF-8 become '?'. */
void answer_set_verdict(json_t *answer, fm_case_status status, fm_reason reason,
                        const char *message);
/* The run's own files failed: no verdict on the method. */
void answer_set_runs_fault(json_t *answer, const char *message);
/* Beside that: it was the truth file, which is damaged or cannot be read. */
void answer_set_truth_unusable(json_t *answer);
/* Beside wrong_image: a lock gave up on a software rasteriser, which a busy machine can bring
 * about. */
void answer_set_starved(json_t *answer);
void answer_set_image_hashes(json_t *answer, const uint64_t *hashes, size_t count);
/* Takes the references. */
void answer_set_measured(json_t *answer, json_t *metrics, json_t *samples);
void answer_set_launch(json_t *answer, json_t *launch);
void answer_set_modelled(json_t *answer, json_t *scene, json_t *passes, json_t *buffers);
/* What the mesh was that the scene is made of, and what of it was left out. */
void answer_set_mesh(json_t *answer, const char *file, const fm_mesh_facts *facts);
/* One element of samples. */
void answer_add_sample_named(json_t *samples, uint32_t frame, const char *metric, double value);
/* An answer on behalf of a worker that left none, or of another case; NULL without memory. */
json_t *answer_make(fm_case_status status, fm_reason reason, const char *message);
/* The same where the run is to blame. */
json_t *answer_make_runs_fault(const char *message);
/* Adds to the message: "; NOTE". What has no room then is cut from the end of the message, and of a
 * note that has none alone. */
void answer_add_note(json_t *answer, const char *note);
/* Writes it; one that does not fit is tried once more with the reason alone. Returns the worker's
 * exit status. */
int answer_write(const json_t *answer, const char *path);

/* Reading an answer: the parent's side. */

/* What follows asks answers that have passed results/answer_check.h. */
fm_case_status answer_status(const json_t *answer);
fm_reason answer_reason(const json_t *answer);
bool answer_is_runs_fault(const json_t *answer);
bool answer_is_truth_unusable(const json_t *answer);
bool answer_is_starved(const json_t *answer);
const char *answer_message(const json_t *answer); /* "": there is none */
/* false: it has no code: a worker that left no answer, an older program's journal. code_free also
 * then. */
bool answer_code(fm_code *code, const json_t *answer);
json_t *answer_image_hashes(const json_t *answer); /* borrowed; NULL: none */
json_t *answer_metrics(const json_t *answer);      /* the same */
json_t *answer_modelled(const json_t *answer);     /* the same */
json_t *answer_samples(const json_t *answer);      /* the same */
json_t *answer_launch(const json_t *answer);       /* the same */

json_t *answer_mesh(const json_t *answer); /* the same */
/* Of a mesh: the file, and a sentence that tells what was loaded; borrowed. */
const char *answer_mesh_file(const json_t *mesh);
const char *answer_mesh_told(const json_t *mesh);

typedef struct fm_answer_sample {
    uint32_t frame;
    const char *metric, *unit; /* borrowed from the answer */
    double value;
} fm_answer_sample;
fm_answer_sample answer_sample(const json_t *sample);

/* What an answer says of the device. */
typedef struct fm_answer_device {
    const char *name, *driver, *api; /* borrowed from the answer */
    bool has_gpu_clock, is_software;
    uint32_t image_layers;    /* most layers of an image; 0 in answers of older programs */
    uint64_t image_max_bytes; /* the same */
} fm_answer_device;
/* false: it says nothing, because the worker did not come so far. */
bool answer_device(fm_answer_device *device, const json_t *answer);

#endif
