/* What methods ask for in bytes: their descriptors' formula, and the papers' own, written out. */
#include <stdio.h>
#include <string.h>

#include "kit/scene_kit.h"

typedef struct workload {
    uint64_t pixels, k, n, fragments;
    uint64_t kept;  /* F_k */
    uint64_t tiles; /* of 8 x 8 pixels */
    uint64_t pages; /* of 4 fragments */
} workload;

/* N pixels, k kept, n layers, F fragments; a fragment is 8 bytes, a counter or a lock 4. */
static uint64_t kplus(const workload *w)
{
    return (8 * w->k + 4 + 4) * w->pixels;
}

static uint64_t k_buffer(const workload *w)
{
    return 8 * w->k * w->pixels;
}

/* k_buffer and a flag. */
static uint64_t flagged_k_buffer(const workload *w)
{
    return k_buffer(w) + 4;
}

/* k_buffer and a lock. */
static uint64_t locked_k_buffer(const workload *w)
{
    return (8 * w->k + 4) * w->pixels;
}

static uint64_t a_buffer(const workload *w)
{
    return (8 * w->n + 4) * w->pixels;
}

/* A depth and a colour. */
static uint64_t z_buffer(const workload *w)
{
    return 8 * w->pixels;
}

/* A colour and two depths, whatever n and k are. */
static uint64_t peeling(const workload *w)
{
    return 12 * w->pixels;
}

/* Front, back and two intervals. */
static uint64_t dual_peeling(const workload *w)
{
    return 24 * w->pixels;
}

/* k samples of a fragment, a depth that nobody needs, and a stencil. */
static uint64_t routed(const workload *w)
{
    return (8 + 4 + 1) * w->k * w->pixels;
}

/* Eight slots; four samples of fragment, depth and stencil; the boundary and a flag. */
static uint64_t multipass_k_buffer(const workload *w)
{
    return (8 * 8 + 4) * w->pixels + 4;
}

/* Twelve sums and a maximum beside the records. */
static uint64_t coded_k_buffer(const workload *w)
{
    return k_buffer(w) + 13 * 4 * w->pixels;
}

/* Counter, lock, boundary of four words. */
static uint64_t multipass_kplus(const workload *w)
{
    return (8 * 8 + 4 + 4 + 16) * w->pixels + 4;
}

static uint64_t multipass_routed(const workload *w)
{
    return ((8 + 4 + 1) * 4 + 4) * w->pixels + 4;
}

/* Pairs of fragments. */
static uint64_t packed_k_buffer(const workload *w)
{
    return 16 * ((w->k + 1) / 2) * w->pixels;
}

/* A count more than dual_peeling. */
static uint64_t counted_dual_peeling(const workload *w)
{
    return 28 * w->pixels;
}

static uint64_t counted(const workload *w)
{
    return (8 * w->k + 4) * w->pixels;
}

/* Four sums and the revealage. */
static uint64_t weighted(const workload *w)
{
    return 20 * w->pixels;
}

/* Heads, nodes of fragment and link, two counters. The pool starts with a node a pixel. */
static uint64_t linked_list(const workload *w)
{
    const uint64_t nodes = w->fragments > w->pixels ? w->fragments : w->pixels;
    return 4 * w->pixels + 12 * nodes + 8;
}

/* Its nodes have a word that holds nothing. */
static uint64_t list_of_whole_nodes(const workload *w)
{
    const uint64_t nodes = w->fragments > w->pixels ? w->fragments : w->pixels;
    return 4 * w->pixels + 16 * nodes + 8;
}

/* As linked_list, with two nodes a pixel more instead of a head. */
static uint64_t sorted_list(const workload *w)
{
    return linked_list(w) + 20 * w->pixels;
}

static uint64_t sorted_list_of_whole_nodes(const workload *w)
{
    return list_of_whole_nodes(w) + (2 * 16 - 4) * w->pixels;
}

/* Eight heads and two bounds instead of a head. */
static uint64_t bucketed_list(const workload *w)
{
    return linked_list(w) + (8 * 4 + 2 * 4 - 4) * w->pixels;
}

static uint64_t buckets_of_whole_nodes(const workload *w)
{
    return list_of_whole_nodes(w) + (8 * 4 + 2 * 4 - 4) * w->pixels;
}

/* Head, counter and lock; a page is four fragments and a link. */
static uint64_t paged_list(const workload *w)
{
    return 12 * w->pixels + 36 * w->pages + 8;
}

