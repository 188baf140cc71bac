/* Descriptors of plugins: what is refused, and in which words. */
#include "check_kit.h"

/* A descriptor that uses most of the interface and is right. */
static fm_method_desc sound(void)
{
    return (fm_method_desc){
        .abi = FM_ABI,
        .size_bytes = sizeof(fm_method_desc),
        .id = "sound-2",
        .title = "Sound",
        .citation = "none",
        .version = "1",
        .options = { { .name = "layout", .values = { "pixel", "layer-major" } },
                     { .name = "pages", .values = { "4", "8" } } },
        .resources = { { .name = "fragments",
                         .element = FM_ELEMENT_UVEC2,
                         .extent = { .per_total = 1, .total = "stored" },
                         .sizing = FM_SIZE_AFTER_TOTAL },
                       { .name = "counts",
                         .element = FM_ELEMENT_UINT,
                         .extent = { .per_pixel = 1, .per_option = 2, .option = "pages" },
                         .ping_pong = true },
                       { .name = "pool",
                         .extent = { .constant = 64 },
                         .sizing = FM_SIZE_GROW,
                         .overflow = "no-room" },
                       { .name = "colour",
                         .kind = FM_RESOURCE_IMAGE,
                         .format = FM_FORMAT_RGBA8,
                         .samples = 4 },
                       { .name = "depth",
                         .kind = FM_RESOURCE_IMAGE,
                         .format = FM_FORMAT_D32F_S8,
                         .samples = 4,
                         .clear_depth = 1.0f } },
        .totals = { { .name = "stored", .resource = "counts", .sum = true, .pass = "count" },
                    { .name = "no-room", .resource = "pool", .index = 63, .pass = "store" },
                    { .name = "passed", .pass = "store" } },
        .passes = { { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "counts", "pool" } },
                    { .name = "count", .shader = "count.glsl", .writes = { "counts" } },
                    { .name = "peel",
                      .kind = FM_PASS_PIXELS,
                      .shader = "other/peel.glsl",
                      .reads = { "counts_previous" },
                      .writes = { "counts" } },
                    { .name = "store",
                      .shader = "store.glsl",
                      .writes = { "fragments", "pool" },
                      .targets = { { .resource = "colour", .blend = FM_BLEND_OVER } },
                      .state = { .depth_stencil = "depth",
                                 .depth_test = FM_COMPARE_LESS,
                                 .depth_write = true,
                                 .stencil_test = FM_COMPARE_EQUAL },
                      .exclusive = true },
                    { .name = "spread",
                      .kind = FM_PASS_TOTAL,
                      .shader = "spread.glsl",
                      .count_total = "stored" },
                    { .name = "resolve",
                      .kind = FM_PASS_PIXELS,
                      .shader = "resolve.glsl",
                      .reads = { "fragments" },
                      .emits = true } },
        .loops = { { .first = "count", .last = "store", .until_zero = "passed" },
                   { .first = "count", .last = "peel", .count_per_k = 1 } },
    };
}

static fm_next never(const fm_workload *workload, const char *pass)
{
    (void)workload;
    (void)pass;
    return FM_NEXT;
}

/* CHANGE works on `m`, a sound descriptor. */
#define REFUSES(CHANGE, MESSAGE)                                                                   \
    do {                                                                                           \
        fm_method_desc m = sound();                                                                \
        CHANGE;                                                                                    \
        assert_check_fails(&m, MESSAGE);                                                           \
    } while (0)

#define ACCEPTS(CHANGE)                                                                            \
    do {                                                                                           \
        fm_method_desc m = sound();                                                                \
        fm_error err = { .message = "" };                                                          \
        CHANGE;                                                                                    \
        if (plugin_check(&m, "test", &err) != FM_OK)                                               \
            fail_msg("%s", err.message);                                                           \
    } while (0)

enum { FRAGMENTS, COUNTS, POOL, COLOUR, DEPTH };
enum { CLEAR, COUNT, PEEL, STORE, SPREAD, RESOLVE };
#define REST "m needs a name" /* of entries behind the end of a list */

static void plugin_check_takes_a_sound_descriptor(void **state)
{
    (void)state;
    const fm_method_desc m = sound();
    fm_error err = { 0 };
    if (plugin_check(&m, "x.so", &err) != FM_OK)
        fail_msg("%s", err.message);
}

