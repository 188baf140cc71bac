/* The pass that counts accesses: what it makes is valid SPIR-V, and what it cannot read is refused.
 * That the numbers are right is tested where shaders run (instance/counts_test.c). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <shaderc/shaderc.h>
#include <spirv-tools/libspirv.h>
#include <spirv/unified1/spirv.h>

#include "base/random.h"
#include "spirv/accesses.h"
#include "spirv/module.h"

typedef struct shader {
    shaderc_compilation_result_t result;
    const uint32_t *words;
    size_t count;
} shader;

/* A buffer by binding, one by address, and an image. */
static const spirv_resource resources[] = {
    { .binding = 2, .length_offset = 8 },
    { .by_address = true, .address_offset = 16, .length_offset = 24 },
    { .binding = 3, .texel_bytes = 4 },
    { .binding = 4, .texel_bytes = 16 },
};
static const spirv_counting counting = {
    .resources = resources, .resource_count = 4, .table_binding = 1, .counters_binding = 9
};

static const char head[] =
    "#version 450\n"
    "#extension GL_EXT_buffer_reference : require\n"
    "layout(std430, binding = 2) coherent buffer bound_block { uvec2 bound[]; };\n"
    "layout(buffer_reference, std430, buffer_reference_align = 16) buffer reference { uint "
    "items[]; "
    "};\n"
    "layout(std140, binding = 1) uniform table { layout(offset = 8) uint length_bound;\n"
    "    layout(offset = 16) reference addressed; layout(offset = 24) uint length_addressed; };\n"
    "layout(binding = 3, r32ui) uniform uimage2DArray image;\n"
    "layout(binding = 4) uniform sampler2D texels;\n"
    "layout(std430, binding = 5) buffer other_block { uint other[]; };\n"
    "void touch(uint i)\n{\n"
    "    bound[i] = uvec2(bound[i + 1u].x, 3u);\n"
    "    addressed.items[i] += 1u;\n"
    "    atomicMax(addressed.items[i], atomicAdd(bound[i].y, 2u));\n"
    "    imageStore(image, ivec3(i, 0, 1), uvec4(imageLoad(image, ivec3(0)).x));\n"
    "    imageAtomicExchange(image, ivec3(1), uint(texelFetch(texels, ivec2(i), 0).x));\n"
    "    other[i] = 1u;\n}\n";
static const char compute_main[] = "layout(local_size_x = 64) in;\n"
                                   "void main()\n{\n"
                                   "    if (gl_GlobalInvocationID.x > 99u)\n        return;\n"
                                   "    touch(gl_GlobalInvocationID.x);\n}\n";
static const char fragment_main[] =
    "layout(location = 0) out vec4 colour;\n"
    "void leave()\n{\n    discard;\n}\n"
    "void main()\n{\n"
    "    if (gl_FragCoord.x > 7.0)\n        leave();\n"
    "    touch(uint(gl_FragCoord.y));\n    colour = vec4(1.0);\n}\n";
static const char idle_main[] =
    "layout(local_size_x = 1) in;\nvoid main()\n{\n    other[0] = 1u;\n}\n";

static shader compile(const char *main, shaderc_shader_kind kind)
{
    char text[4096];
    snprintf(text, sizeof text, "%s%s", head, main);
    shaderc_compiler_t compiler = shaderc_compiler_initialize();
    shaderc_compile_options_t options = shaderc_compile_options_initialize();
    shaderc_compile_options_set_target_env(options, shaderc_target_env_vulkan,
                                           shaderc_env_version_vulkan_1_3);
    shaderc_compile_options_set_optimization_level(options, shaderc_optimization_level_zero);
    shader made = { .result = shaderc_compile_into_spv(compiler, text, strlen(text), kind, "test",
                                                       "main", options) };
    if (shaderc_result_get_compilation_status(made.result) != shaderc_compilation_status_success)
        fail_msg("%s", shaderc_result_get_error_message(made.result));
    made.words = (const uint32_t *)(const void *)shaderc_result_get_bytes(made.result);
    made.count = shaderc_result_get_length(made.result) / sizeof(uint32_t);
    shaderc_compile_options_release(options);
    shaderc_compiler_release(compiler);
    return made;
}

