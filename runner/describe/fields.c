#include "fields.h"

#include "fragmark/method.h"
#include "fragmark/technique.h"

#define FIELD(STRUCT, MEMBER, KIND, UNIT, INSIDE)                                                  \
    {                                                                                              \
        .name = #MEMBER, .kind = KIND, .offset_bytes = offsetof(STRUCT, MEMBER),                   \
        .unit_bytes = UNIT, .count = sizeof((STRUCT *)0)->MEMBER / (UNIT), .inside = INSIDE        \
    }
#define NUMBER(STRUCT, MEMBER)                                                                     \
    FIELD(STRUCT, MEMBER, FM_FIELD_NUMBER, sizeof((STRUCT *)0)->MEMBER, NULL)
#define BOOL(STRUCT, MEMBER) FIELD(STRUCT, MEMBER, FM_FIELD_BOOL, sizeof(bool), NULL)
#define TEXT(STRUCT, MEMBER) FIELD(STRUCT, MEMBER, FM_FIELD_TEXT, sizeof(const char *), NULL)
#define HOOK(STRUCT, MEMBER) FIELD(STRUCT, MEMBER, FM_FIELD_HOOK, sizeof(void (*)(void)), NULL)
#define PART(STRUCT, MEMBER, INSIDE, LAYOUT)                                                       \
    FIELD(STRUCT, MEMBER, FM_FIELD_STRUCT, sizeof(INSIDE), LAYOUT)
#define POINTER(STRUCT, MEMBER, LAYOUT)                                                            \
    FIELD(STRUCT, MEMBER, FM_FIELD_POINTER, sizeof(const void *), LAYOUT)
#define LAYOUT(STRUCT, FIELDS)                                                                     \
    {                                                                                              \
        .name = #STRUCT, .size_bytes = sizeof(STRUCT), .fields = FIELDS,                           \
        .count = sizeof(FIELDS) / sizeof(FIELDS)[0]                                                \
    }

_Static_assert(FM_ABI == 5, "the tables below have every field of this ABI");

static const fm_field option_fields[] = {
    TEXT(fm_option, name),
    TEXT(fm_option, values),
    TEXT(fm_option, help),
};
static const fm_layout option_layout = LAYOUT(fm_option, option_fields);

static const fm_field extent_fields[] = {
    NUMBER(fm_extent, constant),     NUMBER(fm_extent, per_pixel),
    NUMBER(fm_extent, per_pixel_k),  NUMBER(fm_extent, per_pixel_n),
    NUMBER(fm_extent, per_fragment), NUMBER(fm_extent, per_tile),
    NUMBER(fm_extent, per_triangle), NUMBER(fm_extent, per_total),
    TEXT(fm_extent, total),          NUMBER(fm_extent, per_option),
    TEXT(fm_extent, option),         NUMBER(fm_extent, per_pixel_option),
    NUMBER(fm_extent, k_step),
};
static const fm_layout extent_layout = LAYOUT(fm_extent, extent_fields);

static const fm_field used_fields[] = {
    NUMBER(fm_used, per_pixel),
    NUMBER(fm_used, per_fragment),
    NUMBER(fm_used, per_kept),
};
static const fm_layout used_layout = LAYOUT(fm_used, used_fields);

static const fm_field resource_fields[] = {
    TEXT(fm_resource, name),
    NUMBER(fm_resource, kind),
    NUMBER(fm_resource, element),
    PART(fm_resource, extent, fm_extent, &extent_layout),
    NUMBER(fm_resource, sizing),
    TEXT(fm_resource, overflow),
    PART(fm_resource, grown, fm_extent, &extent_layout),
    TEXT(fm_resource, shares),
    NUMBER(fm_resource, format),
    NUMBER(fm_resource, samples),
    NUMBER(fm_resource, samples_per_k),
    NUMBER(fm_resource, layers),
    NUMBER(fm_resource, layers_per_k),
    NUMBER(fm_resource, clear_colour),
    NUMBER(fm_resource, clear_words),
    NUMBER(fm_resource, clear_depth),
    NUMBER(fm_resource, clear_stencil),
    BOOL(fm_resource, ping_pong),
    PART(fm_resource, used, fm_used, &used_layout),
    TEXT(fm_resource, samples_option),
    TEXT(fm_resource, when_option),
    TEXT(fm_resource, when_value),
};
static const fm_layout resource_layout = LAYOUT(fm_resource, resource_fields);

static const fm_field total_fields[] = {
    TEXT(fm_total, name), TEXT(fm_total, resource), NUMBER(fm_total, index),
    BOOL(fm_total, sum),  TEXT(fm_total, pass),     BOOL(fm_total, late),
};
static const fm_layout total_layout = LAYOUT(fm_total, total_fields);

