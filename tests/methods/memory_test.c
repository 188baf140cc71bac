/* The largest scenes of the figures, captured, measured and checked: host memory beyond the
 * method's own buffers. On a software device that is all there is. Minutes. */
#include <stdio.h>
#include <sys/resource.h>

#include "kit/scene_kit.h"

static const uint64_t allowed_bytes = UINT64_C(2) << 30;

static uint64_t most_resident_bytes(void)
{
    struct rusage usage;
    assert_int_equal(getrusage(RUSAGE_SELF, &usage), 0);
    return (uint64_t)usage.ru_maxrss * 1024;
}

static void check_memory(void **state, const char *texts, uint64_t least_fragments)
{
    const kit_way way = { "kplus-array", FM_FEED_RASTER, "k=8" };
    scene_kit kit;
    kit_scene scene;
    fm_measurement m;
    kit_open(&kit, device_of(state));
    kit_scene_open(&scene, &kit, texts);
    assert_true(scene.truth->fragment_count >= least_fragments);
    if (kit_measure(&m, &scene, &way)) {
        const uint64_t most = most_resident_bytes();
        assert_int_equal(m.check.missing + m.check.extra + m.check.misordered, 0);
        print_message("%s: %llu fragments, %llu MiB at most, %llu MiB of them the method's\n",
                      texts, (unsigned long long)scene.truth->fragment_count,
                      (unsigned long long)(most >> 20),
                      (unsigned long long)(m.bytes_allocated >> 20));
        assert_true(most <= m.bytes_allocated + allowed_bytes);
    }
    measurement_free(&m);
    kit_scene_close(&scene);
    kit_close(&kit);
}

static void hairball_takes_less_than_2_gib(void **state)
{
    check_memory(state, "generator=hairball width_px=1024 height_px=1024 fov_deg=20 zoom=1.5",
                 10000000);
}

static void layers_of_315_million_fragments_take_less_than_2_gib(void **state)
{
    check_memory(state, "width_px=854 height_px=480 n=1024 pixel_density=0.75", 314000000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        { "hairball_takes_less_than_2_gib [vulkan]", hairball_takes_less_than_2_gib, open_vulkan,
          close_opened, NULL },
        { "layers_of_315_million_fragments_take_less_than_2_gib [vulkan]",
          layers_of_315_million_fragments_take_less_than_2_gib, open_vulkan, close_opened, NULL },
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
