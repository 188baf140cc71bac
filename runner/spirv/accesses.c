/* The rewritten module: what was there, with decorations, types, variables and one function added,
 * and a few instructions before each access and each end of the shader. */
#include "accesses.h"

#include <spirv/unified1/spirv.h>
#include <stdlib.h>

#include "places.h"
#include "words.h"

enum { CONSTANTS_MAX = 256, SCOPE_DEVICE = 1, VERSION_1_4 = 0x00010400 };

typedef struct constant {
    uint32_t value, id;
} constant;

/* Ids of what was added, or found because a module may have it once only. */
typedef struct common_ids {
    uint32_t uint_type, bool_type, void_type, function_type;
    uint32_t private_pointer, word_pointer, length_pointer;
    uint32_t bools[5]; /* vectors of so many; made when they are needed */
    uint32_t counters, add;
} common_ids;

typedef struct rewriting {
    const spirv_module *module;
    const spirv_counting *counting;
    spirv_places places;
    uint32_t entry; /* function where invocations begin */
    uint32_t next_id;
    common_ids ids;
    uint32_t *variables; /* [resource_count][SPIRV_COUNT_KINDS]: private ones; 0: not counted here.
                            Owned */
    constant constants[CONSTANTS_MAX];
    size_t constant_count;
    bool queries_images;
    spirv_words globals, body;
    fm_error *err;
} rewriting;

static uint32_t new_id(rewriting *of)
{
    return of->next_id++;
}

/* The type that the module has, so that it is not made twice; 0: it has none. */
static uint32_t find_type(const spirv_module *module, uint32_t opcode, const uint32_t *operands,
                          uint32_t count)
{
    for (size_t at = SPIRV_FIRST; at < module->count; at += spirv_at(module, at).count) {
        const spirv_instruction read = spirv_at(module, at);
        if (read.opcode == SpvOpFunction)
            return 0;
        bool is_it = read.opcode == opcode && read.count == count + 2;
        for (uint32_t i = 0; i < count && is_it; i++)
            is_it = read.words[2 + i] == operands[i];
        if (is_it)
            return read.words[1];
    }
    return 0;
}

static uint32_t need_type(rewriting *of, uint32_t opcode, const uint32_t *operands, uint32_t count)
{
    uint32_t id = find_type(of->module, opcode, operands, count);
    if (id != 0)
        return id;
    uint32_t words[4] = { id = new_id(of) };
    for (uint32_t i = 0; i < count; i++)
        words[1 + i] = operands[i];
    words_add_instruction(&of->globals, opcode, words, count + 1);
    return id;
}

static uint32_t pointer_to(rewriting *of, uint32_t storage, uint32_t type)
{
    const uint32_t id = new_id(of);
    words_put(&of->globals, SpvOpTypePointer, id, storage, type);
    return id;
}

static uint32_t constant_of(rewriting *of, uint32_t value)
{
    for (size_t i = 0; i < of->constant_count; i++)
        if (of->constants[i].value == value)
            return of->constants[i].id;
    const uint32_t id = new_id(of);
    words_put(&of->globals, SpvOpConstant, of->ids.uint_type, id, value);
    if (of->constant_count < CONSTANTS_MAX)
        of->constants[of->constant_count++] = (constant){ value, id };
    return id;
}

/* bool, or a vector of up to 4. */
static uint32_t bools_of(rewriting *of, uint32_t components)
{
    uint32_t *id = &of->ids.bools[components];
    if (*id == 0)
        *id =
            need_type(of, SpvOpTypeVector, (const uint32_t[]){ of->ids.bool_type, components }, 2);
    return *id;
}

/* Types first, so that what follows can name them. The buffer of counters is
 *   struct { uint words[]; }. */
static void add_common(rewriting *of)
{
    common_ids *ids = &of->ids;
    ids->uint_type = need_type(of, SpvOpTypeInt, (const uint32_t[]){ 32, 0 }, 2);
    ids->bool_type = need_type(of, SpvOpTypeBool, NULL, 0);
    ids->bools[1] = ids->bool_type;
    ids->void_type = need_type(of, SpvOpTypeVoid, NULL, 0);
    ids->function_type =
        need_type(of, SpvOpTypeFunction,
                  (const uint32_t[]){ ids->void_type, ids->uint_type, ids->uint_type }, 3);
    ids->private_pointer = pointer_to(of, SpvStorageClassPrivate, ids->uint_type);
    ids->word_pointer = pointer_to(of, SpvStorageClassStorageBuffer, ids->uint_type);
    ids->length_pointer = pointer_to(of, SpvStorageClassUniform, ids->uint_type);
    ids->counters = new_id(of);
    ids->add = new_id(of);
}