static void expect_valid(const uint32_t *words, size_t count)
{
    spv_diagnostic diagnostic = NULL;
    spv_context context = spvContextCreate(SPV_ENV_VULKAN_1_3);
    const spv_result_t result = spvValidateBinary(context, words, count, &diagnostic);
    if (result != SPV_SUCCESS)
        fail_msg("not valid: %s", diagnostic != NULL ? diagnostic->error : "no reason");
    spvDiagnosticDestroy(diagnostic);
    spvContextDestroy(context);
}

static uint32_t instructions(const uint32_t *words, size_t count, uint32_t opcode)
{
    uint32_t found = 0;
    for (size_t at = SPIRV_FIRST; at < count; at += words[at] >> SpvWordCountShift)
        found += (words[at] & SpvOpCodeMask) == opcode;
    return found;
}

static void what_counts_is_valid(void **state)
{
    static const struct {
        const char *main;
        shaderc_shader_kind kind;
    } shaders[] = { { compute_main, shaderc_compute_shader },
                    { fragment_main, shaderc_fragment_shader },
                    { idle_main, shaderc_compute_shader } };
    (void)state;
    for (size_t i = 0; i < sizeof shaders / sizeof shaders[0]; i++) {
        fm_error err = { .message = "" };
        uint32_t *counted;
        size_t count;
        shader made = compile(shaders[i].main, shaders[i].kind);
        expect_valid(made.words, made.count);
        if (spirv_count_accesses(&counted, &count, made.words, made.count, &counting, &err) !=
            FM_OK)
            fail_msg("%s", err.message);
        expect_valid(counted, count);
        free(counted);
        shaderc_result_release(made.result);
    }
}

/* All that is written is in private variables, but for the two atomics of the one function that
 * adds to the counters. */
static void only_counted_resources_cost_instructions(void **state)
{
    uint32_t *counted;
    size_t count;
    (void)state;
    shader made = compile(idle_main, shaderc_compute_shader);
    assert_int_equal(
        spirv_count_accesses(&counted, &count, made.words, made.count, &counting, NULL), FM_OK);
    assert_int_equal(instructions(counted, count, SpvOpStore),
                     instructions(made.words, made.count, SpvOpStore));
    assert_int_equal(instructions(counted, count, SpvOpAtomicIAdd), 2);
    assert_int_equal(instructions(counted, count, SpvOpFunctionCall), 0);
    free(counted);
    shaderc_result_release(made.result);
}

/* Loads, stores, atomics and bounds: how often each is added to. */
static void every_access_is_counted_once(void **state)
{
    uint32_t *counted;
    size_t count;
    (void)state;
    shader made = compile(compute_main, shaderc_compute_shader);
    assert_int_equal(
        spirv_count_accesses(&counted, &count, made.words, made.count, &counting, NULL), FM_OK);
    /* bound: load, store, atomic (3); addressed: load, store, atomic (3); image: store, load,
     * atomic (3); texels: a load. An atomic is added to loads, stores and atomics. */
    const uint32_t loads = 6 + 1, stores = 6, atomics = 3, bounds = 10;
    assert_int_equal(instructions(counted, count, SpvOpStore) -
                         instructions(made.words, made.count, SpvOpStore),
                     loads + stores + atomics + bounds);
    assert_int_equal(instructions(counted, count, SpvOpSelect) -
                         instructions(made.words, made.count, SpvOpSelect),
                     bounds);
    free(counted);
    shaderc_result_release(made.result);
}

