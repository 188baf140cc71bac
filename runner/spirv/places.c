#include "places.h"

#include <spirv/unified1/spirv.h>
#include <stdlib.h>

enum { CHAIN_MAX = 64 }; /* of pointers made from pointers */

static fm_status refuse(fm_error *err, const char *what)
{
    return fm_refuse(err, FM_REASON_SUITE_LIMIT, "accesses cannot be counted: %s", what);
}

static uint32_t bound_resource(const spirv_counting *counting, uint32_t binding)
{
    for (uint32_t i = 0; i < counting->resource_count; i++)
        if (!counting->resources[i].by_address && counting->resources[i].binding == binding)
            return i + 1;
    return 0;
}

/* The member of the table at this offset; UINT32_MAX: none. */
static uint32_t table_member(const spirv_module *module, const spirv_instruction *table,
                             uint32_t offset)
{
    uint32_t at = 0;
    for (uint32_t member = 0; member + 2 < table->count; member++)
        if (spirv_member_decoration(&at, module, table->words[1], member, SpvDecorationOffset) &&
            at == offset)
            return member;
    return UINT32_MAX;
}

static bool is_uint(const spirv_module *module, uint32_t type)
{
    const spirv_instruction made = spirv_definition(module, type);
    return made.opcode == SpvOpTypeInt && made.words[2] == 32 && made.words[3] == 0;
}

/* The type behind the address of a resource is its alone. */
static fm_status take_addressed(spirv_places *places, const spirv_instruction *table, uint32_t i,
                                fm_error *err)
{
    const uint32_t member =
        table_member(places->module, table, places->counting->resources[i].address_offset);
    uint32_t storage = 0, pointee = 0;
    if (member == UINT32_MAX)
        return FM_OK; /* not in this shader */
    if (!spirv_pointer(&storage, &pointee, places->module, table->words[2 + member]) ||
        pointee >= places->module->bound || places->resource_of[pointee] != 0)
        return refuse(err, "a member of the table that is no address of its own");
    places->resource_of[pointee] = i + 1;
    return FM_OK;
}

static fm_status take_table(spirv_places *places, uint32_t type, fm_error *err)
{
    const spirv_instruction table = spirv_definition(places->module, type);
    fm_status status = FM_OK;
    if (table.opcode != SpvOpTypeStruct)
        return refuse(err, "the table is no block");
    for (uint32_t i = 0; i < places->counting->resource_count && status == FM_OK; i++) {
        const spirv_resource *resource = &places->counting->resources[i];
        const uint32_t member = resource->texel_bytes > 0
                                    ? UINT32_MAX
                                    : table_member(places->module, &table, resource->length_offset);
        if (member != UINT32_MAX && is_uint(places->module, table.words[2 + member]))
            places->length_members[i] = member;
        if (resource->by_address)
            status = take_addressed(places, &table, i, err);
    }
    return status;
}

static fm_status take_variable(spirv_places *places, const spirv_instruction *variable,
                               fm_error *err)
{
    const uint32_t id = variable->words[2];
    uint32_t storage = 0, pointee = 0, binding = 0;
    if (!spirv_pointer(&storage, &pointee, places->module, variable->words[1]) ||
        !spirv_decoration(&binding, places->module, id, SpvDecorationBinding))
        return FM_OK;
    if (storage == SpvStorageClassStorageBuffer || storage == SpvStorageClassUniformConstant)
        places->resource_of[id] = bound_resource(places->counting, binding);
    if (storage != SpvStorageClassUniform || binding != places->counting->table_binding)
        return FM_OK;
    places->table = id;
    return take_table(places, pointee, err);
}

fm_status places_open(spirv_places *places, const spirv_module *module,
                      const spirv_counting *counting, fm_error *err)
{
    *places = (spirv_places){ .module = module, .counting = counting };
    places->resource_of = calloc(module->bound, sizeof places->resource_of[0]);
    places->length_members = calloc(counting->resource_count + 1, sizeof(uint32_t));
    fm_status status = places->resource_of != NULL && places->length_members != NULL
                           ? FM_OK
                           : fm_fail(err, FM_NO_MEMORY, "SPIR-V: %u ids", module->bound);
    for (uint32_t i = 0; i < counting->resource_count && status == FM_OK; i++)
        places->length_members[i] = UINT32_MAX;
    for (size_t at = SPIRV_FIRST; at < module->count && status == FM_OK;
         at += spirv_at(module, at).count) {
        const spirv_instruction read = spirv_at(module, at);
        if (read.opcode == SpvOpFunction)
            break;
        if (read.opcode == SpvOpVariable)
            status = take_variable(places, &read, err);
    }
    if (status != FM_OK)
        places_close(places);
    return status;
}