/* Returns its decorations, which stand before all types. */
static void add_counters(rewriting *of, spirv_words *decorations)
{
    const uint32_t array = new_id(of), block = new_id(of);
    words_put(&of->globals, SpvOpTypeRuntimeArray, array, of->ids.uint_type);
    words_put(&of->globals, SpvOpTypeStruct, block, array);
    const uint32_t pointer = pointer_to(of, SpvStorageClassStorageBuffer, block);
    words_put(&of->globals, SpvOpVariable, pointer, of->ids.counters, SpvStorageClassStorageBuffer);
    words_put(decorations, SpvOpDecorate, array, SpvDecorationArrayStride, sizeof(uint32_t));
    words_put(decorations, SpvOpDecorate, block, SpvDecorationBlock);
    words_put(decorations, SpvOpMemberDecorate, block, 0, SpvDecorationOffset, 0);
    words_put(decorations, SpvOpDecorate, of->ids.counters, SpvDecorationDescriptorSet, 0);
    words_put(decorations, SpvOpDecorate, of->ids.counters, SpvDecorationBinding,
              of->counting->counters_binding);
}

static uint32_t *variable_of(rewriting *of, uint32_t resource, spirv_count kind)
{
    return &of->variables[resource * SPIRV_COUNT_KINDS + (uint32_t)kind];
}

static void need_variable(rewriting *of, uint32_t resource, spirv_count kind)
{
    uint32_t *id = variable_of(of, resource, kind);
    if (*id != 0)
        return;
    const uint32_t zero = constant_of(of, 0);
    *id = new_id(of);
    words_put(&of->globals, SpvOpVariable, of->ids.private_pointer, *id, SpvStorageClassPrivate,
              zero);
}

/* Coordinates that are whole numbers, in one to four directions. */
static bool has_texels(const rewriting *of, uint32_t coordinates)
{
    spirv_instruction type = spirv_definition(of->module, spirv_type_of(of->module, coordinates));
    if (type.opcode == SpvOpTypeVector) {
        if (type.words[3] < 2 || type.words[3] > 4)
            return false;
        type = spirv_definition(of->module, type.words[2]);
    }
    return type.opcode == SpvOpTypeInt;
}

/* Whether it is to be seen that an element is beyond the end. */
static bool has_bounds(const rewriting *of, const spirv_access *access)
{
    if (access->image != 0)
        return has_texels(of, access->coordinates);
    return access->index != 0 && of->places.table != 0 &&
           of->places.length_members[access->resource] != UINT32_MAX;
}

static void add_to(rewriting *of, uint32_t resource, spirv_count kind, uint32_t value)
{
    const uint32_t before = new_id(of), after = new_id(of);
    const uint32_t variable = *variable_of(of, resource, kind);
    words_put(&of->body, SpvOpLoad, of->ids.uint_type, before, variable);
    words_put(&of->body, SpvOpIAdd, of->ids.uint_type, after, before, value);
    words_put(&of->body, SpvOpStore, variable, after);
}

/* The id of a bool: the element's number is not below the length in the table. */
static uint32_t beyond_length(rewriting *of, const spirv_access *access)
{
    const uint32_t pointer = new_id(of), length = new_id(of), beyond = new_id(of);
    const uint32_t member = constant_of(of, of->places.length_members[access->resource]);
    words_put(&of->body, SpvOpAccessChain, of->ids.length_pointer, pointer, of->places.table,
              member);
    words_put(&of->body, SpvOpLoad, of->ids.uint_type, length, pointer);
    words_put(&of->body, SpvOpUGreaterThanEqual, of->ids.bool_type, beyond, access->index, length);
    return beyond;
}

/* The image's value, without the sampler that textures come with. */
static uint32_t image_value(rewriting *of, const spirv_access *access)
{
    const uint32_t type = spirv_type_of(of->module, access->image), value = new_id(of);
    uint32_t storage = 0, pointee = 0;
    if (access->is_image_pointer && spirv_pointer(&storage, &pointee, of->module, type))
        words_put(&of->body, SpvOpLoad, pointee, value, access->image);
    else
        return access->image;
    return value;
}

