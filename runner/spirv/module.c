#include "module.h"

#define SPV_ENABLE_UTILITY_CODE
#include <spirv/unified1/spirv.h>
#include <stdlib.h>

extern inline void SpvHasResultAndType(SpvOp opcode, bool *hasResult, bool *hasResultType);

enum { IDS_MAX = 1 << 22, STEPS_MAX = 4096 };

/* How many words of what is looked into there are at least. */
static const struct opcode_length {
    uint16_t opcode, least;
} lengths[] = {
    { SpvOpEntryPoint, 4 },
    { SpvOpTypeInt, 4 },
    { SpvOpTypeFloat, 3 },
    { SpvOpTypeVector, 4 },
    { SpvOpTypeMatrix, 4 },
    { SpvOpTypeImage, 9 },
    { SpvOpTypeArray, 4 },
    { SpvOpTypeRuntimeArray, 3 },
    { SpvOpTypePointer, 4 },
    { SpvOpConstant, 4 },
    { SpvOpFunction, 5 },
    { SpvOpVariable, 4 },
    { SpvOpImageTexelPointer, 6 },
    { SpvOpLoad, 4 },
    { SpvOpStore, 3 },
    { SpvOpCopyMemory, 3 },
    { SpvOpCopyMemorySized, 4 },
    { SpvOpAccessChain, 4 },
    { SpvOpInBoundsAccessChain, 4 },
    { SpvOpCopyObject, 4 },
    { SpvOpSampledImage, 5 },
    { SpvOpImage, 4 },
    { SpvOpImageSampleImplicitLod, 5 },
    { SpvOpImageSampleExplicitLod, 5 },
    { SpvOpImageFetch, 5 },
    { SpvOpImageRead, 5 },
    { SpvOpImageWrite, 4 },
    { SpvOpAtomicStore, 5 },
};

enum { LEAST_OF_ATOMIC = 6 }; /* that returns something */

static uint32_t least_length(uint16_t opcode)
{
    bool has_result = false, has_type = false;
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++)
        if (lengths[i].opcode == opcode)
            return lengths[i].least;
    if (opcode >= SpvOpAtomicLoad && opcode <= SpvOpAtomicXor)
        return LEAST_OF_ATOMIC;
    SpvHasResultAndType((SpvOp)opcode, &has_result, &has_type);
    return 1u + has_result + has_type;
}

/* The word of an instruction that is the id it makes; 0: it makes none. */
static uint32_t result_word(uint16_t opcode)
{
    bool has_result = false, has_type = false;
    SpvHasResultAndType((SpvOp)opcode, &has_result, &has_type);
    return has_result ? 1u + has_type : 0;
}

spirv_instruction spirv_at(const spirv_module *module, size_t at)
{
    const uint32_t *words = module->words + at;
    return (spirv_instruction){ .words = words,
                                .count = words[0] >> SpvWordCountShift,
                                .opcode = (uint16_t)(words[0] & SpvOpCodeMask) };
}

static fm_status take_instruction(spirv_module *module, size_t at, fm_error *err)
{
    const spirv_instruction read = spirv_at(module, at);
    if (read.count == 0 || read.count > module->count - at)
        return fm_fail(err, FM_INVALID, "SPIR-V, word %zu: the instruction is cut off", at);
    if (read.count < least_length(read.opcode))
        return fm_fail(err, FM_INVALID, "SPIR-V, word %zu: %u words, opcode %u has %u at least", at,
                       read.count, read.opcode, least_length(read.opcode));
    if (result_word(read.opcode) == 0)
        return FM_OK;
    const uint32_t id = read.words[result_word(read.opcode)];
    if (id == 0 || id >= module->bound || module->defined_at[id] != 0)
        return fm_fail(err, FM_INVALID, "SPIR-V, word %zu: id %u is %s", at, id,
                       id == 0 || id >= module->bound ? "out of range" : "made twice");
    module->defined_at[id] = at;
    return FM_OK;
}

fm_status spirv_open(spirv_module *module, const uint32_t *words, size_t count, fm_error *err)
{
    *module = (spirv_module){ .words = words, .count = count };
    if (count < SPIRV_FIRST || count > SPIRV_WORDS_MAX || words[0] != SpvMagicNumber)
        return fm_fail(err, FM_INVALID, "SPIR-V: %zu words that are no module", count);
    if (words[3] == 0 || words[3] > IDS_MAX)
        return fm_fail(err, FM_INVALID, "SPIR-V, word 3: %u ids", words[3]);
    module->bound = words[3];
    module->defined_at = calloc(module->bound, sizeof module->defined_at[0]);
    if (module->defined_at == NULL)
        return fm_fail(err, FM_NO_MEMORY, "SPIR-V: %u ids", module->bound);
    fm_status status = FM_OK;
    for (size_t at = SPIRV_FIRST; at < count && status == FM_OK; at += spirv_at(module, at).count)
        status = take_instruction(module, at, err);
    if (status != FM_OK)
        spirv_close(module);
    return status;
}

