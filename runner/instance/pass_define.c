/* The #defines of a pass: parameters, facts of the device, options. */
#include <ctype.h>
#include <string.h>

#include "instance_internal.h"
#include "model/descriptor.h"
#include "plugin/culling_apply.h"

/* Spins until a lock is given up and the fragment counted as lost: bounded, since a hung GPU helps
 * nobody. In Mesa's software a try costs an iteration of the spin and one of each loop in store(),
 * taken or not, out of 65 535 for all: where they end, a store ends half way and nobody knows.
 * Three loops in store() fit. */
enum { SPIN_MAX = 1 << 20, SPIN_MAX_SOFTWARE = 16000 };

static void upper(char *name)
{
    for (; *name != '\0'; name++)
        *name = (char)toupper((unsigned char)*name);
}

static void define_option(fm_text *text, const fm_option *option, const char *value)
{
    char name[SHADER_NAME_BYTES], value_name[SHADER_NAME_BYTES];
    uint64_t number = 0;
    bool is_number = true;
    shader_name(name, option->name);
    upper(name);
    for (int i = 0; i < FM_MAX_OPTION_VALUES && option->values[i] != NULL; i++)
        is_number = is_number && text_to_u64(&number, option->values[i]);
    if (is_number && text_to_u64(&number, value)) {
        shader_define(text, name, number);
        return;
    }
    for (int i = 0; i < FM_MAX_OPTION_VALUES && option->values[i] != NULL; i++) {
        shader_name(value_name, option->values[i]);
        upper(value_name);
        text_add(text, "#define %s_%s %d\n", name, value_name, i);
        if (strcmp(option->values[i], value) == 0)
            shader_define(text, name, (uint64_t)i);
    }
}

static void define_culling(fm_text *text, const fm_pass *pass, const fm_settings *settings)
{
    shader_define(text, "FM_OWN_CULL", settings->own_cull == FM_OWN_CULL_ON);
    shader_define(text, "FM_CULL_IN_SHADER", culling_tests_in_shader(pass));
    if (culling_is_map_pass(pass))
        shader_define(text, "FM_CULL_WORDS", settings->cull_words);
}

/* Where prelude.glsl counts what. */
static void define_counters(fm_text *text)
{
    shader_define(text, "FM_COUNTER_LOST", STAGE_COUNTER_LOST);
    shader_define(text, "FM_COUNTER_CULLED", STAGE_COUNTER_CULLED);
    shader_define(text, "FM_COUNTER_LOCKED", STAGE_COUNTER_LOCKED);
    shader_define(text, "FM_COUNTER_REPAIRED", STAGE_COUNTER_REPAIRED);
    shader_define(text, "FM_COUNTER_UNREPAIRED", STAGE_COUNTER_UNREPAIRED);
    shader_define(text, "FM_COUNTER_ARRIVED", STAGE_COUNTER_ARRIVED);
    shader_define(text, "FM_COUNTER_IMAGE_LOW", STAGE_COUNTER_IMAGE_LOW);
    shader_define(text, "FM_COUNTER_IMAGE_HIGH", STAGE_COUNTER_IMAGE_HIGH);
    shader_define(text, "FM_COUNTER_GO_ON", STAGE_COUNTER_GO_ON);
    shader_define(text, "FM_COUNTER_CUT", STAGE_COUNTER_CUT);
}

/* By itself a lock is freed by a store where that is enough. */
static bool release_exchanges(const fm_instance *instance, const fm_pass *pass)
{
    switch (instance->desc.settings->release) {
    case FM_RELEASE_AUTO:
    case FM_RELEASE_COUNT:
        break;
    case FM_RELEASE_STORE:
        return false;
    case FM_RELEASE_EXCHANGE:
        return true;
    }
    return instance->device->caps.needs_lock_barriers && !pass_has_memory_model(instance, pass);
}

/* What a frame that is timed does not need to be told: far from the limit the checked one, which
 * runs the same loops, is enough. */
static bool tells_cut(const fm_instance *instance)
{
    const uint32_t limit = instance->device->caps.loop_limit;
    const uint64_t comparisons = (uint64_t)instance->workload.n * (instance->workload.k + 2);
    return limit > 0 && (instance->desc.is_capture || comparisons > limit / 16);
}