/* An address more than a_buffer. */
static uint64_t addressed_a_buffer(const workload *w)
{
    return (8 * w->n + 8) * w->pixels;
}

/* Counter and address; the sums of the scan. */
static uint64_t scanned(const workload *w)
{
    return 8 * w->fragments + 8 * w->pixels + 4 * (2 * w->tiles + 3);
}

/* The k+-buffer of what is chosen, with memory enough and nothing discarded; histogram and choice.
 */
static uint64_t chosen_kplus(const workload *w)
{
    const uint64_t chosen = w->k < w->n ? w->k : w->n;
    return (8 * chosen + 4 + 4) * w->pixels + 4 * (1024 + 2);
}

/* The lock is in the counter. */
static uint64_t chosen_kplus_in_one(const workload *w)
{
    return chosen_kplus(w) - 4 * w->pixels;
}

/* Counter and address; one or 32 shared counters and as many prefix sums. */
static uint64_t l_buffer(const workload *w)
{
    return 8 * w->fragments + 8 * w->pixels + 8;
}

static uint64_t s_buffer(const workload *w)
{
    return 8 * w->fragments + 8 * w->pixels + 8 * 32;
}

/* A lock more than s_buffer, and only what is kept. */
static uint64_t kplus_in_s_buffer(const workload *w)
{
    return 8 * w->kept + 12 * w->pixels + 8 * 32;
}

static uint64_t kplus_in_s_buffer_in_one(const workload *w)
{
    return kplus_in_s_buffer(w) - 4 * w->pixels;
}

/* And a counter of triangles that are not finished. */
static uint64_t freepipe(const workload *w)
{
    return a_buffer(w) + 4;
}

static const struct formula {
    const char *method; /* and its options, if the bytes hang on them */
    uint64_t (*bytes)(const workload *);
} formulas[] = {
    { "kplus-array count_in=own", kplus },
    { "kplus-array count_in=lock", counted },
    { "kplus-heap count_in=own", kplus },
    { "kplus-heap count_in=lock", counted },
    { "kplus-dynamic count_in=own", chosen_kplus },
    { "kplus-dynamic count_in=lock", chosen_kplus_in_one },
    { "kplus-multipass", multipass_kplus },
    { "kb", k_buffer },
    { "kb-packed", packed_k_buffer },
    { "kb-mha", coded_k_buffer },
    { "kb-mha-blend", coded_k_buffer },
    { "kb-multipass", multipass_k_buffer },
    { "kb-sr-multipass", multipass_routed },
    { "dual-k", counted_dual_peeling },
    { "kb-mdt64", k_buffer },
    { "mlab", locked_k_buffer },
    { "kb-multi", flagged_k_buffer },
    { "kb-ll node=split", sorted_list },
    { "kb-ll node=whole", sorted_list_of_whole_nodes },
    { "kb-mdt32", k_buffer },
    { "loop32", k_buffer },
    { "loop64", k_buffer },
    { "kb-ps", locked_k_buffer },
    { "ab-array", a_buffer },
    { "z-buffer", z_buffer },
    { "ab-ll node=split", linked_list },
    { "ab-ll node=whole", list_of_whole_nodes },
    { "f2b", peeling },
    { "f2b-k", peeling },
    { "dual", dual_peeling },
    { "wboit", weighted },
    { "kb-sr", routed },
    { "kb-sr-counter", counted },
    { "ab-ll-bucket node=split", bucketed_list },
    { "ab-ll-bucket node=whole", buckets_of_whole_nodes },
    { "ab-ll-paged", paged_list },
    { "precalc-fixed", addressed_a_buffer },
    { "precalc-scan", scanned },
    { "l-buffer", l_buffer },
    { "s-buffer", s_buffer },
    { "freepipe-compute", freepipe },
    { "kb-ab-array", a_buffer },
    { "kb-ab-ll node=split", linked_list },
    { "kb-ab-ll node=whole", list_of_whole_nodes },
    { "kb-ab-sb", s_buffer },
    { "kplus-sb count_in=own", kplus_in_s_buffer },
    { "kplus-sb count_in=lock", kplus_in_s_buffer_in_one },
};

static void expect_formula(const struct formula *formula, const workload *w,
                           const fm_measurement *m)
{
    if (formula->bytes(w) != m->bytes_allocated)
        fail_msg("%s, %u pixels, k=%u, n=%u: %llu bytes, by the paper %llu", formula->method,
                 (unsigned)w->pixels, (unsigned)w->k, (unsigned)w->n,
                 (unsigned long long)m->bytes_allocated, (unsigned long long)formula->bytes(w));
}

