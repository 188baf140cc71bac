/* Resources by option, and what layout=auto is on a device. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "model/formula.h"
#include "model/layout.h"

/* Records of k a pixel: in a buffer, or on k layers. */
static fm_method_desc make_method(uint32_t traits)
{
    return (fm_method_desc){
        .traits = traits,
        .options = { { .name = "layout", .values = { "auto", "pixel", "layer", "tile", "image" } },
                     { .name = "pages", .values = { "4", "8" } } },
        .resources = { { .name = "counts", .extent = { .per_pixel = 1 } },
                       { .name = "records",
                         .element = FM_ELEMENT_UVEC2,
                         .extent = { .per_pixel_k = 1 } },
                       { .name = "records",
                         .kind = FM_RESOURCE_IMAGE,
                         .format = FM_FORMAT_RG32UI,
                         .extent = { .per_pixel_k = 1 },
                         .when_option = "layout",
                         .when_value = "image" },
                       { .name = "last", .extent = { .constant = 1 } } },
    };
}

static const fm_choice in_image = { "layout", "image" }, by_tile = { "layout", "tile" };

static void a_method_has_the_resources_of_its_choices(void **state)
{
    (void)state;
    const fm_method_desc method = make_method(0);
    fm_method_desc chosen;
    method_choose(&chosen, &method, &by_tile, 1);
    assert_int_equal(resource_count(&chosen), 3);
    assert_int_equal(chosen.resources[1].kind, FM_RESOURCE_BUFFER);
    assert_string_equal(chosen.resources[2].name, "last");
    method_choose(&chosen, &method, &in_image, 1);
    assert_int_equal(resource_count(&chosen), 3);
    assert_int_equal(chosen.resources[1].kind, FM_RESOURCE_IMAGE);
    assert_string_equal(chosen.resources[2].name, "last");
}

static void what_is_chosen_stays_chosen(void **state)
{
    (void)state;
    const fm_method_desc method = make_method(0);
    fm_method_desc once, twice;
    method_choose(&once, &method, &in_image, 1);
    method_choose(&twice, &once, &in_image, 1);
    assert_memory_equal(&once, &twice, sizeof once);
}

static void without_choices_the_first_value_counts(void **state)
{
    (void)state;
    fm_method_desc chosen, method = make_method(0);
    method_choose(&chosen, &method, NULL, 0);
    assert_int_equal(chosen.resources[1].kind, FM_RESOURCE_BUFFER);
    method.options[0].values[0] = "image";
    method_choose(&chosen, &method, NULL, 0);
    assert_int_equal(chosen.resources[1].kind, FM_RESOURCE_IMAGE);
}

static const fm_layout_device gpu = { .image_layers = 64, .image_max_bytes = 8 * 6 * 32 };
static const fm_layout_device software = { .is_software = true,
                                           .image_layers = 64,
                                           .image_max_bytes = 1 << 20 };

/* 3 x 2 pixels. */
static const char *resolved(const fm_method_desc *method, uint32_t k,
                            const fm_layout_device *device)
{
    static fm_choice choices[FM_MAX_OPTIONS];
    const fm_layout_case of = { .method = method, .width_px = 3, .height_px = 2, .k = k };
    assert_int_equal(layout_choices(choices, NULL, 0, &of, device), 2);
    assert_string_equal(choices[1].value, "4");
    return choices[0].value;
}

static void a_gpu_takes_images_for_what_is_bounded(void **state)
{
    (void)state;
    const fm_method_desc bounded = make_method(FM_TRAIT_BOUNDED), list = make_method(0);
    assert_string_equal(resolved(&bounded, 8, &gpu), "image");
    assert_string_equal(resolved(&list, 8, &gpu), "tile");
}

/* 32 layers are as many bytes as the device's largest image has. */
static void an_image_that_a_device_lacks_is_not_taken(void **state)
{
    (void)state;
    const fm_method_desc method = make_method(FM_TRAIT_BOUNDED);
    fm_layout_device device = gpu;
    assert_string_equal(resolved(&method, 32, &device), "image");
    assert_string_equal(resolved(&method, 33, &device), "tile");
    device.image_max_bytes *= 4;
    assert_string_equal(resolved(&method, 64, &device), "image");
    assert_string_equal(resolved(&method, 65, &device), "tile");
}

/* No buffer lies in an image's memory. */
static void a_shared_map_keeps_arrays_in_buffers(void **state)
{
    (void)state;
    const fm_method_desc method = make_method(FM_TRAIT_BOUNDED);
    fm_choice choices[FM_MAX_OPTIONS];
    fm_settings settings;
    settings_default(&settings);
    settings.width_px = 3;
    settings.height_px = 2;
    fm_layout_case of = layout_case(&method, &settings, 0);
    layout_choices(choices, NULL, 0, &of, &gpu);
    assert_string_equal(choices[0].value, "image");
    settings.culling = FM_CULLING_OCCUPANCY;
    settings.cull_memory = FM_CULL_MEMORY_SHARED;
    of = layout_case(&method, &settings, 0);
    layout_choices(choices, NULL, 0, &of, &gpu);
    assert_string_equal(choices[0].value, "tile");
}

static void a_method_has_only_its_own_layouts(void **state)
{
    (void)state;
    fm_method_desc method = make_method(FM_TRAIT_BOUNDED);
    method.options[0] = (fm_option){ .name = "layout", .values = { "auto", "layer", "pixel" } };
    assert_string_equal(resolved(&method, 8, &gpu), "layer");
    method.options[0] = (fm_option){ .name = "layout", .values = { "auto", "swizzled" } };
    assert_string_equal(resolved(&method, 8, &gpu), "swizzled");
    assert_string_equal(resolved(&method, 8, &software), "swizzled");
}

/* Also on software, whatever the method's traits; without the image the same array in a buffer. */
static void the_published_layout_is_an_image_or_layers(void **state)
{
    (void)state;
    const fm_method_desc method = make_method(0);
    const fm_choice given = { "layout", "published" };
    fm_layout_device device = software;
    fm_choice choices[FM_MAX_OPTIONS];
    const fm_layout_case of = { .method = &method, .width_px = 3, .height_px = 2, .k = 8 };
    assert_true(layout_is_open(&given));
    layout_choices(choices, &given, 1, &of, &device);
    assert_string_equal(choices[0].value, "image");
    device.image_layers = 7;
    layout_choices(choices, &given, 1, &of, &device);
    assert_string_equal(choices[0].value, "layer");
}

static void a_layout_that_was_chosen_stays(void **state)
{
    (void)state;
    const fm_method_desc method = make_method(FM_TRAIT_BOUNDED);
    const fm_layout_case of = { .method = &method, .width_px = 3, .height_px = 2, .k = 8 };
    fm_choice choices[FM_MAX_OPTIONS];
    layout_choices(choices, &by_tile, 1, &of, &gpu);
    assert_string_equal(choices[0].value, "tile");
    assert_false(layout_is_open(&choices[0]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_method_has_the_resources_of_its_choices),
        cmocka_unit_test(what_is_chosen_stays_chosen),
        cmocka_unit_test(without_choices_the_first_value_counts),
        cmocka_unit_test(a_gpu_takes_images_for_what_is_bounded),
        cmocka_unit_test(an_image_that_a_device_lacks_is_not_taken),
        cmocka_unit_test(a_shared_map_keeps_arrays_in_buffers),
        cmocka_unit_test(a_method_has_only_its_own_layouts),
        cmocka_unit_test(the_published_layout_is_an_image_or_layers),
        cmocka_unit_test(a_layout_that_was_chosen_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
