#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "settings.h"

/* Names stand at their enumerator's index, and none is forgotten; settings_set stores an unsigned.
 */
#define ONE_NAME_EACH(names, count, type)                                                          \
    _Static_assert(sizeof names / sizeof names[0] == (count) && sizeof(type) == sizeof(unsigned),  \
                   "one name for each " #type)

static const char *const generator_names[] = { [FM_GENERATOR_LAYERS] = "layers",
                                               [FM_GENERATOR_MESH] = "mesh",
                                               [FM_GENERATOR_BUNNY_IN_CUBE] = "bunny-in-cube",
                                               [FM_GENERATOR_PALACE] = "palace",
                                               [FM_GENERATOR_HAIRBALL] = "hairball",
                                               [FM_GENERATOR_ENGINE] = "engine",
                                               [FM_GENERATOR_TEMPLE] = "temple",
                                               [FM_GENERATOR_HOTEL] = "hotel",
                                               [FM_GENERATOR_IVY] = "ivy",
                                               [FM_GENERATOR_FRAMES] = "frames",
                                               [FM_GENERATOR_STREAM] = "stream",
                                               [FM_GENERATOR_ADVERSARIAL] = "adversarial" };
ONE_NAME_EACH(generator_names, FM_GENERATOR_COUNT, fm_generator);

static const char *const order_names[] = { [FM_ORDER_RANDOM] = "random",
                                           [FM_ORDER_RANDOM_CELL] = "random-cell",
                                           [FM_ORDER_ASCENDING] = "ascending",
                                           [FM_ORDER_DESCENDING] = "descending",
                                           [FM_ORDER_CELL_MAJOR] = "cell-major" };
ONE_NAME_EACH(order_names, FM_ORDER_COUNT, fm_order);

static const char *const depths_names[] = {
    [FM_DEPTHS_UNIFORM] = "uniform",    [FM_DEPTHS_CLUSTERED] = "clustered",
    [FM_DEPTHS_COPLANAR] = "coplanar",  [FM_DEPTHS_ULP] = "ulp",
    [FM_DEPTHS_SLOPED] = "sloped",      [FM_DEPTHS_EQUAL] = "equal",
    [FM_DEPTHS_STEP24] = "step24",      [FM_DEPTHS_ENDS] = "ends",
    [FM_DEPTHS_STEP32] = "step32",      [FM_DEPTHS_DENORMAL] = "denormal",
    [FM_DEPTHS_PROJECTED] = "projected"
};
ONE_NAME_EACH(depths_names, FM_DEPTHS_COUNT, fm_depths);

static const char *const depth_names[] = {
    [FM_DEPTH_NORMAL] = "normal", [FM_DEPTH_REVERSED] = "reversed"
};
ONE_NAME_EACH(depth_names, FM_DEPTH_COUNT, fm_depth);

static const char *const colours_names[] = {
    [FM_COLOURS_HASH] = "hash", [FM_COLOURS_CYCLE] = "cycle", [FM_COLOURS_GREY] = "grey"
};
ONE_NAME_EACH(colours_names, FM_COLOURS_COUNT, fm_colours);

static const char *const alphas_names[] = {
    [FM_ALPHAS_CONSTANT] = "constant", [FM_ALPHAS_RANDOM] = "random"
};
ONE_NAME_EACH(alphas_names, FM_ALPHAS_COUNT, fm_alphas);

static const char *const lock_names[] = {
    [FM_LOCK_SPIN] = "spin", [FM_LOCK_INTERLOCK] = "interlock"
};
ONE_NAME_EACH(lock_names, FM_LOCK_COUNT, fm_lock);

static const char *const release_names[] = {
    [FM_RELEASE_AUTO] = "auto", [FM_RELEASE_STORE] = "store", [FM_RELEASE_EXCHANGE] = "exchange"
};
ONE_NAME_EACH(release_names, FM_RELEASE_COUNT, fm_release);

static const char *const buffers_names[] = {
    [FM_BUFFERS_AUTO] = "auto", [FM_BUFFERS_BOUND] = "bound", [FM_BUFFERS_ADDRESS] = "address"
};
ONE_NAME_EACH(buffers_names, FM_BUFFERS_COUNT, fm_buffers);

static const char *const pool_names[] = {
    [FM_POOL_PREALLOCATED] = "preallocated", [FM_POOL_PER_FRAME] = "per-frame"
};
ONE_NAME_EACH(pool_names, FM_POOL_COUNT, fm_pool);

static const char *const full_screen_names[] = {
    [FM_FULL_SCREEN_COMPUTE] = "compute", [FM_FULL_SCREEN_FRAGMENT] = "fragment"
};
ONE_NAME_EACH(full_screen_names, FM_FULL_SCREEN_COUNT, fm_full_screen);

static const char *const timers_names[] = {
    [FM_TIMERS_PASSES] = "passes", [FM_TIMERS_FRAME] = "frame"
};
ONE_NAME_EACH(timers_names, FM_TIMERS_COUNT, fm_timers);

static const char *const culling_names[] = {
    [FM_CULLING_NONE] = "none", [FM_CULLING_OCCUPANCY] = "occupancy"
};
ONE_NAME_EACH(culling_names, FM_CULLING_COUNT, fm_culling);

static const char *const cull_range_names[] = {
    [FM_CULL_RANGE_HULL] = "hull", [FM_CULL_RANGE_AABB] = "aabb", [FM_CULL_RANGE_EXACT] = "exact"
};
ONE_NAME_EACH(cull_range_names, FM_CULL_RANGE_COUNT, fm_cull_range);

static const char *const cull_test_names[] = {
    [FM_CULL_TEST_EARLY] = "early", [FM_CULL_TEST_SHADER] = "shader"
};
ONE_NAME_EACH(cull_test_names, FM_CULL_TEST_COUNT, fm_cull_test);

static const char *const cull_memory_names[] = {
    [FM_CULL_MEMORY_OWN] = "own", [FM_CULL_MEMORY_SHARED] = "shared"
};
ONE_NAME_EACH(cull_memory_names, FM_CULL_MEMORY_COUNT, fm_cull_memory);

static const char *const own_cull_names[] = { [FM_OWN_CULL_ON] = "on", [FM_OWN_CULL_OFF] = "off" };
ONE_NAME_EACH(own_cull_names, FM_OWN_CULL_COUNT, fm_own_cull);

static const char *const accumulate_names[] = { [FM_ACCUMULATE_FLOAT32] = "float32",
                                                [FM_ACCUMULATE_FLOAT16] = "float16",
                                                [FM_ACCUMULATE_UNORM8] = "unorm8" };
ONE_NAME_EACH(accumulate_names, FM_ACCUMULATE_COUNT, fm_accumulate);

static const char *const composite_names[] = {
    [FM_COMPOSITE_FRONT_TO_BACK] = "front-to-back", [FM_COMPOSITE_BACK_TO_FRONT] = "back-to-front"
};
ONE_NAME_EACH(composite_names, FM_COMPOSITE_COUNT, fm_composite);

#define NAMES(names) .values = (names), .value_count = sizeof(names) / sizeof(names)[0]

#define AT(field) .offset = offsetof(fm_settings, field)
#define ANY       .scope = FM_SCOPE_SCENE
#define BY(mask)  .scope = FM_SCOPE_SCENE, .generators = (mask)
#define LAYERS    BY(1u << FM_GENERATOR_LAYERS)
#define MESH_FILE BY(1u << FM_GENERATOR_MESH | 1u << FM_GENERATOR_BUNNY_IN_CUBE)
/* bunny-in-cube's camera and place follow from its pixel density. */
#define DENSITY    BY(1u << FM_GENERATOR_LAYERS | 1u << FM_GENERATOR_BUNNY_IN_CUBE)
#define MESH       BY(~(1u << FM_GENERATOR_LAYERS | 1u << FM_GENERATOR_BUNNY_IN_CUBE | FM_MAKES_FRAMES))
#define FRAMES     BY(1u << FM_GENERATOR_FRAMES)
#define STREAM     BY(1u << FM_GENERATOR_STREAM)
#define ANY_FRAMES BY(FM_MAKES_FRAMES)
#define FRAGMENTS  BY(~FM_MAKES_FRAMES)
#define ANYWHERE   .low = -DBL_MAX, .high = DBL_MAX
#define QUIET      .scope = FM_SCOPE_CASE, .is_quiet = true

/* clang-format off */
const fm_key fm_keys[] = {
    { "width_px", FM_KEY_UINT, ANY, AT(width_px), .low = 1, .high = 16384, .fallback = "854",
      .unit = "px", .help = "viewport" },
    { "height_px", FM_KEY_UINT, ANY, AT(height_px), .low = 1, .high = 16384, .fallback = "480",
      .unit = "px", .help = "viewport" },
    { "generator", FM_KEY_ENUM, ANY, AT(generator), NAMES(generator_names),
      .fallback = "layers", .help = "what makes the scene" },
    { "depth", FM_KEY_ENUM, FRAGMENTS, AT(depth), NAMES(depth_names), .fallback = "normal",
      .is_quiet = true, .help = "of the projection; reversed: 1 near, 0 far, handed on near to far" },
    { "n", FM_KEY_UINT, LAYERS, AT(n), .low = 0, .high = 65536, .fallback = "none",
      .optional = true, .absent = FM_NOT_GIVEN, .help = "layers" },
    { "r", FM_KEY_UINT, LAYERS, AT(r), .low = 1, .high = 65536, .fallback = "none",
      .optional = true, .absent = 0, .help = "layers for each of k: n = r k (4 without n and r)" },
    { "pixel_density", FM_KEY_REAL, DENSITY, AT(pixel_density), .low = 1e-9, .high = 1,
      .fallback = "0.25", .help = "part of the viewport that layers, or the cube, cover" },
    { "fragment_probability", FM_KEY_REAL, LAYERS, AT(fragment_probability), .low = 0, .high = 1,
      .fallback = "1", .help = "that a layer has a fragment at a pixel" },
    { "tessellation", FM_KEY_UINT, LAYERS, AT(tessellation), .low = 1, .high = 64,
      .fallback = "16", .help = "t: each layer is t by t cells" },
    { "order", FM_KEY_ENUM, LAYERS, AT(order),
      NAMES(order_names),
      .fallback = "random", .help = "in which layers arrive" },
    { "depths", FM_KEY_ENUM, LAYERS, AT(depths),
      NAMES(depths_names),
      .fallback = "uniform", .help = "of the layers" },
    { "colours", FM_KEY_ENUM, LAYERS, AT(colours), NAMES(colours_names),
      .fallback = "hash", .help = "of the layers" },
    { "alphas", FM_KEY_ENUM, LAYERS, AT(alphas), NAMES(alphas_names),
      .fallback = "constant", .help = "alpha itself, or up to it" },
    { "alpha", FM_KEY_REAL, ANY, AT(alpha), .low = 0, .high = 1, .fallback = "0.3",
      .help = "opacity of a fragment" },
    { "seed", FM_KEY_UINT64, ANY, AT(seed), .low = 0, .high = (double)FM_KEY_UINT64_MAX,
      .fallback = "1", .help = "of everything random" },
    { "mesh", FM_KEY_TEXT, MESH_FILE, AT(mesh), .fallback = "",
      .help = "OBJ, PLY, OFF, STL, 3DS or glTF file, beside the file that names it" },
    { "eye", FM_KEY_VECTOR, MESH, AT(eye), ANYWHERE, .fallback = "0 0 0",
      .help = "camera; eye = target: fitted to the mesh" },
    { "target", FM_KEY_VECTOR, MESH, AT(target), ANYWHERE, .fallback = "0 0 0",
      .help = "what the camera looks at" },
    { "up", FM_KEY_VECTOR, MESH, AT(up), ANYWHERE, .fallback = "0 1 0",
      .help = "camera" },
    { "fov_deg", FM_KEY_REAL, MESH, AT(fov_deg), .low = 1, .high = 170, .fallback = "45",
      .unit = "deg", .help = "vertical field of view" },
    { "near_plane", FM_KEY_REAL, MESH, AT(near_plane), .low = 0, .high = DBL_MAX, .fallback = "0",
      .help = "both 0: 0.4 and 1.7 of the distance" },
    { "far_plane", FM_KEY_REAL, MESH, AT(far_plane), .low = 0, .high = DBL_MAX, .fallback = "0",
      .help = "clip plane" },
    { "zoom", FM_KEY_REAL, MESH, AT(zoom), .low = 0.001, .high = 1000, .fallback = "1",
      .help = "of the fitted camera" },
    { "instances", FM_KEY_UINT, MESH, AT(instances), .low = 1, .high = 4096, .fallback = "1",
      .help = "copies of the mesh" },
    { "instance_offset", FM_KEY_VECTOR, MESH, AT(instance_offset), .low = -1e4, .high = 1e4,
      .fallback = "0 0 0", .help = "from copy to copy, in box sizes" },
    { "stream", FM_KEY_TEXT, STREAM, AT(stream), .fallback = "",
      .help = "file of `fragmark record`, beside the file that names it" },
    { "sequence_frames", FM_KEY_UINT, ANY_FRAMES, AT(sequence_frames), .low = 2, .high = 10000,
      .fallback = "60", .help = "frames of the sequence" },
    { "backgrounds", FM_KEY_UINT, FRAMES, AT(backgrounds), .low = 0, .high = 16, .fallback = "2",
      .help = "opaque layers of the whole screen, drawn first, without depth" },
    { "sprites", FM_KEY_UINT, FRAMES, AT(sprites), .low = 0, .high = 20000, .fallback = "100",
      .help = "quads without depth" },
    { "triangles", FM_KEY_UINT, FRAMES, AT(triangles), .low = 0, .high = 200000, .fallback = "0",
      .help = "of objects with depth" },
    { "object_px", FM_KEY_REAL, FRAMES, AT(object_px), .low = 4, .high = 2000, .fallback = "64",
      .unit = "px", .help = "mean side of sprites; of objects four times that" },
    { "depth_complexity", FM_KEY_REAL, FRAMES, AT(depth_complexity), .low = 0, .high = 32,
      .fallback = "3", .help = "screens that objects with depth fill" },
    { "front_to_back", FM_KEY_REAL, FRAMES, AT(front_to_back), .low = 0, .high = 1, .fallback = "0",
      .help = "order of objects: 0 random, 1 nearest first" },
    { "camera_px", FM_KEY_REAL, FRAMES, AT(camera_px), .low = 0, .high = 500, .fallback = "0",
      .unit = "px", .help = "how far the camera moves in a frame in which it does" },
    { "camera_moves", FM_KEY_REAL, FRAMES, AT(camera_moves), .low = 0, .high = 1, .fallback = "1",
      .help = "share of such frames" },
    { "moving", FM_KEY_REAL, FRAMES, AT(moving), .low = 0, .high = 1, .fallback = "0.05",
      .help = "share of sprites and objects that move by themselves" },
    { "hud", FM_KEY_REAL, FRAMES, AT(hud), .low = 0, .high = 1, .fallback = "0.1",
      .help = "share of the screen under panels, drawn last" },
    { "hud_opaque", FM_KEY_REAL, FRAMES, AT(hud_opaque), .low = 0, .high = 1, .fallback = "1",
      .help = "share of the panels that is opaque" },
    { "hidden_churn", FM_KEY_REAL, FRAMES, AT(hidden_churn), .low = 0, .high = 1, .fallback = "0",
      .help = "probability that what lies under a piece of opaque panel changes in a frame" },
    { "translucent", FM_KEY_REAL, FRAMES, AT(translucent), .low = 0, .high = 1, .fallback = "0.1",
      .help = "share of sprites that are blended" },
    { "fragment_instructions", FM_KEY_UINT, ANY_FRAMES, AT(fragment_instructions), .low = 1,
      .high = 10000, .fallback = "8", .help = "of a shader, for each fragment" },
    { "vertex_instructions", FM_KEY_UINT, ANY_FRAMES, AT(vertex_instructions), .low = 1, .high = 10000,
      .fallback = "12", .help = "of a shader, for each vertex" },
    { "texture_bytes", FM_KEY_REAL, ANY_FRAMES, AT(texture_bytes), .low = 0, .high = 64,
      .fallback = "2", .unit = "B", .help = "from memory, for each shaded fragment" },
    { "k", FM_KEY_UINT, FM_SCOPE_CASE, AT(k), .low = 1, .high = 4096, .fallback = "8",
      .optional = true, .absent = 0, .help = "nearest fragments to keep" },
    { "lock", FM_KEY_ENUM, FM_SCOPE_CASE, AT(lock), NAMES(lock_names),
      .fallback = "spin", .help = "of exclusive passes" },
    { "release", FM_KEY_ENUM, FM_SCOPE_CASE, AT(release), NAMES(release_names),
      .fallback = "auto", .help = "of the spin lock" },
    { "buffers", FM_KEY_ENUM, FM_SCOPE_CASE, AT(buffers), NAMES(buffers_names),
      .fallback = "auto", .help = "how shaders reach them" },
    { "pool", FM_KEY_ENUM, FM_SCOPE_CASE, AT(pool), NAMES(pool_names),
      .fallback = "preallocated", .help = "when buffers are allocated" },
    { "full_screen", FM_KEY_ENUM, FM_SCOPE_CASE, AT(full_screen),
      NAMES(full_screen_names), .fallback = "compute", .help = "passes over pixels" },
    { "timers", FM_KEY_ENUM, QUIET, AT(timers), NAMES(timers_names), .fallback = "passes",
      .help = "frame: one for all passes, none has a time, times_floor is of frames" },
    { "culling", FM_KEY_ENUM, QUIET, AT(culling), NAMES(culling_names),
      .fallback = "none", .help = "by an occupancy map, before the method's own passes" },
    { "cull_words", FM_KEY_UINT, QUIET, .with = "culling", AT(cull_words), .low = 1, .high = 64, .fallback = "32",
      .help = "d, words of the map a pixel: 32 d buckets, at least k" },
    { "cull_range", FM_KEY_ENUM, QUIET, .with = "culling", AT(cull_range), NAMES(cull_range_names),
      .fallback = "hull", .help = "the map's depths: of the hull, the box, the scene" },
    { "cull_test", FM_KEY_ENUM, QUIET, .with = "culling", AT(cull_test), NAMES(cull_test_names),
      .fallback = "early", .help = "before the shader where a pass can, or in it" },
    { "cull_memory", FM_KEY_ENUM, QUIET, .with = "culling", AT(cull_memory), NAMES(cull_memory_names),
      .fallback = "own", .help = "the map lies in the method's largest fixed buffer" },
    { "own_cull", FM_KEY_ENUM, QUIET, AT(own_cull), NAMES(own_cull_names),
      .fallback = "on", .help = "the method's own test before its lock" },
    { "exposure", FM_KEY_REAL, QUIET, AT(exposure), .low = -16, .high = 16, .fallback = "0",
      .unit = "stops", .help = "pictures are compared with colours times 2^E, alpha as it is", .is_of_picture = true },
    { "accumulate", FM_KEY_ENUM, QUIET, AT(accumulate), NAMES(accumulate_names),
      .fallback = "float32", .help = "what each step of compositing is rounded to" },
    { "composite", FM_KEY_ENUM, QUIET, AT(composite), NAMES(composite_names),
      .fallback = "front-to-back", .help = "from which end a pixel's fragments are composited" },
    { "model", FM_KEY_TEXT, FM_SCOPE_CASE, AT(model), .fallback = "",
      .help = "of the simulated GPU: \"NAME=VALUE ...\", names as in its parameters.yml" },
    { "launches", FM_KEY_UINT, FM_SCOPE_RUN, AT(launches), .low = 1, .high = 1000,
      .fallback = "5", .help = "processes that measure a case; with precision, at most (then 40); of one, times have no interval" },
    { "frames", FM_KEY_UINT, FM_SCOPE_RUN, AT(frames), .low = 1, .high = 10000,
      .fallback = "5", .help = "timed frames of a launch" },
    { "warmup", FM_KEY_UINT, FM_SCOPE_RUN, AT(warmup), .low = 0, .high = 100,
      .fallback = "2", .help = "frames before the timed ones" },
    { "precision", FM_KEY_PERCENT, FM_SCOPE_RUN, AT(precision_percent), .is_quiet = true, .low = 0.01, .high = 100,
      .fallback = "none", .optional = true, .absent = 0,
      .help = "cases of a scene are launched until half of each frame_ms's interval is no more; looks at 5, 10, 20, ..." },
};
/* clang-format on */
enum { KEY_COUNT = sizeof fm_keys / sizeof fm_keys[0] };
_Static_assert((int)KEY_COUNT <= (int)FM_MAX_KEYS, "fm_case marks the given ones");
const size_t fm_key_count = KEY_COUNT;

const fm_key *key_find(const char *name)
{
    for (size_t i = 0; i < KEY_COUNT; i++)
        if (strcmp(fm_keys[i].name, name) == 0)
            return &fm_keys[i];
    return NULL;
}

const char *key_nearest(const char *name)
{
    const char *names[KEY_COUNT];
    for (size_t i = 0; i < KEY_COUNT; i++)
        names[i] = fm_keys[i].name;
    return text_nearest(name, names, KEY_COUNT);
}

bool key_is_read(const fm_key *key, fm_generator generator)
{
    return key->scope != FM_SCOPE_SCENE || key->generators == 0 ||
           (key->generators >> generator & 1u) != 0;
}

static void enum_domain(char text[FM_TEXT_MAX], const fm_key *key)
{
    size_t length = 0;
    text[0] = '\0';
    for (size_t i = 0; i < key->value_count; i++)
        if (length < FM_TEXT_MAX)
            length += (size_t)snprintf(text + length, FM_TEXT_MAX - length, "%s%s",
                                       i > 0 ? "|" : "", key->values[i]);
}

/* One end of a range; the ends of doubles are no end. */
static void range_end(char text[32], double end)
{
    if (fabs(end) < DBL_MAX)
        text_from_double(text, end);
    else
        text[0] = '\0';
}

void key_domain(char text[FM_TEXT_MAX], const fm_key *key)
{
    char low[32], high[32];
    range_end(low, key->low);
    range_end(high, key->high);
    switch (key->type) {
    case FM_KEY_UINT:
    case FM_KEY_REAL:
        snprintf(text, FM_TEXT_MAX, "%s..%s", low, high);
        return;
    case FM_KEY_PERCENT:
        snprintf(text, FM_TEXT_MAX, "%s%%..%s%%", low, high);
        return;
    case FM_KEY_UINT64:
        snprintf(text, FM_TEXT_MAX, "%s..%" PRIu64, low, FM_KEY_UINT64_MAX);
        return;
    case FM_KEY_VECTOR:
        snprintf(text, FM_TEXT_MAX, "\"x y z\", each %s%s%s", low,
                 low[0] != '\0' ? ".." : "any number", high);
        return;
    case FM_KEY_ENUM:
        enum_domain(text, key);
        return;
    case FM_KEY_TEXT:
        snprintf(text, FM_TEXT_MAX, "text");
        return;
    }
}

static const char *const scope_title[] = {
    [FM_SCOPE_SCENE] = "Keys of a scene",
    [FM_SCOPE_CASE] = "Keys of a case",
    [FM_SCOPE_RUN] = "Keys of a run (one value)",
};

void keys_help(fm_text *text)
{
    char domain[FM_TEXT_MAX];
    for (size_t i = 0; i < KEY_COUNT; i++) {
        const fm_key *key = &fm_keys[i];
        if (i == 0 || key->scope != key[-1].scope)
            text_add(text, "%s%s:\n", i > 0 ? "\n" : "", scope_title[key->scope]);
        key_domain(domain, key);
        text_add(text, "  %-20s  %s%s%s", key->name, key->help, key->unit != NULL ? ", " : "",
                 key->unit != NULL ? key->unit : "");
        text_add(text, "\n  %-20s  %s", "", domain);
        if (key->fallback[0] != '\0')
            text_add(text, " (%s)", key->fallback);
        text_add(text, "\n");
    }
}