static void plugin_check_works_without_an_error(void **state)
{
    (void)state;
    fm_method_desc m = sound();
    m.id = NULL;
    assert_int_equal(plugin_check(&m, "x.so", NULL), FM_INVALID);
}

static void plugin_check_rejects_bad_heads(void **state)
{
    (void)state;
    REFUSES(m.abi = 0, "abi: the plugin has 0");
    REFUSES(m.abi = FM_ABI - 1, "older than this program's");
    REFUSES(m.abi = FM_ABI + 1, "newer than this program's");
    REFUSES(m.size_bytes--, "size_bytes");
    REFUSES(m.id = NULL, "id");
    REFUSES(m.id = "", "id");
    REFUSES(m.id = "Sound", "id: 'Sound'");
    REFUSES(m.id = "two--hyphens", "id");
    REFUSES(m.id = "end-", "id");
    REFUSES(m.id = "common", "id");
    REFUSES(m.id = "a234567890123456789012345678901234567890123456789012345678901234",
            "63 letters");
    REFUSES(m.title = NULL, "title: missing");
    REFUSES(m.citation = "", "citation: missing");
    REFUSES(m.citation = "Andr\xE9, 2007", "citation: not UTF-8");
    REFUSES(m.title = "\xC3", "title: not UTF-8");
    REFUSES(m.options[0].help = "\xFF", "help: not UTF-8");
    REFUSES(m.version = NULL, "version: missing");
    REFUSES(m.traits = 1u << 31, "traits: unknown bits 0x80000000");
    REFUSES(m.traits = FM_TRAIT_EXACT | FM_TRAIT_APPROXIMATE, "exclude each other");
    REFUSES(m.traits = FM_TRAIT_EMITS_BACK | FM_TRAIT_EMITS_EITHER, "emits_either exclude each");
    ACCEPTS(m.traits = FM_TRAIT_MULTISAMPLED);
    REFUSES(
        (m.traits = FM_TRAIT_MULTISAMPLED, m.resources[3].samples = 1, m.resources[4].samples = 1),
        "multisampled, but no image has samples");
    REFUSES(m.features = 1u << 30, "features");
    REFUSES(m.features_optional = 1u << 30, "features_optional");
    REFUSES(m.feeds = 1u << 6, "feeds");
    REFUSES(m.feeds = FM_FEED_TRIANGLES | FM_FEED_RASTER, "feeds: FM_FEED_TRIANGLES stands alone");
    REFUSES(m.keeps = FM_KEEPS_COUNT, "keeps");
    REFUSES(m.k_total = "sorted", "k_total 'sorted': no such total; nearest is 'stored'");
    REFUSES((m.k_total = "stored", m.keeps = FM_KEEPS_ALL), "only with FM_KEEPS_K_NEAREST");
    REFUSES(m.family = FM_FAMILY_COUNT, "family");
    REFUSES(m.marker = FM_MARKER_COUNT, "marker");
}

static void plugin_check_rejects_bad_options(void **state)
{
    (void)state;
    REFUSES(m.options[0].name = "Layout", "option 'Layout': needs lower-case");
    REFUSES(m.options[0].name = "pages", "options[1]: 'pages' is there twice");
    REFUSES(m.options[0].name = "fm-x", "reserved");
    REFUSES(m.options[0].name = "n", "option 'n'");
    REFUSES(m.options[0].name = "lock", "option 'lock': the runner has a key");
    REFUSES(m.options[0].values[0] = NULL, "values[1]");
    REFUSES(m.options[0].values[1] = "pixel", "twice");
    REFUSES(m.options[0].values[1] = "a b", "value 'a b'");
    REFUSES((m.options[2] = (fm_option){ "bias", { "1", "-1" }, NULL }),
            "option 'bias': its macro would be 'bias__1', which is reserved");
    REFUSES((m.options[2] = (fm_option){ "scale", { "0.5", "1" }, NULL },
             m.options[3] = (fm_option){ "scale-0-5", { "on" }, NULL }),
            "option 'scale-0-5': its macro 'scale_0_5' is there already");
    ACCEPTS((m.options[2] = (fm_option){ "scale", { "0.5", "1" }, NULL }));
    REFUSES(m.options[1].values[1] = "8.5", "its value '8.5' is no whole number");
    REFUSES((m.options[2] = (fm_option){ "layout-pixel", { "on" }, NULL }), "there already");
    REFUSES((m.options[2] = (fm_option){ "empty", { NULL }, NULL }), "values: none");
    REFUSES(m.options[4].name = REST, "options[4]");
}

