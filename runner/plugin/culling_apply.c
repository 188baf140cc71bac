#include "culling_apply.h"

#include <stdio.h>
#include <string.h>

#include "depth_check.h"
#include "model/formats.h"
#include "model/formula.h"

/* Names beginning with fm_ are the runner's: no plugin has them. */
#define BOUNDARY "fm_cull_boundary"
#define RANGE    "fm_cull_range"
#define MAP      "fm_cull_map"
#define PREFIX   "cull-" /* of the map's passes; plugin_check keeps it from others */

enum { RESOURCES_ADDED = 3, PASSES_ADDED = 4, BUCKETS_PER_WORD = 32 };

bool culling_is_map_pass(const fm_pass *pass)
{
    return pass->name != NULL && strncmp(pass->name, PREFIX, sizeof PREFIX - 1) == 0;
}

bool culling_is_applied(const fm_method_desc *method)
{
    return culling_is_map_pass(&method->passes[0]);
}

static fm_status check_room(const fm_method_desc *method, fm_error *err)
{
    bool has_room = pass_count(method) + PASSES_ADDED <= FM_MAX_PASSES &&
                    resource_count(method) + RESOURCES_ADDED <= FM_MAX_RESOURCES;
    for (size_t i = 0; i < pass_count(method); i++)
        has_room = has_room && access_count(method->passes[i].reads) < FM_MAX_ACCESSES;
    if (!has_room)
        return fm_refuse(err, FM_REASON_SUITE_LIMIT,
                         "culling = occupancy: %s leaves no room for %d passes and %d resources",
                         method->id, PASSES_ADDED, RESOURCES_ADDED);
    return FM_OK;
}

static bool is_multisampled(const fm_method_desc *method, const char *name, uint32_t k)
{
    for (size_t i = 0; i < resource_count(method); i++) {
        const fm_resource *resource = &method->resources[i];
        if (strcmp(resource->name, name) == 0)
            return resource->samples_option != NULL ||
                   resource->samples + resource->samples_per_k * k > 1;
    }
    return false;
}

/* The depth test is free, and the boundary's image, of one sample, fits the pass's targets. */
static bool can_test_early(const fm_method_desc *method, const fm_pass *pass, uint32_t k)
{
    for (size_t i = 0; i < FM_MAX_TARGETS && pass->targets[i].resource != NULL; i++)
        if (is_multisampled(method, pass->targets[i].resource, k))
            return false;
    return pass->state.depth_stencil == NULL;
}

static void test_pass(fm_pass *pass, const fm_method_desc *method, const fm_settings *settings)
{
    if (pass->kind != FM_PASS_SCENE || pass->cover != FM_COVER_NONE)
        return;
    if (settings->cull_test == FM_CULL_TEST_SHADER || !can_test_early(method, pass, settings->k)) {
        pass->reads[access_count(pass->reads)] = BOUNDARY;
        return;
    }
    /* Less or equal: the boundary is a depth that the k-th fragment may have. */
    pass->state.depth_stencil = BOUNDARY;
    pass->state.depth_test = FM_COMPARE_LESS_EQUAL;
    pass->state.early_tests = true;
}

/* An image that stands in for a buffer; NULL: there is none. */
static const fm_resource *stand_in_image(const fm_method_desc *method)
{
    for (size_t i = 0; i < resource_count(method); i++)
        if (method->resources[i].kind == FM_RESOURCE_IMAGE &&
            method->resources[i].when_option != NULL)
            return &method->resources[i];
    return NULL;
}

/* Of the passes as they will be. The descriptor has room. */
static fm_status check_depth(const fm_method_desc *method, const fm_settings *settings,
                             fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < pass_count(method) && status == FM_OK; i++) {
        fm_pass pass = method->passes[i];
        test_pass(&pass, method, settings);
        status = depth_check_pass(&pass, settings, err);
    }
    return status;
}

fm_status culling_check(const fm_method_desc *method, const fm_settings *settings, uint32_t feed,
                        fm_error *err)
{
    const uint64_t words =
        (uint64_t)settings->width_px * settings->height_px * settings->cull_words;
    if (settings->culling == FM_CULLING_NONE)
        return depth_check(method, settings, err);
    if (method->keeps != FM_KEEPS_K_NEAREST)
        return fm_refuse(
            err, FM_REASON_SETTING,
            "culling = occupancy: the method keeps other fragments than the k nearest");
    if (method->k_total != NULL)
        return fm_refuse(err, FM_REASON_SETTING,
                         "culling = occupancy: the method counts all fragments to choose its k");
    if (feed != FM_FEED_RASTER)
        return fm_refuse(err, FM_REASON_SETTING, "culling = occupancy: feed raster only");
    if (settings->k > settings->cull_words * BUCKETS_PER_WORD)
        return fm_refuse(err, FM_REASON_SETTING,
                         "cull_words = %u: %u buckets are fewer than k = %u; nothing can be culled",
                         settings->cull_words, settings->cull_words * BUCKETS_PER_WORD,
                         settings->k);
    if (settings->cull_memory == FM_CULL_MEMORY_SHARED && stand_in_image(method) != NULL)
        return fm_refuse(err, FM_REASON_SETTING,
                         "cull_memory = shared: with %s = %s '%s' is an image, whose memory a "
                         "buffer cannot share",
                         stand_in_image(method)->when_option, stand_in_image(method)->when_value,
                         stand_in_image(method)->name);
    if (words > UINT32_MAX)
        return fm_refuse(err, FM_REASON_SUITE_LIMIT, "cull_words = %u: the map is over 2^32 words",
                         settings->cull_words);
    const fm_status status = check_room(method, err);
    return status == FM_OK ? check_depth(method, settings, err) : status;
}

