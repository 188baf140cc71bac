#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "settings.h"

_Static_assert(
    sizeof(fm_generator) == sizeof(unsigned) && sizeof(fm_order) == sizeof(unsigned) &&
        sizeof(fm_depths) == sizeof(unsigned) && sizeof(fm_colours) == sizeof(unsigned) &&
        sizeof(fm_alphas) == sizeof(unsigned) && sizeof(fm_lock) == sizeof(unsigned) &&
        sizeof(fm_release) == sizeof(unsigned) && sizeof(fm_buffers) == sizeof(unsigned) &&
        sizeof(fm_pool) == sizeof(unsigned) && sizeof(fm_full_screen) == sizeof(unsigned) &&
        sizeof(fm_culling) == sizeof(unsigned) && sizeof(fm_cull_range) == sizeof(unsigned) &&
        sizeof(fm_cull_test) == sizeof(unsigned) && sizeof(fm_cull_memory) == sizeof(unsigned) &&
        sizeof(fm_own_cull) == sizeof(unsigned) && sizeof(fm_timers) == sizeof(unsigned),
    "FM_KEY_ENUM stores an unsigned");

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
#define QUIET      .scope = FM_SCOPE_CASE, .is_quiet = true

/* clang-format off */
const fm_key fm_keys[] = {
    { "width_px", FM_KEY_UINT, ANY, AT(width_px), .low = 1, .high = 16384, .fallback = "854",
      .unit = "px", .help = "viewport" },
    { "height_px", FM_KEY_UINT, ANY, AT(height_px), .low = 1, .high = 16384, .fallback = "480",
      .unit = "px", .help = "viewport" },
    { "generator", FM_KEY_ENUM, ANY, AT(generator), .values = { "layers", "mesh", "bunny-in-cube", "palace", "hairball", "engine", "temple", "hotel", "ivy", "frames", "stream", "adversarial" },
      .fallback = "layers", .help = "what makes the scene" },
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
      .values = { "random", "random-cell", "ascending", "descending", "cell-major" },
      .fallback = "random", .help = "in which layers arrive" },
    { "depths", FM_KEY_ENUM, LAYERS, AT(depths),
      .values = { "uniform", "clustered", "coplanar", "ulp", "sloped", "equal", "step24", "ends" },
      .fallback = "uniform", .help = "of the layers" },
    { "colours", FM_KEY_ENUM, LAYERS, AT(colours), .values = { "hash", "cycle", "grey" },
      .fallback = "hash", .help = "of the layers" },
    { "alphas", FM_KEY_ENUM, LAYERS, AT(alphas), .values = { "constant", "random" },
      .fallback = "constant", .help = "alpha itself, or up to it" },
    { "alpha", FM_KEY_REAL, ANY, AT(alpha), .low = 0, .high = 1, .fallback = "0.3",
      .help = "opacity of a fragment" },
    { "seed", FM_KEY_UINT64, ANY, AT(seed), .low = 0, .high = (double)FM_KEY_UINT64_MAX,
      .fallback = "1", .help = "of everything random" },
    { "mesh", FM_KEY_TEXT, MESH_FILE, AT(mesh), .fallback = "",
      .help = "OBJ, PLY or 3DS file, beside the file that names it" },
    { "eye", FM_KEY_VECTOR, MESH, AT(eye), .low = -1e6, .high = 1e6, .fallback = "0 0 0",
      .help = "camera; eye = target: fitted to the mesh" },
    { "target", FM_KEY_VECTOR, MESH, AT(target), .low = -1e6, .high = 1e6, .fallback = "0 0 0",
      .help = "what the camera looks at" },
    { "up", FM_KEY_VECTOR, MESH, AT(up), .low = -1e6, .high = 1e6, .fallback = "0 1 0",
      .help = "camera" },
    { "fov_deg", FM_KEY_REAL, MESH, AT(fov_deg), .low = 1, .high = 170, .fallback = "45",
      .unit = "deg", .help = "vertical field of view" },
    { "near_plane", FM_KEY_REAL, MESH, AT(near_plane), .low = 0, .high = 1e9, .fallback = "0",
      .help = "both 0: 0.4 and 1.7 of the distance" },
    { "far_plane", FM_KEY_REAL, MESH, AT(far_plane), .low = 0, .high = 1e9, .fallback = "0",
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
    { "lock", FM_KEY_ENUM, FM_SCOPE_CASE, AT(lock), .values = { "spin", "interlock" },
      .fallback = "spin", .help = "of exclusive passes" },
    { "release", FM_KEY_ENUM, FM_SCOPE_CASE, AT(release), .values = { "auto", "store", "exchange" },
      .fallback = "auto", .help = "of the spin lock" },
    { "buffers", FM_KEY_ENUM, FM_SCOPE_CASE, AT(buffers), .values = { "auto", "bound", "address" },
      .fallback = "auto", .help = "how shaders reach them" },
    { "pool", FM_KEY_ENUM, FM_SCOPE_CASE, AT(pool), .values = { "preallocated", "per-frame" },
      .fallback = "preallocated", .help = "when buffers are allocated" },
    { "full_screen", FM_KEY_ENUM, FM_SCOPE_CASE, AT(full_screen),
      .values = { "compute", "fragment" }, .fallback = "compute", .help = "passes over pixels" },
    { "timers", FM_KEY_ENUM, QUIET, AT(timers), .values = { "passes", "frame" }, .fallback = "passes",
      .help = "frame: one for all passes, none has a time, times_floor is of frames" },
    { "culling", FM_KEY_ENUM, QUIET, AT(culling), .values = { "none", "occupancy" },
      .fallback = "none", .help = "by an occupancy map, before the method's own passes" },
    { "cull_words", FM_KEY_UINT, QUIET, .with = "culling", AT(cull_words), .low = 1, .high = 64, .fallback = "32",
      .help = "d, words of the map a pixel: 32 d buckets, at least k" },
    { "cull_range", FM_KEY_ENUM, QUIET, .with = "culling", AT(cull_range), .values = { "hull", "aabb", "exact" },
      .fallback = "hull", .help = "the map's depths: of the hull, the box, the scene" },
    { "cull_test", FM_KEY_ENUM, QUIET, .with = "culling", AT(cull_test), .values = { "early", "shader" },
      .fallback = "early", .help = "before the shader where a pass can, or in it" },
    { "cull_memory", FM_KEY_ENUM, QUIET, .with = "culling", AT(cull_memory), .values = { "own", "shared" },
      .fallback = "own", .help = "the map lies in the method's largest fixed buffer" },
    { "own_cull", FM_KEY_ENUM, QUIET, AT(own_cull), .values = { "on", "off" },
      .fallback = "on", .help = "the method's own test before its lock" },
    { "model", FM_KEY_TEXT, FM_SCOPE_CASE, AT(model), .fallback = "",
      .help = "of the simulated GPU: \"NAME=VALUE ...\", names as in its parameters.yml" },
    { "launches", FM_KEY_UINT, FM_SCOPE_RUN, AT(launches), .low = 1, .high = 1000,
      .fallback = "5", .help = "processes that measure a case" },
    { "frames", FM_KEY_UINT, FM_SCOPE_RUN, AT(frames), .low = 1, .high = 10000,
      .fallback = "5", .help = "timed frames of a launch" },
    { "warmup", FM_KEY_UINT, FM_SCOPE_RUN, AT(warmup), .low = 0, .high = 100,
      .fallback = "2", .help = "frames before the timed ones" },
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
    for (size_t i = 0; i < sizeof key->values / sizeof key->values[0]; i++)
        if (key->values[i] != NULL && length < FM_TEXT_MAX)
            length += (size_t)snprintf(text + length, FM_TEXT_MAX - length, "%s%s",
                                       i > 0 ? "|" : "", key->values[i]);
}

void key_domain(char text[FM_TEXT_MAX], const fm_key *key)
{
    char low[32], high[32];
    text_from_double(low, key->low);
    text_from_double(high, key->high);
    switch (key->type) {
    case FM_KEY_UINT:
    case FM_KEY_REAL:
        snprintf(text, FM_TEXT_MAX, "%s..%s", low, high);
        return;
    case FM_KEY_UINT64:
        snprintf(text, FM_TEXT_MAX, "%s..%" PRIu64, low, FM_KEY_UINT64_MAX);
        return;
    case FM_KEY_VECTOR:
        snprintf(text, FM_TEXT_MAX, "\"x y z\", each %s..%s", low, high);
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
