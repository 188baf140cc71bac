/* Resources by option, and what `auto` of an option is on a device. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "model/auto_option.h"
#include "model/formula.h"

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

static const fm_auto_device gpu = { .image_layers = 64, .image_max_bytes = 8 * 6 * 32 };
static const fm_auto_device software = { .is_software = true,
                                         .image_layers = 64,
                                         .image_max_bytes = 1 << 20 };

/* 3 x 2 pixels. */
static const char *resolved(const fm_method_desc *method, uint32_t k, const fm_auto_device *device)
{
    static fm_choice choices[FM_MAX_OPTIONS];
    const fm_auto_case of = { .method = method, .width_px = 3, .height_px = 2, .k = k };
    assert_int_equal(auto_choices(choices, NULL, 0, &of, device), 2);
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

/* Chains go through a pixel's slots for each fragment; what sorts later puts it beside its
 * neighbours'. */
static void software_takes_pixel_for_chains_and_tile_for_others(void **state)
{
    (void)state;
    const fm_method_desc chain = make_method(FM_TRAIT_BOUNDED | FM_TRAIT_EXACT);
    const fm_method_desc sorting = make_method(FM_TRAIT_BOUNDED | FM_TRAIT_SORTS_IN_RESOLVE);
    const fm_method_desc list = make_method(0);
    assert_string_equal(resolved(&chain, 8, &software), "pixel");
    assert_string_equal(resolved(&sorting, 8, &software), "tile");
    assert_string_equal(resolved(&list, 8, &software), "tile");
}

/* 32 layers are as many bytes as the device's largest image has. */
static void an_image_that_a_device_lacks_is_not_taken(void **state)
{
    (void)state;
    const fm_method_desc method = make_method(FM_TRAIT_BOUNDED);
    fm_auto_device device = gpu;
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
    fm_auto_case of = auto_case(&method, &settings, 0);
    auto_choices(choices, NULL, 0, &of, &gpu);
    assert_string_equal(choices[0].value, "image");
    settings.culling = FM_CULLING_OCCUPANCY;
    settings.cull_memory = FM_CULL_MEMORY_SHARED;
    of = auto_case(&method, &settings, 0);
    auto_choices(choices, NULL, 0, &of, &gpu);
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
    fm_auto_device device = software;
    fm_choice choices[FM_MAX_OPTIONS];
    const fm_auto_case of = { .method = &method, .width_px = 3, .height_px = 2, .k = 8 };
    assert_true(auto_is_open(&given));
    auto_choices(choices, &given, 1, &of, &device);
    assert_string_equal(choices[0].value, "image");
    device.image_layers = 7;
    auto_choices(choices, &given, 1, &of, &device);
    assert_string_equal(choices[0].value, "layer");
}

static void a_layout_that_was_chosen_stays(void **state)
{
    (void)state;
    const fm_method_desc method = make_method(FM_TRAIT_BOUNDED);
    const fm_auto_case of = { .method = &method, .width_px = 3, .height_px = 2, .k = 8 };
    fm_choice choices[FM_MAX_OPTIONS];
    auto_choices(choices, &by_tile, 1, &of, &gpu);
    assert_string_equal(choices[0].value, "tile");
    assert_false(auto_is_open(&choices[0]));
}

/* Whatever traits a method has. */
static void a_list_has_whole_nodes_on_a_gpu(void **state)
{
    (void)state;
    for (uint32_t traits = 0; traits <= FM_TRAIT_BOUNDED; traits += FM_TRAIT_BOUNDED) {
        fm_method_desc method = make_method(traits);
        method.options[0] = (fm_option){ .name = "node", .values = { "auto", "split", "whole" } };
        assert_string_equal(resolved(&method, 8, &gpu), "whole");
        assert_string_equal(resolved(&method, 8, &software), "split");
        method.options[0].values[2] = NULL;
        assert_string_equal(resolved(&method, 8, &gpu), "split");
    }
}

/* Images that the device lacks are not taken. */
static void words_of_pixels_lie_in_images_on_software(void **state)
{
    (void)state;
    fm_method_desc method = make_method(0);
    fm_auto_device device = software;
    method.options[0] =
        (fm_option){ .name = "per_pixel", .values = { "auto", "tiles", "images", "rows" } };
    method.resources[2].when_option = "per_pixel";
    method.resources[2].when_value = "images";
    assert_string_equal(resolved(&method, 8, &device), "images");
    device.image_layers = 7;
    assert_string_equal(resolved(&method, 8, &device), "rows");
    assert_string_equal(resolved(&method, 8, &gpu), "rows");
}

/* start=auto, say, is what the method's shaders make of it. */
static void auto_of_another_option_is_the_methods_own(void **state)
{
    (void)state;
    fm_method_desc method = make_method(0);
    method.options[0] = (fm_option){ .name = "start", .values = { "auto", "front" } };
    assert_string_equal(resolved(&method, 8, &gpu), "auto");
    assert_false(auto_is_open(&(fm_choice){ "start", "auto" }));
    assert_true(auto_is_open(&(fm_choice){ "node", "auto" }));
    assert_false(auto_is_open(&(fm_choice){ "node", "split" }));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_method_has_the_resources_of_its_choices),
        cmocka_unit_test(what_is_chosen_stays_chosen),
        cmocka_unit_test(without_choices_the_first_value_counts),
        cmocka_unit_test(a_gpu_takes_images_for_what_is_bounded),
        cmocka_unit_test(software_takes_pixel_for_chains_and_tile_for_others),
        cmocka_unit_test(an_image_that_a_device_lacks_is_not_taken),
        cmocka_unit_test(a_shared_map_keeps_arrays_in_buffers),
        cmocka_unit_test(a_method_has_only_its_own_layouts),
        cmocka_unit_test(the_published_layout_is_an_image_or_layers),
        cmocka_unit_test(a_layout_that_was_chosen_stays),
        cmocka_unit_test(a_list_has_whole_nodes_on_a_gpu),
        cmocka_unit_test(words_of_pixels_lie_in_images_on_software),
        cmocka_unit_test(auto_of_another_option_is_the_methods_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