/* Where the words lie that lock.glsl exchanges, and lock_word.glsl reads. */
static void define_lock(fm_text *text, const fm_instance *instance, const fm_pass *pass)
{
    const char *word = pass->exclusive ? pass->lock_word : NULL;
    const bool in_word = pass_has_lock_in_word(instance, pass);
    const bool is_image =
        word != NULL &&
        instance->method->resources[resource_find(instance->method, word).index].kind ==
            FM_RESOURCE_IMAGE;
    shader_define(text, "FM_HAS_LOCK_WORD", word != NULL);
    shader_define(text, "FM_LOCK_IN_WORD", in_word);
    shader_define(text, "FM_LOCK_IN_IMAGE", in_word && is_image);
    if (is_image)
        text_add(text,
                 "#define fm_word_image fm_image_%s\n"
                 "#define fm_load_word(pixel) fm_load_%s(pixel).x\n"
                 "#define fm_store_word(pixel, value) fm_store_%s(pixel, uvec4(value))\n",
                 word, word, word);
    else if (word != NULL)
        text_add(text,
                 "#define fm_words %s\n"
                 "#define fm_load_word(pixel) %s[fm_pixel_index(pixel)]\n"
                 "#define fm_store_word(pixel, value) %s[fm_pixel_index(pixel)] = value\n",
                 word, word, word);
}

void pass_define(fm_text *text, const fm_instance *instance, const fm_pass *pass)
{
    const fm_device_caps *caps = &instance->device->caps;
    stage_define(text, instance->desc.stage, pass_geometry(instance, pass));
    shader_define(text, "K", instance->workload.k > 0 ? instance->workload.k : 1);
    shader_define(text, "N", instance->workload.n > 0 ? instance->workload.n : 1);
    shader_define(text, "FM_SPIN_MAX", caps->loop_limit > 0 ? SPIN_MAX_SOFTWARE : SPIN_MAX);
    shader_define(text, "FM_LOCK_EXCHANGE", release_exchanges(instance, pass));
    shader_define(text, "FM_MEMORY_MODEL", pass_has_memory_model(instance, pass));
    shader_define(text, "FM_EXCLUSIVE", pass->exclusive && instance->is_spin_locked);
    define_lock(text, instance, pass);
    shader_define(text, "FM_LOCK_WAITS", pass_lock_waits(instance, pass));
    shader_define(text, "FM_INTERLOCK", pass_has_interlock(instance, pass));
    shader_define(text, "FM_TARGETS", pass_has_fixed_function(pass));
    shader_define(text, "FM_EMIT_FIRST", pass_emits_first(instance, pass));
    shader_define(text, "FM_ACCUMULATE", (uint64_t)instance->desc.settings->accumulate);
    shader_define(text, "FM_BACK_TO_FRONT",
                  instance->desc.settings->composite == FM_COMPOSITE_BACK_TO_FRONT);
    define_culling(text, pass, instance->desc.settings);
    define_counters(text);
    shader_define(text, "FM_GROUP_LANES", FM_GROUP_LANES);
    shader_define(text, "FM_TILE_PX", FM_TILE_PX);
    shader_define(text, "FM_LOOP_LIMIT", caps->loop_limit);
    shader_define(text, "FM_RUN_ITERATIONS", pass_run_iterations(instance));
    shader_define(text, "FM_RESUMES", pass_resumes(instance, pass));
    shader_define(text, "FM_FEED_STEP", pass_feed_step(instance, pass));
    shader_define(text, "FM_TELLS_CUT", tells_cut(instance));
    shader_define(text, "FM_PASS_BIT", 1u << pass_number(instance, pass));
    shader_define(text, "FM_SUBGROUP_SIZE", caps->subgroup_size);
    shader_define(text, "FM_NARROW", instance_is_narrow(instance));
    shader_define_features(text, instance->method->features_optional, caps->features);
    if (instance->emits_back)
        shader_define(text, "FM_EMITS_BACK", 1);
    if (instance->desc.is_capture) {
        shader_define(text, "FM_CAPTURE", 1);
        shader_define(text, "FM_IS_STORE", pass->name != NULL && strcmp(pass->name, "store") == 0);
        shader_define(text, "FM_CAPTURE_SLOTS", instance->desc.capture_slots);
    }
    if (instance->desc.wants_primitive && pass_is_scene(pass)) {
        fm_draw draw = { 0 };
        stage_draw(&draw, instance->desc.stage, pass_geometry(instance, pass));
        shader_define(text, "FM_PRIMITIVE", 1);
        shader_define(text, "FM_INSTANCE_TRIANGLES", draw.vertex_count / 3);
        text_add(text, "uint fm_primitive;\n");
    }
    for (int i = 0; i < FM_MAX_OPTIONS && instance->method->options[i].name != NULL; i++)
        define_option(text, &instance->method->options[i],
                      option_chosen(instance->method, instance->method->options[i].name,
                                    instance->choices, instance->choice_count));
}