static void plugin_check_rejects_bad_resource_names(void **state)
{
    (void)state;
    REFUSES(m.resources[POOL].name = "Pool", "resource 'Pool': needs lower-case");
    REFUSES(m.resources[POOL].name = "my-pool", "needs lower-case");
    REFUSES(m.resources[POOL].name = "1pool", "needs lower-case");
    REFUSES(m.resources[POOL].name = "fm_pool", "reserves");
    REFUSES(m.resources[POOL].name = "gl_pool", "reserves");
    REFUSES(m.resources[POOL].name = "my__pool", "reserves");
    REFUSES(m.resources[POOL].name = "buffer", "reserves");
    REFUSES(m.resources[POOL].name = "writeonly", "reserves");
    REFUSES(m.resources[POOL].name = "active", "reserves");
    REFUSES(m.resources[POOL].name = "store", "reserves");
    REFUSES(m.resources[POOL].name = "counts", "twice");
    REFUSES(m.resources[POOL].name = "", "empty name");
    REFUSES(m.resources[POOL].name = "counts_previous", "other copy of 'counts'");
    REFUSES(m.resources[9].name = REST, "resources[9]");
}

static void plugin_check_rejects_bad_buffers(void **state)
{
    (void)state;
    REFUSES(m.resources[POOL].kind = FM_RESOURCE_KIND_COUNT, "kind");
    REFUSES(m.resources[POOL].element = FM_ELEMENT_COUNT, "element");
    REFUSES(m.resources[POOL].element = FM_ELEMENT_UINT64, "FM_FEATURE_INT64_ATOMICS");
    REFUSES(m.resources[POOL].format = FM_FORMAT_R32F, "a buffer has no format");
    REFUSES(m.resources[POOL].extent.constant = 0, "zero-sized buffer");
    REFUSES(m.resources[POOL].extent.per_pixel = 4097, "4096 at most");
    REFUSES(m.resources[POOL].extent.constant = UINT64_MAX, "at most");
    REFUSES(m.resources[POOL].used.per_fragment = 4097, "4096 at most");
    REFUSES(m.resources[POOL].extent.per_total = 1, "needs extent.total");
    REFUSES(m.resources[POOL].extent.total = "stored", "needs extent.per_total");
    REFUSES(m.resources[FRAGMENTS].extent.total = "sorted", "no such total; nearest is 'stored'");
    REFUSES(m.resources[FRAGMENTS].sizing = FM_SIZE_FIXED, "needs FM_SIZE_AFTER_TOTAL");
    REFUSES(m.resources[COUNTS].sizing = FM_SIZE_AFTER_TOTAL, "needs extent.total");
    REFUSES(m.resources[COUNTS].sizing = FM_SIZE_COUNT, "sizing");
    REFUSES(m.resources[COUNTS].extent.option = "page", "no such option; nearest is 'pages'");
    REFUSES(m.resources[COUNTS].extent.option = "layout", "no whole number");
    REFUSES(m.resources[COUNTS].extent.option = NULL, "needs extent.option");
    REFUSES(m.resources[COUNTS].extent.per_pixel_option = 4097, "4096 at most");
    REFUSES(m.resources[POOL].extent.per_pixel_option = 1, "needs extent.option");
    REFUSES(m.resources[POOL].extent.k_step = 2, "extent.k_step: needs extent.per_pixel_k");
    REFUSES(m.options[1].values[1] = "1048577", "no whole number up to 1048576");
    REFUSES(m.resources[POOL].samples_option = "pages", "a buffer has no");
    REFUSES(m.resources[POOL].extent.per_fragment = 1, "extent.per_fragment: only `grown` has it");
    REFUSES(m.resources[POOL].grown.per_total = 1, "grown.per_total: needs grown.total");
    REFUSES((m.resources[POOL].grown.per_total = 1, m.resources[POOL].grown.total = "stord"),
            "grown.total 'stord': no such total; nearest is 'stored'");
    REFUSES(m.resources[POOL].grown.per_fragment = 4097, "grown: a factor of 4097, 4096 at most");
    REFUSES(m.resources[COUNTS].grown.per_pixel = 1, "grown: only with FM_SIZE_GROW");
    REFUSES(m.resources[COLOUR].grown.per_pixel = 1, "viewport's size");
    ACCEPTS((m.resources[POOL].grown.per_fragment = 3));
    REFUSES(m.resources[POOL].overflow = NULL, "needs overflow");
    REFUSES(m.resources[POOL].overflow = "no-rom", "nearest is 'no-room'");
    REFUSES(m.resources[COUNTS].overflow = "no-room", "only with FM_SIZE_GROW");
    REFUSES(m.resources[COUNTS].shares = "fragmets", "nearest is 'fragments'");
    REFUSES(m.resources[COUNTS].shares = "counts", "shares 'counts': both");
    REFUSES(m.resources[COUNTS].shares = "pool", "shares 'pool': both");
    ACCEPTS(
        (m.resources[DEPTH + 1] =
             (fm_resource){ .name = "sharer", .extent = { .constant = 2 }, .shares = "owner" },
         m.resources[DEPTH + 2] = (fm_resource){ .name = "owner", .extent = { .constant = 1 } }));
}

