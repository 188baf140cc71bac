#include "formula.h"

#include <string.h>

#include "device/device.h"
#include "text.h"

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
    const int total = total_index(method, extent->total);
    const uint64_t terms[] = {
        product_of(extent->per_pixel, pixels),
        product_of(product_of(extent->per_pixel_k, pixels), workload->k),
        product_of(product_of(extent->per_pixel_n, pixels), workload->n),
        product_of(extent->per_tile, workload_tiles(workload)),
        product_of(extent->per_triangle, workload->triangles),
        product_of(extent->per_total, total >= 0 ? workload->totals[total] : 0),
        product_of(extent->per_option, option_number(workload, extent->option)),
    };
    uint64_t elements = extent->constant;
    for (size_t i = 0; i < sizeof terms / sizeof terms[0]; i++)
        elements = formula_sum(elements, terms[i]);
    return elements;
}

uint32_t formula_layers(const fm_resource *resource, const fm_workload *workload)
{
    const uint32_t layers = resource->layers + resource->layers_per_k * workload->k;
    return layers > 0 ? layers : 1;
}

uint32_t formula_samples(const fm_resource *resource, const fm_workload *workload)
{
    const uint32_t samples = resource->samples + resource->samples_per_k * workload->k;
    return samples > 0 ? samples : 1;
}

uint64_t formula_image_bytes(const fm_resource *resource, const fm_workload *workload)
{
    const uint64_t pixels = (uint64_t)workload->width_px * workload->height_px;
    return pixels * fm_format_bytes(resource->format) * formula_layers(resource, workload) *
           formula_samples(resource, workload);
}

uint64_t formula_bytes(const fm_method_desc *method, const fm_workload *workload)
{
    uint64_t bytes = 0;
    if (method->bytes != NULL)
        return method->bytes(workload);
    for (int i = 0; i < FM_MAX_RESOURCES && method->resources[i].name != NULL; i++) {
        const fm_resource *resource = &method->resources[i];
        const uint64_t elements = formula_elements(method, &resource->extent, workload);
        const uint64_t one =
            resource->kind == FM_RESOURCE_IMAGE
                ? formula_image_bytes(resource, workload)
                : product_of(elements > 0 ? elements : 1, fm_element_bytes(resource->element));
        bytes = formula_sum(bytes, product_of(one, resource->ping_pong ? 2 : 1));
    }
    return bytes;
}