void places_close(spirv_places *places)
{
    free(places->resource_of);
    free(places->length_members);
    *places = (spirv_places){ 0 };
}

/* Where a pointer points: into a resource (0: none), at a value of a type. */
typedef struct place {
    uint32_t resource, type, index;
} place;

/* One step into a value; a struct's is a constant. */
static fm_status step_into(place *at, const spirv_module *module, uint32_t index, fm_error *err)
{
    const spirv_instruction made = spirv_definition(module, at->type);
    uint32_t member = 0;
    switch (made.opcode) {
    case SpvOpTypeStruct:
        if (!spirv_constant(&member, module, index) || member >= made.count - 2)
            return refuse(err, "a member that is not there");
        at->type = made.words[2 + member];
        return FM_OK;
    case SpvOpTypeRuntimeArray:
        at->index = index;
        at->type = made.words[2];
        return FM_OK;
    case SpvOpTypeArray:
    case SpvOpTypeVector:
    case SpvOpTypeMatrix:
        at->type = made.words[2];
        return FM_OK;
    default:
        return refuse(err, "an index into what has no elements");
    }
}

static fm_status find_place(place *at, const spirv_places *places, uint32_t pointer, int depth,
                            fm_error *err)
{
    const spirv_module *module = places->module;
    const spirv_instruction made = spirv_definition(module, pointer);
    uint32_t storage = 0, pointee = 0;
    *at = (place){ 0 };
    if (!spirv_pointer(&storage, &pointee, module, spirv_type_of(module, pointer)))
        return refuse(err, "a pointer without a type");
    if (storage != SpvStorageClassStorageBuffer && storage != SpvStorageClassPhysicalStorageBuffer)
        return FM_OK;
    fm_status status = FM_OK;
    switch (depth > CHAIN_MAX ? SpvOpNop : made.opcode) {
    case SpvOpVariable:
        *at = (place){ .resource = places->resource_of[pointer], .type = pointee };
        return FM_OK;
    case SpvOpLoad: /* an address */
        if (pointee >= module->bound)
            return refuse(err, "an address of nothing");
        *at = (place){ .resource = places->resource_of[pointee], .type = pointee };
        return FM_OK;
    case SpvOpCopyObject:
        return find_place(at, places, made.words[3], depth + 1, err);
    case SpvOpAccessChain:
    case SpvOpInBoundsAccessChain:
        status = find_place(at, places, made.words[3], depth + 1, err);
        for (uint32_t i = 4; i < made.count && status == FM_OK && at->resource != 0; i++)
            status = step_into(at, module, made.words[i], err);
        return status;
    default:
        return refuse(err, "a pointer that is chosen while the shader runs");
    }
}

/* The variable that an image, or a pointer to it, is of; 0: not to be seen. */
static uint32_t image_variable(const spirv_module *module, uint32_t id)
{
    for (int i = 0; i < CHAIN_MAX; i++) {
        const spirv_instruction made = spirv_definition(module, id);
        switch (made.opcode) {
        case SpvOpVariable:
            return id;
        case SpvOpLoad:
        case SpvOpCopyObject:
        case SpvOpSampledImage:
        case SpvOpImage:
        case SpvOpAccessChain:
        case SpvOpInBoundsAccessChain:
            id = made.words[3];
            break;
        default:
            return 0;
        }
    }
    return 0;
}

static fm_status find_image(spirv_access *access, const spirv_places *places, uint32_t image,
                            uint32_t coordinates, fm_error *err)
{
    const uint32_t variable = image_variable(places->module, image);
    if (variable == 0)
        return refuse(err, "an image that is chosen while the shader runs");
    const uint32_t resource = places->resource_of[variable];
    if (resource == 0)
        return FM_OK;
    access->is_counted = true;
    access->resource = resource - 1;
    access->bytes = places->counting->resources[resource - 1].texel_bytes;
    access->image = image;
    access->coordinates = coordinates;
    return FM_OK;
}