static void plugin_check_rejects_bad_images(void **state)
{
    (void)state;
    REFUSES(m.resources[COLOUR].format = FM_FORMAT_NONE, "format: missing");
    REFUSES(m.resources[COLOUR].format = FM_FORMAT_COUNT, "format");
    REFUSES(m.resources[COLOUR].samples = 3, "power of two");
    REFUSES(m.resources[COLOUR].samples = 64, "power of two");
    REFUSES(m.resources[COLOUR].samples_per_k = 17, "samples_per_k");
    REFUSES(m.resources[COLOUR].layers = 4096, "layers");
    REFUSES(m.resources[COLOUR].extent.constant = 1, "extent: an image has the viewport's size");
    REFUSES(m.resources[COLOUR].extent.per_tile = 1, "extent: an image has the viewport's size");
    REFUSES(m.resources[COLOUR].extent.per_pixel_k = 4097, "extent: a factor of 4097");
    REFUSES(m.resources[COLOUR].extent.per_pixel_option = 1, "needs extent.option");
    REFUSES((m.resources[COLOUR].extent.per_pixel_n = 1, m.resources[COLOUR].layers_per_k = 1),
            "extent: layers are set too");
    ACCEPTS((m.resources[COLOUR].extent.per_pixel_k = 1, m.resources[COLOUR].extent.k_step = 2));
    REFUSES(m.resources[DEPTH].clear_depth = 1.5f, "clear_depth");
    REFUSES(m.resources[DEPTH].clear_stencil = 256, "clear_stencil");
    REFUSES(m.resources[COLOUR].clear_words[3] = 1, "clear_words: for integer formats");
    REFUSES(m.resources[POOL].clear_words[0] = 1, "clear_words: for images");
    REFUSES((m.resources[COLOUR].format = FM_FORMAT_R32UI, m.resources[COLOUR].clear_words[0] = 1,
             m.resources[COLOUR].clear_colour[0] = 1.0f),
            "clear_colour: clear_words is set too");
}

static void plugin_check_rejects_bad_totals(void **state)
{
    (void)state;
    REFUSES(m.totals[0].name = "Stored", "total");
    REFUSES(m.totals[0].pass = NULL, "total 'stored': pass: missing");
    REFUSES(m.totals[0].pass = "counts", "no such pass; nearest is 'count'");
    REFUSES(m.passes[COUNT].narrow_only = true, "pass 'count': is left out on some devices");
    REFUSES(m.totals[0].resource = "fragments", "FM_ELEMENT_UINT");
    REFUSES(m.totals[0].resource = "colour", "FM_ELEMENT_UINT");
    REFUSES(m.totals[0].resource = "count", "nearest is 'counts'");
    REFUSES(m.totals[0].index = 1, "index: not with sum");
    REFUSES(m.totals[1].index = 64, "'pool' has 64 elements");
    REFUSES(m.totals[2].pass = "resolve", "scene passes only");
    REFUSES(m.totals[2].sum = true, "need resource");
    REFUSES(m.totals[0].late = true, "late: not with loops");
    REFUSES((memset(m.loops, 0, sizeof m.loops), m.totals[0].late = true),
            "late: not with count_total");
    REFUSES((memset(m.loops, 0, sizeof m.loops), m.totals[1].late = true),
            "late: not with overflow");
    REFUSES(m.totals[2].late = true, "late: needs resource");
    REFUSES((memset(m.loops, 0, sizeof m.loops), m.passes[SPREAD].kind = FM_PASS_PIXELS,
             m.passes[SPREAD].count_total = NULL, m.after = never, m.totals[0].late = true),
            "late: not with after");
    REFUSES(m.totals[5].name = REST, "totals[5]");
}

