/* How many bytes a method's resources are: by their formula, and of those that hold something. */
#include <string.h>

#include "instance_internal.h"
#include "model/formats.h"
#include "model/formula.h"

enum { LOCK_BYTES = 4 }; /* a word a pixel */

uint64_t lock_bytes(const fm_instance *instance)
{
    const uint64_t pixels = (uint64_t)instance->workload.width_px * instance->workload.height_px;
    for (size_t i = 0; i < instance->pass_count; i++)
        if (pass_has_own_locks(instance, &instance->method->passes[i]))
            return pixels * LOCK_BYTES;
    return 0;
}

uint64_t instance_bytes_predicted(const fm_instance *instance)
{
    return formula_sum(formula_bytes(instance->method, &instance->workload), lock_bytes(instance));
}

/* Bytes of a resource's elements that hold something: never more than there are. */
static uint64_t used_of(const fm_instance *instance, size_t index, const fm_workload *workload)
{
    const fm_resource *resource = &instance->method->resources[index];
    const uint64_t used = formula_used_bytes(resource, workload);
    const uint64_t there = instance->resources[index][0].length * element_bytes(resource->element);
    return resource->kind == FM_RESOURCE_BUFFER && used > there ? there : used;
}

/* What two buffers share counts once. */
static uint64_t used_with_sharers(const fm_instance *instance, size_t index,
                                  const fm_workload *workload)
{
    const char *name = instance->method->resources[index].name;
    uint64_t bytes = used_of(instance, index, workload);
    for (size_t i = 0; i < instance->resource_count; i++) {
        const fm_resource *other = &instance->method->resources[i];
        if (other->shares == NULL || strcmp(other->shares, name) != 0)
            continue;
        const uint64_t shared = used_of(instance, i, workload);
        bytes = shared > bytes ? shared : bytes;
    }
    return bytes;
}

uint64_t instance_bytes_used(const fm_instance *instance, uint64_t fragments_kept)
{
    fm_workload workload = instance->workload;
    uint64_t bytes = lock_bytes(instance);
    workload.fragments_kept = fragments_kept;
    for (size_t i = 0; i < instance->resource_count; i++)
        if (instance->method->resources[i].shares == NULL)
            bytes += used_with_sharers(instance, i, &workload);
    return bytes;
}
