/* How many images of timed frames wait until the frames are over. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "worker/measure_internal.h"

static void all_images_wait_that_memory_is_given_for(void **state)
{
    static const struct {
        uint32_t width_px, height_px, frames, most;
    } rows[] = {
        { 16, 12, 1, 1 },     { 16, 12, 1000, 1000 }, { 1024, 1024, 17, 16 },
        { 1024, 1024, 4, 4 }, { 4096, 4096, 9, 1 },   { 16384, 16384, 9, 1 },
    };
    static const fm_method_desc method = { .id = "m" };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        fm_truth truth = { .width_px = rows[i].width_px, .height_px = rows[i].height_px };
        const fm_instance_desc instance = { .method = &method };
        const fm_measure_desc desc = { .method = &instance,
                                       .truth = &truth,
                                       .frames = rows[i].frames };
        fm_measurement measurement = { 0 };
        frame_images images;
        assert_int_equal(frame_images_begin(&images, &measurement, &desc, NULL), FM_OK);
        assert_int_equal(images.most, rows[i].most);
        frame_images_free(&images);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_images_wait_that_memory_is_given_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