static void assemble(uint32_t **words, size_t *count, const char *text)
{
    spv_binary binary = NULL;
    spv_diagnostic diagnostic = NULL;
    spv_context context = spvContextCreate(SPV_ENV_VULKAN_1_3);
    if (spvTextToBinary(context, text, strlen(text), &binary, &diagnostic) != SPV_SUCCESS)
        fail_msg("%s", diagnostic->error);
    *words = malloc(binary->wordCount * sizeof **words);
    assert_non_null(*words);
    memcpy(*words, binary->code, binary->wordCount * sizeof **words);
    *count = binary->wordCount;
    spvBinaryDestroy(binary);
    spvContextDestroy(context);
}

/* What is between is `%pointer`, of type %word_pointer. */
#define MODULE(pointer)                                                                            \
    "OpCapability Shader\nOpCapability VariablePointers\nOpMemoryModel Logical GLSL450\n"          \
    "OpEntryPoint GLCompute %main \"main\" %buffer\nOpExecutionMode %main LocalSize 1 1 1\n"       \
    "OpDecorate %array ArrayStride 4\nOpDecorate %block Block\n"                                   \
    "OpMemberDecorate %block 0 Offset 0\nOpDecorate %buffer DescriptorSet 0\n"                     \
    "OpDecorate %buffer Binding 2\n%void = OpTypeVoid\n%function = OpTypeFunction %void\n"         \
    "%uint = OpTypeInt 32 0\n%bool = OpTypeBool\n%true = OpConstantTrue %bool\n"                   \
    "%zero = OpConstant %uint 0\n%array = OpTypeRuntimeArray %uint\n%block = OpTypeStruct "        \
    "%array\n%pointer_type = OpTypePointer StorageBuffer %block\n"                                 \
    "%word_pointer = OpTypePointer StorageBuffer %uint\n"                                          \
    "%buffer = OpVariable %pointer_type StorageBuffer\n"                                           \
    "%main = OpFunction %void None %function\n%begin = OpLabel\n"                                  \
    "%a = OpAccessChain %word_pointer %buffer %zero %zero\n" pointer                               \
    "%value = OpLoad %uint %pointer\nOpReturn\nOpFunctionEnd\n"

static fm_status count_text(const char *text, fm_error *err)
{
    uint32_t *words, *counted;
    size_t count, counted_words;
    assemble(&words, &count, text);
    const fm_status status =
        spirv_count_accesses(&counted, &counted_words, words, count, &counting, err);
    free(words);
    free(counted);
    return status;
}

static void a_pointer_chosen_at_run_time_is_refused(void **state)
{
    fm_error err = { .message = "" };
    (void)state;
    assert_int_equal(count_text(MODULE("%pointer = OpCopyObject %word_pointer %a\n"), &err), FM_OK);
    assert_int_equal(count_text(MODULE("%pointer = OpSelect %word_pointer %true %a %a\n"), &err),
                     FM_UNSUPPORTED);
    assert_non_null(strstr(err.message, "chosen while the shader runs"));
}

static void what_is_no_shader_is_refused(void **state)
{
    static const uint32_t other[] = { 1, 2, 3, 4, 5, 6 };
    static const uint32_t empty[] = { SpvMagicNumber, 0x00010600, 0, 4, 0 };
    static const uint32_t twice[] = {
        SpvMagicNumber,           0x00010600, 0, 4, 0, 2u << 16 | SpvOpTypeVoid, 1,
        2u << 16 | SpvOpTypeVoid, 1
    };
    static const uint32_t too_short[] = { SpvMagicNumber,          0x00010600, 0, 4, 0,
                                          2u << 16 | SpvOpTypeInt, 1 };
    uint32_t *counted = NULL;
    size_t count;
    fm_error err = { .message = "" };
    (void)state;
    assert_int_equal(spirv_count_accesses(&counted, &count, other, 6, &counting, &err), FM_INVALID);
    assert_int_equal(spirv_count_accesses(&counted, &count, empty, 3, &counting, &err), FM_INVALID);
    assert_int_equal(spirv_count_accesses(&counted, &count, empty, 5, &counting, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "no shader"));
    assert_int_equal(spirv_count_accesses(&counted, &count, twice, 9, &counting, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "word 7: id 1 is made twice"));
    assert_int_equal(spirv_count_accesses(&counted, &count, too_short, 7, &counting, &err),
                     FM_INVALID);
    assert_non_null(strstr(err.message, "2 words"));
    assert_null(counted);
}