static bool has_samples(const rewriting *of, uint32_t image)
{
    const spirv_instruction type = spirv_definition(of->module, spirv_type_of(of->module, image));
    return type.opcode == SpvOpTypeImage && type.words[6] != 0;
}

/* The id of a bool: some coordinate, taken as a number without a sign, is not below its side. */
static uint32_t beyond_sides(rewriting *of, const spirv_access *access)
{
    const uint32_t type = spirv_type_of(of->module, access->coordinates);
    const spirv_instruction vector = spirv_definition(of->module, type);
    const uint32_t components = vector.opcode == SpvOpTypeVector ? vector.words[3] : 1;
    const uint32_t sides = new_id(of), beyond = new_id(of);
    const uint32_t image = image_value(of, access);
    of->queries_images = true;
    if (access->is_fetched && !has_samples(of, image))
        words_put(&of->body, SpvOpImageQuerySizeLod, type, sides, image, constant_of(of, 0));
    else
        words_put(&of->body, SpvOpImageQuerySize, type, sides, image);
    words_put(&of->body, SpvOpUGreaterThanEqual, bools_of(of, components), beyond,
              access->coordinates, sides);
    if (components == 1)
        return beyond;
    const uint32_t any = new_id(of);
    words_put(&of->body, SpvOpAny, of->ids.bool_type, any, beyond);
    return any;
}

static void add_outside(rewriting *of, const spirv_access *access)
{
    const uint32_t one = constant_of(of, 1), zero = constant_of(of, 0);
    const uint32_t beyond =
        access->image != 0 ? beyond_sides(of, access) : beyond_length(of, access);
    const uint32_t number = new_id(of);
    words_put(&of->body, SpvOpSelect, of->ids.uint_type, number, beyond, one, zero);
    add_to(of, access->resource, SPIRV_OUTSIDE, number);
}

static void add_access(rewriting *of, const spirv_access *access)
{
    const uint32_t bytes = constant_of(of, access->bytes);
    if (access->loads)
        add_to(of, access->resource, SPIRV_LOADED, bytes);
    if (access->stores)
        add_to(of, access->resource, SPIRV_STORED, bytes);
    if (access->is_atomic)
        add_to(of, access->resource, SPIRV_ATOMICS, constant_of(of, 1));
    if (has_bounds(of, access))
        add_outside(of, access);
}

/* Where an invocation ends: each private number goes to its two words. */
static void add_end(rewriting *of)
{
    for (uint32_t i = 0; i < of->counting->resource_count * SPIRV_COUNT_KINDS; i++) {
        if (of->variables[i] == 0)
            continue;
        const uint32_t value = new_id(of), ignored = new_id(of), at = constant_of(of, 2 * i);
        words_put(&of->body, SpvOpLoad, of->ids.uint_type, value, of->variables[i]);
        words_put(&of->body, SpvOpFunctionCall, of->ids.void_type, ignored, of->ids.add, at, value);
    }
}

/* Begins a block that is reached if `condition` holds, and returns the block behind it. */
static uint32_t begin_if(rewriting *of, uint32_t condition)
{
    const uint32_t inside = new_id(of), behind = new_id(of);
    words_put(&of->body, SpvOpSelectionMerge, behind, SpvSelectionControlMaskNone);
    words_put(&of->body, SpvOpBranchConditional, condition, inside, behind);
    words_put(&of->body, SpvOpLabel, inside);
    return behind;
}

static void end_if(rewriting *of, uint32_t behind)
{
    words_put(&of->body, SpvOpBranch, behind);
    words_put(&of->body, SpvOpLabel, behind);
}

/* The old value of counters.words[at]. All invocations collide; sums come out the same in any
 * order. */
static uint32_t add_atomic(rewriting *of, uint32_t at, uint32_t value)
{
    const uint32_t pointer = new_id(of), old = new_id(of);
    const uint32_t zero = constant_of(of, 0), device = constant_of(of, SCOPE_DEVICE);
    words_put(&of->body, SpvOpAccessChain, of->ids.word_pointer, pointer, of->ids.counters, zero,
              at);
    words_put(&of->body, SpvOpAtomicIAdd, of->ids.uint_type, old, pointer, device, zero, value);
    return old;
}