static void plugin_check_rejects_bad_passes(void **state)
{
    (void)state;
    REFUSES(memset(m.passes, 0, sizeof m.passes), "");
    REFUSES(m.passes[RESOLVE].name = "Resolve", "name: needs lower-case");
    REFUSES(m.passes[RESOLVE].name = "store", "twice");
    REFUSES(m.passes[RESOLVE].name = "cull-fill", "culling's own");
    REFUSES(m.passes[SPREAD].name = "sample", "reserved");
    REFUSES(m.passes[SPREAD].name = "pool", "resource's name too");
    REFUSES(m.passes[COUNT].kind = FM_PASS_KIND_COUNT, "kind");
    REFUSES(m.passes[COUNT].shader = NULL, "pass 'count': shader: missing");
    REFUSES(m.passes[CLEAR].shader = "clear.glsl", "has none");
    REFUSES(m.passes[COUNT].shader = "../count.glsl", "needs 'file.glsl'");
    REFUSES(m.passes[COUNT].shader = "/tmp/count.glsl", "needs 'file.glsl'");
    REFUSES(m.passes[COUNT].shader = "a/b/count.glsl", "needs 'file.glsl'");
    REFUSES(m.passes[COUNT].shader = "count", "needs 'file.glsl'");
    REFUSES(m.passes[COUNT].shader = ".glsl", "needs 'file.glsl'");
    REFUSES(m.passes[CLEAR].writes[0] = NULL, "writes[1]");
    REFUSES(m.passes[COUNT].writes[0] = "fragmets", "nearest is 'fragments'");
    REFUSES(m.passes[PEEL].writes[0] = "counts_previous", "can only be read");
    REFUSES(m.passes[PEEL].reads[0] = "pool_previous", "ping_pong is not set");
    REFUSES(m.passes[CLEAR].reads[0] = "pool", "no reads");
    REFUSES(m.passes[COUNT].clear_word = 1, "clear_word");
    REFUSES(m.passes[RESOLVE].exclusive = true, "exclusive");
    REFUSES(m.passes[RESOLVE].flat_tessellation = true, "flat_tessellation");
    REFUSES(m.passes[STORE].cover = FM_COVER_COUNT, "cover");
    REFUSES(m.passes[STORE].resumes = FM_RESUMES_BY_N, "resumes: only passes over pixels can");
    REFUSES(m.passes[RESOLVE].resumes = FM_RESUMES_COUNT, "resumes");
    ACCEPTS(m.passes[RESOLVE].resumes = FM_RESUMES_BY_N_K);
    REFUSES(m.passes[STORE].cover = FM_COVER_HULL, "cover: only scene passes");
    REFUSES((m.feeds = FM_FEED_RASTER, m.passes[RESOLVE].cover = FM_COVER_HULL),
            "cover: only scene passes");
    ACCEPTS((m.feeds = FM_FEED_RASTER, m.passes[STORE].cover = FM_COVER_HULL));
    REFUSES(m.passes[STORE].flat_option = "layout", "flat_option: needs flat_tessellation");
    REFUSES(m.passes[CLEAR].emits = true, "emits");
    REFUSES(m.passes[STORE].emits = true, "emits: a pass of kind scene cannot");
    REFUSES(m.passes[RESOLVE].emits = false, "none emits");
    REFUSES(m.passes[RESOLVE].narrow_only = true, "none emits");
    REFUSES(m.passes[COUNT].lanes = 2, "lanes: a pass of kind");
    REFUSES(m.passes[SPREAD].lanes = 3, "lanes: 3: a power of two");
    REFUSES(m.passes[SPREAD].lanes = 128, "lanes: 128: a power of two, 64 at most");
    REFUSES(m.passes[SPREAD].lanes_narrow = 3, "lanes_narrow: 3: a power of two");
    REFUSES(m.passes[COUNT].lanes_narrow = 2, "lanes_narrow: a pass of kind");
    REFUSES(m.feeds = FM_FEED_TRIANGLES, "kind scene: the feed triangles has no fragments");
    REFUSES(m.passes[SPREAD].count_total = NULL, "count_total: needed");
    REFUSES(m.passes[SPREAD].count_total = "store", "nearest is 'stored'");
    REFUSES(m.passes[COUNT].count_total = "stored", "count_total");
    REFUSES(m.passes[COUNT].indirect = "counts", "indirect");
    REFUSES(m.passes[9].name = REST, "passes[9]");
}