/* Whatever is wrong with it, a module costs no crash. */
static void damaged_modules_are_survived(void **state)
{
    uint64_t random = 7;
    (void)state;
    shader made = compile(compute_main, shaderc_compute_shader);
    uint32_t *words = malloc(made.count * sizeof *words);
    assert_non_null(words);
    for (int i = 0; i < 3000; i++) {
        uint32_t *counted;
        size_t count, length = made.count;
        memcpy(words, made.words, made.count * sizeof *words);
        if (i % 3 == 0)
            length = random_below(&random, (uint32_t)made.count);
        for (int j = 0; j < 1 + i % 4; j++) {
            const uint32_t at = random_below(&random, (uint32_t)made.count);
            words[at] = i % 2 == 0 ? random_below(&random, 200) : (uint32_t)random_next(&random);
        }
        /* exactly as long as it says, so that a sanitizer sees who reads behind it */
        uint32_t *exact = malloc(length * sizeof *words + 1);
        assert_non_null(exact);
        memcpy(exact, words, length * sizeof *words);
        spirv_count_accesses(&counted, &count, exact, length, &counting, NULL);
        free(counted);
        free(exact);
    }
    free(words);
    shaderc_result_release(made.result);
}

static void sizes_are_those_in_memory(void **state)
{
    static const char text[] =
        "OpCapability Shader\nOpMemoryModel Logical GLSL450\nOpDecorate %4 ArrayStride 16\n"
        "%1 = OpTypeInt 32 0\n%2 = OpTypeVector %1 3\n%3 = OpConstant %1 5\n"
        "%4 = OpTypeArray %2 %3\n%5 = OpTypeStruct %1 %4\n%6 = OpTypeRuntimeArray %1\n"
        "%7 = OpTypeFloat 64\n";
    uint32_t *words;
    size_t count;
    spirv_module module;
    spv_binary binary = NULL;
    spv_context context = spvContextCreate(SPV_ENV_VULKAN_1_3);
    (void)state;
    assert_int_equal(spvTextToBinaryWithOptions(context, text, strlen(text),
                                                SPV_TEXT_TO_BINARY_OPTION_PRESERVE_NUMERIC_IDS,
                                                &binary, NULL),
                     SPV_SUCCESS);
    words = binary->code;
    count = binary->wordCount;
    assert_int_equal(spirv_open(&module, words, count, NULL), FM_OK);
    assert_int_equal(spirv_bytes(&module, 1), 4);
    assert_int_equal(spirv_bytes(&module, 2), 12);
    assert_int_equal(spirv_bytes(&module, 4), 80);
    assert_int_equal(spirv_bytes(&module, 5), 84);
    assert_int_equal(spirv_bytes(&module, 6), 0);
    assert_int_equal(spirv_bytes(&module, 7), 8);
    assert_int_equal(spirv_bytes(&module, 99), 0);
    spirv_close(&module);
    spvBinaryDestroy(binary);
    spvContextDestroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_counts_is_valid),
        cmocka_unit_test(only_counted_resources_cost_instructions),
        cmocka_unit_test(every_access_is_counted_once),
        cmocka_unit_test(a_pointer_chosen_at_run_time_is_refused),
        cmocka_unit_test(what_is_no_shader_is_refused),
        cmocka_unit_test(damaged_modules_are_survived),
        cmocka_unit_test(sizes_are_those_in_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