static uint64_t tiles_of(const fm_scene *scene)
{
    return (uint64_t)((scene->width_px + 7) / 8) * ((scene->height_px + 7) / 8);
}

static uint64_t pages_of(const fm_truth *truth)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    uint64_t pages = 0;
    for (uint64_t i = 0; i < pixels; i++)
        pages += (truth->offsets[i + 1] - truth->offsets[i] + 3) / 4;
    return pages;
}

/* formula NULL: none is written here, and what is allocated is as predicted. */
static void measure_bytes(kit_scene *scene, const fm_method_desc *method, uint32_t k,
                          const struct formula *formula)
{
    const workload w = { .pixels = (uint64_t)scene->scene->width_px * scene->scene->height_px,
                         .k = k,
                         .n = scene->truth->n,
                         .fragments = scene->truth->fragment_count,
                         .kept = truth_kept(scene->truth, k),
                         .tiles = tiles_of(scene->scene),
                         .pages = pages_of(scene->truth) };
    char texts[64];
    fm_measurement m;
    snprintf(texts, sizeof texts, "k=%u%s", k,
             formula != NULL ? formula->method + strlen(method->id) : "");
    const uint32_t alone = kit_feeds(method) & FM_FEED_TRIANGLES;
    const uint32_t feed = alone != 0 ? alone : FM_FEED_RASTER;
    if (kit_measure_times(&m, scene, &(kit_way){ method->id, feed, texts })) {
        if (m.bytes_allocated != m.bytes_predicted)
            fail_msg("%s, %s: %llu bytes allocated, %llu predicted", method->id, texts,
                     (unsigned long long)m.bytes_allocated, (unsigned long long)m.bytes_predicted);
        assert_true(m.bytes_used <= m.bytes_allocated);
        if (formula != NULL)
            expect_formula(formula, &w, &m);
    }
    measurement_free(&m);
}

static bool is_of(const struct formula *formula, const fm_method_desc *method)
{
    const size_t length = strcspn(formula->method, " ");
    return strlen(method->id) == length && strncmp(formula->method, method->id, length) == 0;
}

static void measure_method(kit_scene *scene, const fm_method_desc *method, uint32_t k)
{
    bool has_formula = false;
    for (size_t i = 0; i < sizeof formulas / sizeof formulas[0]; i++) {
        if (!is_of(&formulas[i], method))
            continue;
        has_formula = true;
        measure_bytes(scene, method, k, &formulas[i]);
    }
    if (!has_formula)
        measure_bytes(scene, method, k, NULL);
}

/* The formula knows no device: unless all is wanted, each shows one k. */
static void bytes_on(void **state, const char *texts)
{
    static const uint32_t ks[] = { 1, 8 };
    fm_device *device = device_of(state);
    const bool is_vulkan = strcmp(device->ops->name, "vulkan") == 0;
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device);
    kit_scene_open(&scene, &kit, texts);
    for (size_t i = 0; i < kit.plugins.count; i++)
        for (size_t j = 0; j < sizeof ks / sizeof ks[0] && kit_feeds(kit_method(&kit, i)) != 0; j++)
            if (kit_wants_all() || (ks[j] > 1) == is_vulkan)
                measure_method(&scene, kit_method(&kit, i), ks[j]);
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void bytes_follow_the_formula_in_the_papers_viewport(void **state)
{
    bytes_on(state, "width_px=854 height_px=480 n=2");
}

static void bytes_follow_the_formula_in_one_pixel(void **state)
{
    bytes_on(state, "width_px=1 height_px=1 n=3 pixel_density=1");
}

static void bytes_follow_the_formula_in_a_few_pixels(void **state)
{
    bytes_on(state, "width_px=3 height_px=5 n=9 pixel_density=1");
}

static void bytes_follow_the_formula_in_an_odd_viewport(void **state)
{
    bytes_on(state, "width_px=1023 height_px=767 n=2 pixel_density=1");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(bytes_follow_the_formula_in_the_papers_viewport),
        ON_VULKAN_AND_OSMESA(bytes_follow_the_formula_in_one_pixel),
        ON_VULKAN_AND_OSMESA(bytes_follow_the_formula_in_a_few_pixels),
        ON_VULKAN_AND_OSMESA(bytes_follow_the_formula_in_an_odd_viewport),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