/* void add(uint at, uint value): a sum of 64 bits in two words. Whoever makes the low word wrap
 * carries one to the high word. */
static void add_function(rewriting *of)
{
    const uint32_t at = new_id(of), value = new_id(of), some = new_id(of), high = new_id(of);
    const uint32_t sum = new_id(of), wraps = new_id(of);
    const uint32_t zero = constant_of(of, 0), one = constant_of(of, 1);
    words_put(&of->body, SpvOpFunction, of->ids.void_type, of->ids.add, SpvFunctionControlMaskNone,
              of->ids.function_type);
    words_put(&of->body, SpvOpFunctionParameter, of->ids.uint_type, at);
    words_put(&of->body, SpvOpFunctionParameter, of->ids.uint_type, value);
    words_put(&of->body, SpvOpLabel, new_id(of));
    words_put(&of->body, SpvOpINotEqual, of->ids.bool_type, some, value, zero);
    const uint32_t behind = begin_if(of, some);
    const uint32_t old = add_atomic(of, at, value);
    words_put(&of->body, SpvOpIAdd, of->ids.uint_type, sum, old, value);
    words_put(&of->body, SpvOpULessThan, of->ids.bool_type, wraps, sum, value);
    const uint32_t behind_carry = begin_if(of, wraps);
    words_put(&of->body, SpvOpIAdd, of->ids.uint_type, high, at, one);
    add_atomic(of, high, one);
    end_if(of, behind_carry);
    end_if(of, behind);
    words_add_instruction(&of->body, SpvOpReturn, NULL, 0);
    words_add_instruction(&of->body, SpvOpFunctionEnd, NULL, 0);
}

static bool is_end(const rewriting *of, uint32_t function, uint16_t opcode)
{
    return (opcode == SpvOpReturn && function == of->entry) || opcode == SpvOpKill ||
           opcode == SpvOpTerminateInvocation;
}

/* Goes through all functions. is_written false: only finds what is counted, since the shader may
 * end before its text has told. */
static fm_status go_through(rewriting *of, size_t first, bool is_written)
{
    fm_status status = FM_OK;
    uint32_t function = 0;
    for (size_t at = first; at < of->module->count && status == FM_OK;) {
        const spirv_instruction read = spirv_at(of->module, at);
        spirv_access access = { 0 };
        if (read.opcode == SpvOpFunction)
            function = read.words[2];
        if (read.opcode == SpvOpDemoteToHelperInvocation)
            return fm_refuse(of->err, FM_REASON_SUITE_LIMIT,
                             "accesses cannot be counted: an invocation becomes a helper");
        status = places_find(&access, &of->places, &read, of->err);
        if (status == FM_OK && access.is_counted && is_written)
            add_access(of, &access);
        if (access.is_counted && !is_written) {
            if (access.loads)
                need_variable(of, access.resource, SPIRV_LOADED);
            if (access.stores)
                need_variable(of, access.resource, SPIRV_STORED);
            if (access.is_atomic)
                need_variable(of, access.resource, SPIRV_ATOMICS);
            if (has_bounds(of, &access))
                need_variable(of, access.resource, SPIRV_OUTSIDE);
        }
        if (is_written && is_end(of, function, read.opcode))
            add_end(of);
        if (is_written)
            words_add(&of->body, read.words, read.count);
        at += read.count;
    }
    return status;
}

/* Sections of a module, as places of words: annotations may begin at the first, types end before
 * the second. */
typedef struct sections {
    size_t annotations, functions, entry_point;
} sections;

static bool is_annotation_or_type(uint16_t opcode)
{
    return (opcode >= SpvOpTypeVoid && opcode <= SpvOpTypeForwardPointer) ||
           (opcode >= SpvOpDecorate && opcode <= SpvOpGroupMemberDecorate);
}