/* Of "counts" one word a pixel, which the exclusive pass writes. */
static fm_method_desc with_lock_word(void)
{
    fm_method_desc m = sound();
    m.options[1].values[0] = "lock";
    m.options[1].values[1] = "own";
    m.resources[1].extent = (fm_extent){ .per_pixel = 1 };
    m.resources[1].ping_pong = false;
    m.passes[PEEL].reads[0] = NULL;
    m.passes[STORE].writes[2] = "counts";
    m.passes[STORE].lock_word = "counts";
    m.passes[STORE].lock_word_option = "pages";
    return m;
}

static void plugin_check_rejects_bad_lock_words(void **state)
{
    (void)state;
    ACCEPTS(m = with_lock_word());
    ACCEPTS((m = with_lock_word(), m.passes[STORE].lock_word_option = NULL));
    REFUSES((m = with_lock_word(), m.passes[STORE].lock_word = NULL),
            "lock_word_option: needs lock_word");
    REFUSES((m = with_lock_word(), m.passes[STORE].lock_word_option = "page"),
            "lock_word_option 'page': no such option; nearest is 'pages'");
    REFUSES((m = with_lock_word(), m.passes[STORE].lock_word_option = "layout"),
            "lock_word_option 'layout': has no value 'lock'");
    REFUSES((m = with_lock_word(), m.passes[STORE].exclusive = false),
            "lock_word: only exclusive passes have one");
    REFUSES((m = with_lock_word(), m.passes[STORE].lock_word = "count"),
            "lock_word 'count': does not stand in writes");
    REFUSES((m = with_lock_word(), m.passes[STORE].lock_word = "pool"),
            "lock_word 'pool': needs one word a pixel");
    REFUSES((m = with_lock_word(), m.passes[STORE].lock_word = "fragments"),
            "lock_word 'fragments': needs one word a pixel");
    REFUSES((m = with_lock_word(), m.resources[5] = (fm_resource){ .name = "sharer",
                                                                   .extent = { .per_pixel = 1 },
                                                                   .shares = "counts" }),
            "lock_word 'counts': 'sharer' shares its memory");
    REFUSES((m = with_lock_word(), m.resources[1].extent.constant = 1),
            "lock_word 'counts': needs one word a pixel");
}

/* Fields of ABI 5 that nothing uses so far: whoever asks for one is told so. */
static void plugin_check_rejects_what_is_not_there_yet(void **state)
{
    (void)state;
    REFUSES(m.needs_interlock = true, "x.so: needs_interlock: not yet");
    REFUSES(m.passes[STORE].ordered_interlock = true,
            "x.so: pass 'store': ordered_interlock: not yet");
    REFUSES(m.passes[STORE].targets_after_lock = true,
            "x.so: pass 'store': targets_after_lock: not yet");
    REFUSES(m.passes[COUNT].writes_sample_mask = true,
            "x.so: pass 'count': writes_sample_mask: not yet");
    REFUSES(m.passes[RESOLVE].shared_sort = true, "x.so: pass 'resolve': shared_sort: not yet");
}

static void plugin_check_takes_every_known_trait(void **state)
{
    (void)state;
    const uint32_t excluded = FM_TRAIT_EXACT | FM_TRAIT_EMITS_BACK;
    ACCEPTS(m.traits = FM_TRAITS_ALL & ~excluded);
    ACCEPTS(m.traits = excluded);
}

