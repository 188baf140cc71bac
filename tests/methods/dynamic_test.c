/* kplus-dynamic: the k that it chooses is the one that the fragments of truth and both budgets ask
 * for, worked out here from truth alone. */
#include <stdio.h>

#include "kit/scene_kit.h"

/* Fragments beyond the k nearest of each pixel. */
static uint64_t discarded(const fm_truth *truth, uint64_t k)
{
    return truth->fragment_count - truth_kept(truth, (uint32_t)k);
}

/* Records, counters, locks; 1023 bins, one word for what is deeper, and the choice. */
static uint64_t bytes_of(const fm_truth *truth, uint64_t k)
{
    const uint64_t pixels = (uint64_t)truth->width_px * truth->height_px;
    return 8 * k * pixels + 8 * pixels + 4 * (1024 + 2);
}

typedef struct budget {
    uint32_t k, memory_mib, discard;
    bool is_unchecked; /* the choice alone */
} budget;

/* The smallest k that discards no more than allowed; less where the axis or the memory forbids it.
 */
static uint32_t expected_k(const fm_truth *truth, const budget *b)
{
    uint32_t k = 1;
    while (k < b->k && discarded(truth, k) * 100 > (uint64_t)b->discard * truth->fragment_count)
        k++;
    while (k > 1 && bytes_of(truth, k) > (uint64_t)b->memory_mib << 20)
        k--;
    return k;
}

static void expect_choice(kit_scene *scene, const budget *b, uint32_t feed, const char *kept_in)
{
    char texts[128], where[256];
    fm_measurement m;
    snprintf(texts, sizeof texts, "k=%u memory_mib=%u discard=%u kept_in=%s count_in=own", b->k,
             b->memory_mib, b->discard, kept_in);
    const kit_way way = { "kplus-dynamic", feed, texts };
    const uint32_t k = expected_k(scene->truth, b);
    kit_tell(where, &way);
    const bool is_there =
        b->is_unchecked ? kit_measure_times(&m, scene, &way) : kit_measure(&m, scene, &way);
    if (is_there && m.k_chosen != k)
        fail_msg("%s: chose %u, not %u", where, m.k_chosen, k);
    if (is_there) {
        assert_int_equal(m.bytes_allocated, bytes_of(scene->truth, k));
        assert_int_equal(m.bytes_allocated, m.bytes_predicted);
        assert_true(m.bytes_used <= m.bytes_allocated);
    }
    if (is_there && m.is_checked) {
        assert_int_equal(m.check.captured, truth_kept(scene->truth, k));
        assert_int_equal(m.check.missing + m.check.extra + m.check.misordered + m.lost, 0);
    }
    measurement_free(&m);
}

/* The first has the chosen k decide. */
static const char *const kept_in[] = { "rule", "array", "heap" };

static void expect_choices(void **state, const char *texts, const budget *budgets, size_t count)
{
    scene_kit kit;
    kit_scene scene;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, texts);
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < sizeof kept_in / sizeof kept_in[0]; j++)
            expect_choice(&scene, &budgets[i], FM_FEED_RASTER << (i + j) % 4, kept_in[j]);
    kit_scene_close(&scene);
    kit_close(&kit);
}

#define EXPECT_CHOICES(state, texts, budgets)                                                      \
    expect_choices(state, texts, budgets, sizeof(budgets) / sizeof(budgets)[0])

/* Without allowance all is kept that the axis lets be kept, and no more than the deepest pixel has.
 */
static void k_is_what_the_allowance_asks_for(void **state)
{
    static const budget budgets[] = { { 64, 200, 0, false },  { 8, 200, 0, false },
                                      { 1, 200, 0, false },   { 64, 200, 1, false },
                                      { 64, 200, 10, false }, { 64, 200, 50, false },
                                      { 64, 200, 90, false }, { 3, 200, 50, false } };
    EXPECT_CHOICES(state,
                   "width_px=37 height_px=23 pixel_density=0.6 n=40 tessellation=3 "
                   "order=random-cell fragment_probability=0.5",
                   budgets);
}

/* 8 k N of N = 49 152 pixels pass 1 MiB at k = 2, and 10 MiB at k = 26. */
static void k_is_what_the_memory_holds(void **state)
{
    static const budget budgets[] = {
        { 64, 1, 0, false }, { 64, 10, 0, false }, { 64, 10, 20, false }, { 20, 10, 0, false }
    };
    EXPECT_CHOICES(state, "width_px=256 height_px=192 pixel_density=0.1 n=30", budgets);
}

static void an_empty_scene_has_k_one(void **state)
{
    static const budget budgets[] = { { 8, 200, 0, false }, { 8, 200, 10, false } };
    EXPECT_CHOICES(state, "width_px=5 height_px=4 n=0", budgets);
}

/* The histogram has 1023 bins; what is deeper counts in full: of 1500 fragments 90 per cent are
 * discarded by k = 150, and 20 per cent would be by 1200, where 1023 is the most. So many fragments
 * a pixel pass the loop limit of software rasterisers in store and sort; the choice does not. */
static void pixels_deeper_than_the_histogram_are_clamped(void **state)
{
    static const budget budgets[] = { { 8, 200, 0, false },
                                      { 150, 200, 90, true },
                                      { 1023, 200, 20, true } };
    EXPECT_CHOICES(state, "width_px=2 height_px=1 pixel_density=1 n=1500", budgets);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_VULKAN_AND_OSMESA(k_is_what_the_allowance_asks_for),
        ON_VULKAN_AND_OSMESA(k_is_what_the_memory_holds),
        ON_VULKAN_AND_OSMESA(an_empty_scene_has_k_one),
        ON_VULKAN_AND_OSMESA(pixels_deeper_than_the_histogram_are_clamped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
