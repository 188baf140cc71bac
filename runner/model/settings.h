/* The room model is the vocabulary: what keys, feeds, formats, metrics, columns, families and
 * statuses there are, and what follows from a descriptor by arithmetic. One table each. It opens no
 * scene, no plugin and no device.
 *
 * Every key that a spec, a scene file or -a can set: one table of names, types, ranges, defaults
 * and help, and the struct that they fill. Scene files, spec files, `-a KEY=VALUE` and `--help`
 * read this table. A new key is a member of fm_settings and a row of fm_keys; whoever uses its
 * value is code elsewhere, and a key that makes scenes or changes methods needs some.
 *
 * A value that may be an axis ("k=4,8,16", "k=4:64:*2", "k=4:16:+4") is kept as a list of texts in
 * a plan; one case has exactly one value for each key. */
#ifndef FM_SETTINGS_H
#define FM_SETTINGS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/path.h"
#include "base/text.h"
#include "fragmark/method.h"

typedef enum fm_generator {
    FM_GENERATOR_LAYERS,
    FM_GENERATOR_MESH, /* a file */
    /* Stand-ins for scenes that the papers used; generators/ has one file each. */
    FM_GENERATOR_BUNNY_IN_CUBE,
    FM_GENERATOR_PALACE,
    FM_GENERATOR_HAIRBALL,
    FM_GENERATOR_ENGINE,
    FM_GENERATOR_TEMPLE,
    FM_GENERATOR_HOTEL,
    FM_GENERATOR_IVY,
    FM_GENERATOR_FRAMES,      /* a sequence of draw calls, for the simulated GPU */
    FM_GENERATOR_STREAM,      /* the same, recorded: a file */
    FM_GENERATOR_ADVERSARIAL, /* the same, random, to break techniques */
    FM_GENERATOR_COUNT
} fm_generator;

/* Generators of sequences, for feed `frames`: bit g, generator g. */
#define FM_MAKES_FRAMES                                                                            \
    (1u << FM_GENERATOR_FRAMES | 1u << FM_GENERATOR_STREAM | 1u << FM_GENERATOR_ADVERSARIAL)

typedef enum fm_order {
    FM_ORDER_RANDOM,      /* layers arrive in one random order */
    FM_ORDER_RANDOM_CELL, /* a different order in each cell */
    FM_ORDER_ASCENDING,   /* nearest first */
    FM_ORDER_DESCENDING,
    FM_ORDER_CELL_MAJOR, /* all layers of a cell drawn consecutively, in one random order */
    FM_ORDER_COUNT
} fm_order;

typedef enum fm_depths {
    FM_DEPTHS_UNIFORM,   /* (i + 1) / 2^m, the smallest m that keeps them below 1 */
    FM_DEPTHS_CLUSTERED, /* eight clusters, steps of 2^-20 inside one */
    FM_DEPTHS_COPLANAR,  /* pairs of layers share a depth */
    FM_DEPTHS_ULP,       /* neighbouring floats from 0.5 on */
    FM_DEPTHS_SLOPED,    /* planes that cross one another */
    FM_DEPTHS_EQUAL,     /* all layers at 1/2 */
    FM_DEPTHS_STEP24,    /* (i + 1) 2^-24: what 24 bits can tell apart */
    FM_DEPTHS_ENDS,      /* the first at exactly 0, the last at exactly 1, others uniform */
    FM_DEPTHS_STEP32,    /* (i + 1) 2^-32: what floats can tell apart near 0 */
    FM_DEPTHS_DENORMAL,  /* (i + 1) 2^-149, below every normal float */
    FM_DEPTHS_PROJECTED, /* distances in equal ratios between planes at 1 and 10^7, as a perspective
                            projection gives them */
    FM_DEPTHS_COUNT
} fm_depths;

/* What the projection makes of distance. Reversed: 1 near and 0 far, where floats are finest; what
 * methods see is scene/hand_on.h's. */
typedef enum fm_depth { FM_DEPTH_NORMAL, FM_DEPTH_REVERSED, FM_DEPTH_COUNT } fm_depth;

typedef enum fm_colours {
    FM_COLOURS_HASH,  /* a different colour for each layer */
    FM_COLOURS_CYCLE, /* eight colours in turn, as k+-buffer's scenes */
    FM_COLOURS_GREY,
    FM_COLOURS_COUNT
} fm_colours;

typedef enum fm_alphas {
    FM_ALPHAS_CONSTANT, /* `alpha` for each fragment */
    FM_ALPHAS_RANDOM,   /* uniform in (0, alpha] by layer */
    FM_ALPHAS_COUNT
} fm_alphas;