static void plugin_check_rejects_bad_attachments(void **state)
{
    (void)state;
    REFUSES(m.passes[STORE].targets[0].resource = "depth", "needs a colour format");
    REFUSES(m.passes[STORE].targets[0].resource = "pool", "is a buffer");
    REFUSES(m.passes[STORE].targets[0].resource = "color", "nearest is 'colour'");
    REFUSES(m.passes[STORE].targets[0].blend = FM_BLEND_COUNT, "blend");
    REFUSES(m.passes[STORE].targets[0].load = FM_LOAD_COUNT, "load");
    REFUSES(m.resources[COLOUR].format = FM_FORMAT_R32UI, "do not blend");
    REFUSES(m.resources[COLOUR].samples = 1, "samples");
    REFUSES(m.resources[COLOUR].samples_per_k = 4, "4 + 0 k samples, the others have 4 + 4 k");
    REFUSES(m.resources[COLOUR].samples_option = "pages", "the others have those of 'pages'");
    REFUSES(m.resources[COLOUR].samples_option = "page", "samples_option 'page': no such option");
    REFUSES(m.resources[COLOUR].samples_option = "layout", "samples_option 'layout': its value");
    REFUSES(m.passes[SPREAD].targets[0].resource = "colour", "has none");
    REFUSES(m.passes[STORE].state.depth_stencil = "colour", "needs a depth format");
    REFUSES(m.passes[STORE].state.depth_stencil = NULL, "need depth_stencil");
    REFUSES(m.passes[SPREAD].state.depth_stencil = "depth", "has none");
    REFUSES(m.passes[STORE].state.depth_test = FM_COMPARE_OFF, "depth_write");
    REFUSES(m.passes[STORE].state.stencil_pass = FM_STENCIL_OP_COUNT, "stencil_pass");
    REFUSES(m.passes[STORE].state.stencil_reference = 256, "stencil_reference");
    REFUSES(m.resources[DEPTH].format = FM_FORMAT_D32F, "FM_FORMAT_D32F_S8");
}

/* What steps in a counted loop may do so though the loop around that one ends by a total. */
static void plugin_check_asks_the_innermost_loop_of_a_step(void **state)
{
    (void)state;
    fm_method_desc m = sound();
    m.passes[PEEL].state.sample_mask_step = 1;
    m.loops[1].count_per_k = 0;
    m.loops[1].count_option = "pages";
    assert_int_equal(plugin_check(&m, "x.so", NULL), FM_OK);
}

static void plugin_check_rejects_bad_loops(void **state)
{
    (void)state;
    REFUSES(m.loops[0].last = NULL, "last: missing");
    REFUSES(m.loops[0].last = "stor", "nearest is 'store'");
    REFUSES(m.loops[0].last = "clear", "stands before");
    REFUSES(m.loops[1].first = "peel"; m.loops[1].last = "spread", "overlaps");
    REFUSES(m.loops[1].last = "store", "overlaps");
    REFUSES(m.loops[1].count_per_k = 0, "no end");
    REFUSES(m.loops[1].count_option = "page", "count_option 'page': no such option");
    REFUSES(m.loops[1].count_option = "layout", "count_option 'layout': its value");
    REFUSES(m.passes[STORE].state.sample_mask_step = 1, "pass 'store': need a loop of known count");
    REFUSES((m.passes[PEEL].state.sample_mask_step = 1, m.loops[1].until_zero = "passed"),
            "pass 'peel': need a loop of known count");
    REFUSES(m.loops[0].until_zero = "pased", "nearest is 'passed'");
    REFUSES(m.loops[3].first = "clear", "loops[3]");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plugin_check_takes_a_sound_descriptor),
        cmocka_unit_test(plugin_check_works_without_an_error),
        cmocka_unit_test(plugin_check_rejects_bad_heads),
        cmocka_unit_test(plugin_check_rejects_bad_options),
        cmocka_unit_test(plugin_check_rejects_bad_resource_names),
        cmocka_unit_test(plugin_check_rejects_bad_buffers),
        cmocka_unit_test(plugin_check_rejects_bad_images),
        cmocka_unit_test(plugin_check_rejects_bad_totals),
        cmocka_unit_test(plugin_check_rejects_bad_passes),
        cmocka_unit_test(plugin_check_rejects_bad_lock_words),
        cmocka_unit_test(plugin_check_rejects_what_is_not_there_yet),
        cmocka_unit_test(plugin_check_takes_every_known_trait),
        cmocka_unit_test(plugin_check_rejects_bad_attachments),
        cmocka_unit_test(plugin_check_rejects_bad_loops),
        cmocka_unit_test(plugin_check_asks_the_innermost_loop_of_a_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