void spirv_close(spirv_module *module)
{
    free(module->defined_at);
    module->defined_at = NULL;
}

spirv_instruction spirv_definition(const spirv_module *module, uint32_t id)
{
    if (id >= module->bound || module->defined_at[id] == 0)
        return (spirv_instruction){ .opcode = 0 };
    return spirv_at(module, module->defined_at[id]);
}

bool spirv_constant(uint32_t *value, const spirv_module *module, uint32_t id)
{
    const spirv_instruction made = spirv_definition(module, id);
    if (made.opcode != SpvOpConstant || made.count != 4)
        return false;
    *value = made.words[3];
    return true;
}

bool spirv_decoration(uint32_t *literal, const spirv_module *module, uint32_t id,
                      uint32_t decoration)
{
    for (size_t at = SPIRV_FIRST; at < module->count; at += spirv_at(module, at).count) {
        const spirv_instruction read = spirv_at(module, at);
        if (read.opcode == SpvOpFunction)
            return false;
        if (read.opcode != SpvOpDecorate || read.count < 4 || read.words[1] != id ||
            read.words[2] != decoration)
            continue;
        *literal = read.words[3];
        return true;
    }
    return false;
}

bool spirv_member_decoration(uint32_t *literal, const spirv_module *module, uint32_t id,
                             uint32_t member, uint32_t decoration)
{
    for (size_t at = SPIRV_FIRST; at < module->count; at += spirv_at(module, at).count) {
        const spirv_instruction read = spirv_at(module, at);
        if (read.opcode == SpvOpFunction)
            return false;
        if (read.opcode != SpvOpMemberDecorate || read.count < 5 || read.words[1] != id ||
            read.words[2] != member || read.words[3] != decoration)
            continue;
        *literal = read.words[4];
        return true;
    }
    return false;
}

uint32_t spirv_type_of(const spirv_module *module, uint32_t id)
{
    const spirv_instruction made = spirv_definition(module, id);
    return result_word(made.opcode) == 2 ? made.words[1] : 0;
}

bool spirv_pointer(uint32_t *storage, uint32_t *pointee, const spirv_module *module, uint32_t type)
{
    const spirv_instruction made = spirv_definition(module, type);
    if (made.opcode != SpvOpTypePointer)
        return false;
    *storage = made.words[2];
    *pointee = made.words[3];
    return true;
}

/* steps: how many types may still be looked at, which bounds what a hostile module costs. */
static uint64_t bytes_of(const spirv_module *module, uint32_t type, int *steps);

static uint64_t array_bytes(const spirv_module *module, const spirv_instruction *made, int *steps)
{
    uint32_t length = 0, stride = 0;
    if (!spirv_constant(&length, module, made->words[3]))
        return 0;
    if (spirv_decoration(&stride, module, made->words[1], SpvDecorationArrayStride))
        return (uint64_t)length * stride;
    return length * bytes_of(module, made->words[2], steps);
}

static uint64_t struct_bytes(const spirv_module *module, const spirv_instruction *made, int *steps)
{
    uint64_t sum = 0;
    for (uint32_t i = 2; i < made->count; i++) {
        const uint64_t member = bytes_of(module, made->words[i], steps);
        if (member == 0)
            return 0;
        sum += member;
    }
    return sum;
}

static uint64_t bytes_of(const spirv_module *module, uint32_t type, int *steps)
{
    const spirv_instruction made = spirv_definition(module, type);
    if (--*steps < 0)
        return 0;
    switch (made.opcode) {
    case SpvOpTypeInt:
    case SpvOpTypeFloat:
        return made.words[2] / 8;
    case SpvOpTypeVector:
    case SpvOpTypeMatrix:
        return made.words[3] <= 16 ? made.words[3] * bytes_of(module, made.words[2], steps) : 0;
    case SpvOpTypeArray:
        return array_bytes(module, &made, steps);
    case SpvOpTypeStruct:
        return struct_bytes(module, &made, steps);
    case SpvOpTypePointer:
        return made.words[2] == SpvStorageClassPhysicalStorageBuffer ? 8 : 0;
    default:
        return 0;
    }
}

uint64_t spirv_bytes(const spirv_module *module, uint32_t type)
{
    int steps = STEPS_MAX;
    const uint64_t bytes = bytes_of(module, type, &steps);
    return bytes <= UINT32_MAX ? bytes : 0;
}