static fm_status find_buffer(spirv_access *access, const spirv_places *places, uint32_t pointer,
                             fm_error *err)
{
    place at;
    const fm_status status = find_place(&at, places, pointer, 0, err);
    if (status != FM_OK || at.resource == 0)
        return status;
    access->is_counted = true;
    access->resource = at.resource - 1;
    access->index = at.index;
    access->bytes = (uint32_t)spirv_bytes(places->module, at.type);
    return access->bytes > 0 ? FM_OK : refuse(err, "a value of unknown size");
}

/* Of a buffer, or of a texel. */
static fm_status find_atomic(spirv_access *access, const spirv_places *places, uint32_t pointer,
                             fm_error *err)
{
    const spirv_instruction made = spirv_definition(places->module, pointer);
    access->is_atomic = true;
    if (made.opcode != SpvOpImageTexelPointer)
        return find_buffer(access, places, pointer, err);
    access->is_image_pointer = true;
    return find_image(access, places, made.words[3], made.words[4], err);
}

static fm_status find(spirv_access *access, const spirv_places *places,
                      const spirv_instruction *read, fm_error *err)
{
    switch (read->opcode) {
    case SpvOpLoad:
        access->loads = true;
        return find_buffer(access, places, read->words[3], err);
    case SpvOpStore:
        access->stores = true;
        return find_buffer(access, places, read->words[1], err);
    case SpvOpImageSampleImplicitLod:
    case SpvOpImageSampleExplicitLod:
        access->loads = true; /* the coordinates are no numbers of texels */
        return find_image(access, places, read->words[3], 0, err);
    case SpvOpImageFetch:
        access->is_fetched = true;
        access->loads = true;
        return find_image(access, places, read->words[3], read->words[4], err);
    case SpvOpImageRead:
        access->loads = true;
        return find_image(access, places, read->words[3], read->words[4], err);
    case SpvOpImageWrite:
        access->stores = true;
        return find_image(access, places, read->words[1], read->words[2], err);
    case SpvOpAtomicLoad:
        access->loads = true;
        return find_atomic(access, places, read->words[3], err);
    case SpvOpAtomicStore:
        access->stores = true;
        return find_atomic(access, places, read->words[1], err);
    case SpvOpAtomicExchange:
    case SpvOpAtomicCompareExchange:
    case SpvOpAtomicIIncrement:
    case SpvOpAtomicIDecrement:
    case SpvOpAtomicIAdd:
    case SpvOpAtomicISub:
    case SpvOpAtomicSMin:
    case SpvOpAtomicUMin:
    case SpvOpAtomicSMax:
    case SpvOpAtomicUMax:
    case SpvOpAtomicAnd:
    case SpvOpAtomicOr:
    case SpvOpAtomicXor:
        access->loads = access->stores = true;
        return find_atomic(access, places, read->words[3], err);
    default:
        return FM_OK;
    }
}

/* A copy from place to place is not made by the compiler here; it is seen only to be refused. */
static fm_status expect_no_copy(const spirv_places *places, const spirv_instruction *read,
                                fm_error *err)
{
    place target, source;
    fm_status status = find_place(&target, places, read->words[1], 0, err);
    if (status == FM_OK)
        status = find_place(&source, places, read->words[2], 0, err);
    if (status == FM_OK && (target.resource != 0 || source.resource != 0))
        status = refuse(err, "a copy in memory");
    return status;
}

fm_status places_find(spirv_access *access, const spirv_places *places,
                      const spirv_instruction *instruction, fm_error *err)
{
    *access = (spirv_access){ 0 };
    if (instruction->opcode == SpvOpCopyMemory || instruction->opcode == SpvOpCopyMemorySized)
        return expect_no_copy(places, instruction, err);
    const fm_status status = find(access, places, instruction, err);
    if (status == FM_OK && !access->is_counted)
        *access = (spirv_access){ 0 };
    return status;
}