static fm_status find_sections(sections *found, rewriting *of)
{
    const spirv_module *module = of->module;
    *found = (sections){ 0 };
    for (size_t at = SPIRV_FIRST; at < module->count; at += spirv_at(module, at).count) {
        const spirv_instruction read = spirv_at(module, at);
        if (read.opcode == SpvOpEntryPoint && found->entry_point != 0)
            return fm_refuse(of->err, FM_REASON_SUITE_LIMIT,
                             "accesses cannot be counted: two entry points");
        if (read.opcode == SpvOpEntryPoint) {
            found->entry_point = at;
            of->entry = read.words[2];
        }
        if (found->annotations == 0 && is_annotation_or_type(read.opcode))
            found->annotations = at;
        if (read.opcode == SpvOpFunction) {
            found->functions = at;
            break;
        }
    }
    if (found->entry_point == 0 || found->annotations < found->entry_point ||
        found->functions < found->annotations)
        return fm_fail(of->err, FM_INVALID, "SPIR-V: no shader");
    return FM_OK;
}

/* From 1.4 on an entry point lists all variables that it uses. */
static void write_entry_point(spirv_words *out, const rewriting *of, size_t at)
{
    const spirv_instruction read = spirv_at(of->module, at);
    spirv_words operands = { 0 };
    words_add(&operands, read.words + 1, read.count - 1);
    if (of->module->words[1] >= VERSION_1_4) {
        words_add(&operands, &of->ids.counters, 1);
        for (uint32_t i = 0; i < of->counting->resource_count * SPIRV_COUNT_KINDS; i++)
            if (of->variables[i] != 0)
                words_add(&operands, &of->variables[i], 1);
    }
    out->failed = out->failed || operands.failed;
    words_add_instruction(out, SpvOpEntryPoint, operands.items, operands.count);
    words_free(&operands);
}

/* A capability may be said twice. */
static void write_module(spirv_words *out, const rewriting *of, const sections *found,
                         const spirv_words *decorations)
{
    const uint32_t *words = of->module->words;
    const size_t behind = found->entry_point + spirv_at(of->module, found->entry_point).count;
    words_add(out, words, 3);
    words_add(out, &of->next_id, 1);
    words_add(out, words + 4, 1);
    if (of->queries_images)
        words_put(out, SpvOpCapability, SpvCapabilityImageQuery);
    words_add(out, words + SPIRV_FIRST, found->entry_point - SPIRV_FIRST);
    write_entry_point(out, of, found->entry_point);
    words_add(out, words + behind, found->annotations - behind);
    words_add(out, decorations->items, decorations->count);
    words_add(out, words + found->annotations, found->functions - found->annotations);
    words_add(out, of->globals.items, of->globals.count);
    words_add(out, of->body.items, of->body.count);
    out->failed = out->failed || of->globals.failed || of->body.failed || decorations->failed;
}

static fm_status rewrite(spirv_words *out, rewriting *of)
{
    sections found;
    spirv_words decorations = { 0 };
    fm_status status = find_sections(&found, of);
    if (status != FM_OK)
        return status;
    add_common(of);
    add_counters(of, &decorations);
    status = go_through(of, found.functions, false);
    if (status == FM_OK)
        status = go_through(of, found.functions, true);
    if (status == FM_OK) {
        add_function(of);
        write_module(out, of, &found, &decorations);
        if (out->failed)
            status = fm_fail(of->err, FM_NO_MEMORY, "SPIR-V: %zu words", of->module->count);
    }
    words_free(&decorations);
    return status;
}

fm_status spirv_count_accesses(uint32_t **counted, size_t *counted_words, const uint32_t *words,
                               size_t count, const spirv_counting *counting, fm_error *err)
{
    spirv_module module;
    spirv_words out = { 0 };
    *counted = NULL;
    *counted_words = 0;
    fm_status status = spirv_open(&module, words, count, err);
    if (status != FM_OK)
        return status;
    rewriting of = { .module = &module, .counting = counting, .next_id = module.bound, .err = err };
    of.variables =
        calloc((size_t)counting->resource_count * SPIRV_COUNT_KINDS + 1, sizeof of.variables[0]);
    if (of.variables == NULL)
        status = fm_fail(err, FM_NO_MEMORY, "SPIR-V: %u resources", counting->resource_count);
    if (status == FM_OK)
        status = places_open(&of.places, &module, counting, err);
    if (status == FM_OK)
        status = rewrite(&out, &of);
    if (status == FM_OK) {
        *counted = out.items;
        *counted_words = out.count;
        out = (spirv_words){ 0 };
    }
    words_free(&out);
    words_free(&of.globals);
    words_free(&of.body);
    free(of.variables);
    places_close(&of.places);
    spirv_close(&module);
    return status;
}