/* What formulas ask: the workload's runner. */
typedef struct asked_choices {
    const fm_method_desc *method;
    const fm_culling_desc *desc;
} asked_choices;

static const char *chosen_of(const fm_workload *workload, const char *name)
{
    const asked_choices *asked = workload->runner;
    return option_chosen(asked->method, name, asked->desc->choices, asked->desc->choice_count);
}

/* The method's largest buffer that stays as it is; NULL: it has none. Every method writes what it
 * reads within a frame, so that what the map leaves there is never read. */
static const char *largest_buffer(const fm_method_desc *method, const fm_culling_desc *desc)
{
    const asked_choices asked = { method, desc };
    const fm_workload workload = { .width_px = desc->settings->width_px,
                                   .height_px = desc->settings->height_px,
                                   .k = desc->settings->k,
                                   .n = desc->n,
                                   .option = chosen_of,
                                   .runner = &asked };
    const char *largest = NULL;
    uint64_t most = 0;
    for (size_t i = 0; i < resource_count(method); i++) {
        const fm_resource *resource = &method->resources[i];
        if (resource->kind != FM_RESOURCE_BUFFER || resource->sizing != FM_SIZE_FIXED ||
            resource->ping_pong || resource->shares != NULL)
            continue;
        const uint64_t bytes = formula_elements(method, &resource->extent, &workload) *
                               element_bytes(resource->element);
        if (bytes <= most)
            continue;
        largest = resource->name;
        most = bytes;
    }
    return largest;
}

static void add_resources(fm_method_desc *culled, const fm_method_desc *method,
                          const fm_culling_desc *desc)
{
    const fm_settings *settings = desc->settings;
    const bool is_shared = settings->cull_memory == FM_CULL_MEMORY_SHARED;
    fm_resource *added = &culled->resources[resource_count(method)];
    added[0] =
        (fm_resource){ .name = BOUNDARY, .kind = FM_RESOURCE_IMAGE, .format = FM_FORMAT_D32F };
    added[1] = (fm_resource){ .name = RANGE,
                              .kind = FM_RESOURCE_IMAGE,
                              .format = FM_FORMAT_RG32F,
                              .clear_colour = { -2, -2 } }; /* less than any depth's */
    added[2] = (fm_resource){ .name = MAP,
                              .extent = { .per_pixel = settings->cull_words },
                              .used = { .per_pixel = settings->cull_words },
                              .shares = is_shared ? largest_buffer(method, desc) : NULL };
}

static const fm_cover cover_of[] = {
    [FM_CULL_RANGE_HULL] = FM_COVER_HULL,
    [FM_CULL_RANGE_AABB] = FM_COVER_BOX,
    [FM_CULL_RANGE_EXACT] = FM_COVER_NONE,
};

static void add_passes(fm_method_desc *culled, const fm_method_desc *method,
                       const fm_settings *settings)
{
    const bool is_shared = settings->cull_memory == FM_CULL_MEMORY_SHARED;
    fm_pass *passes = culled->passes;
    /* A clear pass would fill all of a buffer that the map has only a part of. */
    passes[0] = (fm_pass){ .name = PREFIX "clear",
                           .kind = is_shared ? FM_PASS_PIXELS : FM_PASS_CLEAR,
                           .shader = is_shared ? "common/cull_clear.glsl" : NULL,
                           .writes = { MAP } };
    passes[1] = (fm_pass){
        .name = PREFIX "range",
        .shader = "common/cull_range.glsl",
        .cover = cover_of[settings->cull_range],
        .targets = { { .resource = RANGE, .load = FM_LOAD_CLEAR, .blend = FM_BLEND_MAX } }
    };
    passes[2] = (fm_pass){ .name = PREFIX "fill",
                           .shader = "common/cull_fill.glsl",
                           .reads = { RANGE },
                           .writes = { MAP } };
    passes[3] = (fm_pass){
        .name = PREFIX "count",
        .kind = FM_PASS_PIXELS,
        .shader = "common/cull_count.glsl",
        .reads = { RANGE, MAP },
        .state = { .depth_stencil = BOUNDARY, .depth_test = FM_COMPARE_ALWAYS, .depth_write = true }
    };
    for (size_t i = 0; i < pass_count(method); i++) {
        passes[PASSES_ADDED + i] = method->passes[i];
        test_pass(&passes[PASSES_ADDED + i], method, settings);
    }
}

fm_status culling_apply(fm_method_desc *culled, const fm_method_desc *method,
                        const fm_culling_desc *desc, fm_error *err)
{
    fm_method_desc chosen;
    method_choose(&chosen, method, desc->choices, desc->choice_count);
    *culled = chosen;
    const fm_status status = culling_check(&chosen, desc->settings, desc->feed, err);
    if (status != FM_OK || desc->settings->culling == FM_CULLING_NONE)
        return status;
    add_resources(culled, &chosen, desc);
    add_passes(culled, &chosen, desc->settings);
    return FM_OK;
}

bool culling_tests_in_shader(const fm_pass *pass)
{
    for (size_t i = 0; pass->kind == FM_PASS_SCENE && i < access_count(pass->reads); i++)
        if (strcmp(pass->reads[i], BOUNDARY) == 0)
            return true;
    return false;
}