typedef enum fm_lock { FM_LOCK_SPIN, FM_LOCK_INTERLOCK, FM_LOCK_COUNT } fm_lock;
/* How a spin lock is let go: by what the device needs, a plain store, or an atomic exchange. */
typedef enum fm_release {
    FM_RELEASE_AUTO,
    FM_RELEASE_STORE,
    FM_RELEASE_EXCHANGE,
    FM_RELEASE_COUNT
} fm_release;
typedef enum fm_buffers {
    FM_BUFFERS_AUTO,
    FM_BUFFERS_BOUND,
    FM_BUFFERS_ADDRESS,
    FM_BUFFERS_COUNT
} fm_buffers;
typedef enum fm_pool { FM_POOL_PREALLOCATED, FM_POOL_PER_FRAME, FM_POOL_COUNT } fm_pool;
typedef enum fm_full_screen {
    FM_FULL_SCREEN_COMPUTE,
    FM_FULL_SCREEN_FRAGMENT,
    FM_FULL_SCREEN_COUNT
} fm_full_screen;
/* What has a timer: each pass, or all of them one. */
typedef enum fm_timers { FM_TIMERS_PASSES, FM_TIMERS_FRAME, FM_TIMERS_COUNT } fm_timers;

/* To what the compositor behind fm_emit rounds after each fragment, and from which end it goes. */
typedef enum fm_accumulate {
    FM_ACCUMULATE_FLOAT32,
    FM_ACCUMULATE_FLOAT16,
    FM_ACCUMULATE_UNORM8,
    FM_ACCUMULATE_COUNT
} fm_accumulate;
typedef enum fm_composite {
    FM_COMPOSITE_FRONT_TO_BACK,
    FM_COMPOSITE_BACK_TO_FRONT,
    FM_COMPOSITE_COUNT
} fm_composite;

/* Culling by an occupancy map, before the method's own passes. */
typedef enum fm_culling { FM_CULLING_NONE, FM_CULLING_OCCUPANCY, FM_CULLING_COUNT } fm_culling;
typedef enum fm_cull_range {
    FM_CULL_RANGE_HULL,
    FM_CULL_RANGE_AABB,
    FM_CULL_RANGE_EXACT,
    FM_CULL_RANGE_COUNT
} fm_cull_range;
typedef enum fm_cull_test {
    FM_CULL_TEST_EARLY,
    FM_CULL_TEST_SHADER,
    FM_CULL_TEST_COUNT
} fm_cull_test;
typedef enum fm_cull_memory {
    FM_CULL_MEMORY_OWN,
    FM_CULL_MEMORY_SHARED,
    FM_CULL_MEMORY_COUNT
} fm_cull_memory;
typedef enum fm_own_cull { FM_OWN_CULL_ON, FM_OWN_CULL_OFF, FM_OWN_CULL_COUNT } fm_own_cull;

enum { FM_TEXT_MAX = 256 };
#define FM_NOT_GIVEN UINT32_MAX

/* One value for each key. Settings with equal values are equal as bytes, their texts too:
 * text_shared keeps one copy of each. */
typedef struct fm_settings {
    /* viewport */
    uint32_t width_px, height_px;
    fm_generator generator;
    fm_depth depth;

    /* layers */
    uint32_t n; /* layers; 0 is an empty scene; FM_NOT_GIVEN until settings_finish. Meshes: 0 */
    uint32_t r; /* n = r * k; 0: not given. Kept for the record: n alone makes the scene */
    double pixel_density; /* of bunny-in-cube too */
    double fragment_probability;
    uint32_t tessellation;
    fm_order order;
    fm_depths depths;
    fm_colours colours;
    fm_alphas alphas;
    double alpha;
    uint64_t seed;

    /* mesh, and what the generators of triangles share with it */
    const char *mesh;                      /* file; relative to the scene file that names it */
    double eye[3], target[3], up[3];       /* eye == target: fitted to the box of the mesh */
    double fov_deg, near_plane, far_plane; /* 0, 0: 0.4 and 1.7 of the box's distance */
    double zoom;                           /* of the fitted camera */
    uint32_t instances;
    double instance_offset[3]; /* in box sizes */

    /* frames: what generators/frame_sequences.h makes of them; adversarial: adversarial.h there;
     * stream: frame_stream.h */
    const char *stream; /* file; relative to the scene file that names it */
    uint32_t sequence_frames;
    uint32_t backgrounds, sprites, triangles;
    double object_px, depth_complexity, front_to_back;
    double camera_px, camera_moves, moving;
    double hud, hud_opaque, hidden_churn, translucent;
    uint32_t fragment_instructions, vertex_instructions;
    double texture_bytes;

    /* method and run */
    const char *model; /* techniques: "NAME=VALUE ..." of simulator/models/parameters.yml */
    double exposure;   /* stops; of pictures before they are compared: truth/reference.h */
    uint32_t k;        /* 0: the method does not use it */
    fm_lock lock;
    fm_release release;
    fm_buffers buffers;
    fm_pool pool;
    fm_full_screen full_screen;
    fm_timers timers;
    fm_culling culling;
    uint32_t cull_words; /* of 32 buckets each */
    fm_cull_range cull_range;
    fm_cull_test cull_test;
    fm_cull_memory cull_memory;
    fm_own_cull own_cull; /* whether exclusive passes ask wanted() */
    fm_accumulate accumulate;
    fm_composite composite;
    uint32_t launches, frames, warmup;
    double precision_percent; /* of frame_ms: decide/precision.h; 0: launches are a fixed number */
} fm_settings;

/* JSON's integers have a sign. */
#define FM_KEY_UINT64_MAX ((uint64_t)INT64_MAX)