static const fm_field target_fields[] = {
    TEXT(fm_target, resource),
    NUMBER(fm_target, load),
    NUMBER(fm_target, blend),
    BOOL(fm_target, no_write),
};
static const fm_layout target_layout = LAYOUT(fm_target, target_fields);

static const fm_field state_fields[] = {
    TEXT(fm_state, depth_stencil),
    NUMBER(fm_state, depth_stencil_load),
    NUMBER(fm_state, depth_test),
    BOOL(fm_state, depth_write),
    BOOL(fm_state, early_tests),
    NUMBER(fm_state, stencil_test),
    NUMBER(fm_state, stencil_fail),
    NUMBER(fm_state, stencil_depth_fail),
    NUMBER(fm_state, stencil_pass),
    NUMBER(fm_state, stencil_reference),
    NUMBER(fm_state, stencil_reference_step),
    NUMBER(fm_state, sample_mask),
    NUMBER(fm_state, sample_mask_step),
};
static const fm_layout state_layout = LAYOUT(fm_state, state_fields);

static const fm_field pass_fields[] = {
    TEXT(fm_pass, name),
    NUMBER(fm_pass, kind),
    TEXT(fm_pass, shader),
    TEXT(fm_pass, reads),
    TEXT(fm_pass, writes),
    PART(fm_pass, targets, fm_target, &target_layout),
    PART(fm_pass, state, fm_state, &state_layout),
    BOOL(fm_pass, exclusive),
    TEXT(fm_pass, lock_word),
    TEXT(fm_pass, lock_word_option),
    BOOL(fm_pass, emits),
    BOOL(fm_pass, flat_tessellation),
    TEXT(fm_pass, count_total),
    TEXT(fm_pass, indirect),
    NUMBER(fm_pass, clear_word),
    TEXT(fm_pass, flat_option),
    NUMBER(fm_pass, cover),
    NUMBER(fm_pass, lanes),
    NUMBER(fm_pass, lanes_narrow),
    BOOL(fm_pass, narrow_only),
    NUMBER(fm_pass, resumes),
    BOOL(fm_pass, ordered_interlock),
    BOOL(fm_pass, targets_after_lock),
    BOOL(fm_pass, writes_sample_mask),
    BOOL(fm_pass, shared_sort),
};
static const fm_layout pass_layout = LAYOUT(fm_pass, pass_fields);

static const fm_field loop_fields[] = {
    TEXT(fm_loop, first),         TEXT(fm_loop, last),          NUMBER(fm_loop, count),
    NUMBER(fm_loop, count_per_k), NUMBER(fm_loop, count_per_n), TEXT(fm_loop, until_zero),
    NUMBER(fm_loop, max),         TEXT(fm_loop, count_option),
};
static const fm_layout loop_layout = LAYOUT(fm_loop, loop_fields);

static const fm_field choice_fields[] = {
    TEXT(fm_part_choice, option),
    TEXT(fm_part_choice, value),
    NUMBER(fm_part_choice, parts),
};
static const fm_layout choice_layout = LAYOUT(fm_part_choice, choice_fields);

static const fm_field technique_fields[] = {
    NUMBER(fm_technique, parts),  PART(fm_technique, choices, fm_part_choice, &choice_layout),
    HOOK(fm_technique, predict),  HOOK(fm_technique, place),
    HOOK(fm_technique, sign),     HOOK(fm_technique, skip),
    HOOK(fm_technique, tile_end),
};
static const fm_layout technique_layout = LAYOUT(fm_technique, technique_fields);

static const fm_field method_fields[] = {
    NUMBER(fm_method_desc, abi),
    NUMBER(fm_method_desc, size_bytes),
    TEXT(fm_method_desc, id),
    TEXT(fm_method_desc, title),
    TEXT(fm_method_desc, citation),
    TEXT(fm_method_desc, version),
    NUMBER(fm_method_desc, traits),
    NUMBER(fm_method_desc, features),
    NUMBER(fm_method_desc, feeds),
    NUMBER(fm_method_desc, keeps),
    NUMBER(fm_method_desc, k_max),
    NUMBER(fm_method_desc, family),
    NUMBER(fm_method_desc, marker),
    BOOL(fm_method_desc, dashed),
    PART(fm_method_desc, options, fm_option, &option_layout),
    PART(fm_method_desc, resources, fm_resource, &resource_layout),
    PART(fm_method_desc, totals, fm_total, &total_layout),
    PART(fm_method_desc, passes, fm_pass, &pass_layout),
    PART(fm_method_desc, loops, fm_loop, &loop_layout),
    HOOK(fm_method_desc, after),
    TEXT(fm_method_desc, k_total),
    POINTER(fm_method_desc, technique, &technique_layout),
    NUMBER(fm_method_desc, features_optional),
    BOOL(fm_method_desc, needs_interlock),
};
const fm_layout method_layout = LAYOUT(fm_method_desc, method_fields);
