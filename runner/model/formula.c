#include "formula.h"

#include <string.h>

#include "base/text.h"
#include "model/formats.h"

int total_index(const fm_method_desc *method, const char *name)
{
    for (int i = 0; name != NULL && i < FM_MAX_TOTALS && method->totals[i].name != NULL; i++)
        if (strcmp(method->totals[i].name, name) == 0)
            return i;
    return -1;
}

uint64_t workload_tiles(const fm_workload *workload)
{
    const uint64_t across = (workload->width_px + FM_TILE_PX - 1) / FM_TILE_PX;
    const uint64_t down = (workload->height_px + FM_TILE_PX - 1) / FM_TILE_PX;
    return across * down;
}

static uint64_t option_number(const fm_workload *workload, const char *name)
{
    const char *value = name != NULL ? workload->option(workload, name) : NULL;
    uint64_t number = 0;
    return value != NULL && text_to_u64(&number, value) ? number : 0;
}

uint64_t formula_sum(uint64_t a, uint64_t b)
{
    uint64_t sum;
    return __builtin_add_overflow(a, b, &sum) ? UINT64_MAX : sum;
}

static uint64_t product_of(uint64_t a, uint64_t b)
{
    uint64_t product;
    return __builtin_mul_overflow(a, b, &product) ? UINT64_MAX : product;
}

uint64_t formula_elements(const fm_method_desc *method, const fm_extent *extent,
                          const fm_workload *workload)
{
    const uint64_t pixels = (uint64_t)workload->width_px * workload->height_px;
    const uint64_t step = extent->k_step > 0 ? extent->k_step : 1;
    const int total = total_index(method, extent->total);
    const uint64_t option = option_number(workload, extent->option);
    const uint64_t terms[] = {
        product_of(extent->per_pixel, pixels),
        product_of(product_of(extent->per_pixel_k, pixels), (workload->k + step - 1) / step),
        product_of(product_of(extent->per_pixel_n, pixels), workload->n),
        product_of(extent->per_tile, workload_tiles(workload)),
        product_of(extent->per_triangle, workload->triangles),
        product_of(extent->per_total, total >= 0 ? workload->totals[total] : 0),
        product_of(extent->per_option, option),
        product_of(product_of(extent->per_pixel_option, pixels), option),
        product_of(extent->per_fragment, workload->fragments),
    };
    uint64_t elements = extent->constant;
    for (size_t i = 0; i < sizeof terms / sizeof terms[0]; i++)
        elements = formula_sum(elements, terms[i]);
    return elements;
}

/* Elements of each pixel, as far as they do not hang on anything else. */
static uint64_t elements_of_pixel(const fm_extent *extent, const fm_workload *workload)
{
    const uint64_t step = extent->k_step > 0 ? extent->k_step : 1;
    return extent->per_pixel + extent->per_pixel_k * ((workload->k + step - 1) / step) +
           extent->per_pixel_n * workload->n +
           extent->per_pixel_option * option_number(workload, extent->option);
}

uint32_t formula_layers(const fm_resource *resource, const fm_workload *workload)
{
    const uint64_t layers = resource->layers + (uint64_t)resource->layers_per_k * workload->k +
                            elements_of_pixel(&resource->extent, workload);
    return layers == 0 ? 1 : layers < UINT32_MAX ? (uint32_t)layers : UINT32_MAX;
}

bool image_is_array(const fm_resource *resource)
{
    const fm_extent *e = &resource->extent;
    return resource->layers > 1 || resource->layers_per_k > 0 ||
           (e->per_pixel | e->per_pixel_k | e->per_pixel_n | e->per_pixel_option) != 0;
}

uint32_t formula_samples(const fm_resource *resource, const fm_workload *workload)
{
    const uint32_t samples = resource->samples + resource->samples_per_k * workload->k +
                             (uint32_t)option_number(workload, resource->samples_option);
    return samples > 0 ? samples : 1;
}

bool loop_is_counted(const fm_loop *loop)
{
    return loop->count > 0 || loop->count_per_k > 0 || loop->count_per_n > 0 ||
           loop->count_option != NULL;
}

uint32_t formula_count(const fm_loop *loop, const fm_workload *workload)
{
    return loop->count + loop->count_per_k * workload->k + loop->count_per_n * workload->n +
           (uint32_t)option_number(workload, loop->count_option);
}

uint64_t formula_image_bytes(const fm_resource *resource, const fm_workload *workload)
{
    const uint64_t pixels = (uint64_t)workload->width_px * workload->height_px;
    return pixels * format_bytes(resource->format) * formula_layers(resource, workload) *
           formula_samples(resource, workload);
}

static uint64_t own_bytes(const fm_method_desc *method, const fm_resource *resource,
                          const fm_workload *workload)
{
    const uint64_t elements = formula_elements(method, &resource->extent, workload);
    return product_of(elements > 0 ? elements : 1, element_bytes(resource->element));
}

uint64_t formula_buffer_bytes(const fm_method_desc *method, const fm_resource *resource,
                              const fm_workload *workload)
{
    uint64_t bytes = own_bytes(method, resource, workload);
    for (int i = 0; i < FM_MAX_RESOURCES && method->resources[i].name != NULL; i++) {
        const fm_resource *other = &method->resources[i];
        if (other->shares == NULL || strcmp(other->shares, resource->name) != 0)
            continue;
        const uint64_t shared = own_bytes(method, other, workload);
        bytes = shared > bytes ? shared : bytes;
    }
    return bytes;
}

/* As formula_buffer_bytes, for a pool that grows once a frame has shown how much it needs. */
static uint64_t booked_bytes(const fm_method_desc *method, const fm_resource *resource,
                             const fm_workload *workload)
{
    if (resource->kind == FM_RESOURCE_IMAGE)
        return formula_image_bytes(resource, workload);
    const uint64_t first = formula_buffer_bytes(method, resource, workload);
    const uint64_t grown = product_of(formula_elements(method, &resource->grown, workload),
                                      element_bytes(resource->element));
    return grown > first ? grown : first;
}

uint64_t formula_bytes(const fm_method_desc *method, const fm_workload *workload)
{
    uint64_t bytes = 0;
    for (int i = 0; i < FM_MAX_RESOURCES && method->resources[i].name != NULL; i++) {
        const fm_resource *resource = &method->resources[i];
        const uint64_t copies = resource->ping_pong ? 2 : 1;
        if (resource->shares == NULL)
            bytes =
                formula_sum(bytes, product_of(booked_bytes(method, resource, workload), copies));
    }
    return bytes;
}

static bool has_used(const fm_used *used)
{
    return (used->per_pixel | used->per_fragment | used->per_kept) != 0;
}

uint64_t formula_used_bytes(const fm_resource *resource, const fm_workload *workload)
{
    const uint64_t pixels = (uint64_t)workload->width_px * workload->height_px;
    const uint64_t elements = resource->used.per_pixel * pixels +
                              resource->used.per_fragment * workload->fragments +
                              resource->used.per_kept * workload->fragments_kept;
    if (resource->kind == FM_RESOURCE_BUFFER)
        return elements * element_bytes(resource->element);
    const uint64_t whole = formula_image_bytes(resource, workload);
    const uint64_t used = elements * format_bytes(resource->format);
    return has_used(&resource->used) && used < whole ? used : whole;
}