typedef enum fm_key_type {
    FM_KEY_UINT,    /* uint32_t */
    FM_KEY_UINT64,  /* uint64_t, FM_KEY_UINT64_MAX at most */
    FM_KEY_REAL,    /* double */
    FM_KEY_PERCENT, /* double, written with its sign: "2%" */
    FM_KEY_VECTOR,  /* double[3], "x y z" or a YAML sequence */
    FM_KEY_ENUM,    /* int-sized enum, by the names in `values` */
    FM_KEY_TEXT,    /* const char *, of text_shared; shorter than FM_PATH_MAX_BYTES */
} fm_key_type;

typedef enum fm_key_scope {
    FM_SCOPE_SCENE, /* legal in scene files, specs and -a; part of a scene's hash */
    FM_SCOPE_CASE,  /* specs and -a; makes different cases */
    FM_SCOPE_RUN,   /* specs and -a; one value a run: how often a case is measured */
} fm_key_scope;

typedef struct fm_key {
    const char *name; /* the column of summary.csv where there is one */
    fm_key_type type;
    fm_key_scope scope;
    size_t offset;             /* in fm_settings */
    double low, high;          /* numbers: inclusive range */
    const char *fallback;      /* default, as text */
    const char *const *values; /* enums: [value_count] names, by enumerator */
    size_t value_count;
    const char *unit;    /* "px", "" */
    const char *help;    /* one line */
    uint32_t generators; /* scene keys: bit g: generator g reads it; 0: all do */
    bool optional;       /* FM_KEY_UINT, FM_KEY_PERCENT: "none" is a value too, kept as `absent` */
    uint32_t absent;
    const char *with;   /* case keys: changes nothing while this other key is at its default */
    bool is_quiet;      /* at its default it is not part of a case's id, or of a scene's hash, which
                           so stays what it was before there was the key */
    bool is_of_picture; /* case keys: pictures, and so errors, of two values do not compare */
} fm_key;

enum { FM_MAX_KEYS = 128 };
extern const fm_key fm_keys[];
extern const size_t fm_key_count;

/* NULL: no such key. */
const fm_key *key_find(const char *name);
/* The known key nearest in spelling to name: for messages. */
const char *key_nearest(const char *name);
/* The key (`mesh`, `stream`) that names the file which is part of the generator's scenes, and what
 * it names; NULL: there is none. */
const char *settings_file_key(const fm_settings *settings);
const char *settings_file(const fm_settings *settings);
/* Whether scenes of this generator are sequences of frames, for feed `frames`. */
bool generator_makes_frames(fm_generator generator);
/* Whether scenes of this generator read the key; true for keys that are not a scene's. */
bool key_is_read(const fm_key *key, fm_generator generator);
/* What values a key takes, in a few words: "1..16384", "spin|interlock". */
void key_domain(char text[FM_TEXT_MAX], const fm_key *key);
/* The whole table as aligned lines, for --help. */
void keys_help(fm_text *text);

/* All defaults. */
void settings_default(fm_settings *settings);
/* Sets one key from text. FM_INVALID: wrong type or out of range, saying which values are legal. */
fm_status settings_set(fm_settings *settings, const fm_key *key, const char *text, fm_error *err);
/* One key's value as canonical text ("0.25", "random-cell"): settings_set takes it back. */
void settings_text(char text[FM_PATH_MAX_BYTES], const fm_settings *settings, const fm_key *key);
/* Whether the key may change something; keys that may not are better at their default. */
bool settings_key_matters(const fm_settings *settings, const fm_key *key);
/* Checks what concerns several keys and completes n: n = r * k, r being 4 if neither n nor r was
 * given. FM_INVALID: n and r that contradict each other, neither without a k, too many fragments, a
 * mesh scene without a mesh, clip planes out of order. Finished settings, also with k then set to 0
 * (not used), pass again unchanged, so that they can travel as texts. */
fm_status settings_finish(fm_settings *settings, fm_error *err);
/* What a truth is made with: the same scene, and every key of a case at its default. `settings` are
 * finished, and so is *truth. */
void settings_for_truth(fm_settings *truth, const fm_settings *settings);
/* Raise it when the generator's code makes something else of the same settings: the scene's hash
 * changes with it, so that no truth and no result of before is taken for the new scene's. */
uint32_t generator_version(fm_generator generator);
/* xxhash of all scene keys that this settings' generator uses, as 16 hex digits, begun with the
 * generator's version. Mesh files enter by their content (their name, if they cannot be read); r
 * does not enter, for n does. */
void settings_scene_hash(char hash[17], const fm_settings *settings);
/* The same for a mesh whose digest is known: reads no file. */
void settings_scene_hash_of(char hash[17], const fm_settings *settings, uint64_t mesh_digest);
/* The same under another version of the generator. */
void settings_scene_hash_with(char hash[17], const fm_settings *settings, uint64_t mesh_digest,
                              uint32_t version);
/* The digest of a mesh file's content. FM_IO: it cannot be read. FM_INVALID: no regular file. */
fm_status settings_mesh_digest(uint64_t *digest, const char *path, fm_error *err);

#endif
