#include "roofline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double number(const fm_case_row *result, fm_metric metric)
{
    return result->metric[metric];
}

static bool has_bound(const fm_case_row *result)
{
    return result->is_measured && !result->look.is_control &&
           number(result, FM_METRIC_TIMES_BOUND) > 0.0 &&
           number(result, FM_METRIC_DEVICE_BYTES_PER_S) > 0.0;
}

double roofline_bytes(const fm_case_row *result)
{
    const double bytes =
        number(result, FM_METRIC_BYTES_MOVED) / number(result, FM_METRIC_FRAGMENTS_GENERATED);
    return bytes > 0.0 && isfinite(bytes) ? bytes : NAN;
}

/* Two machines' calibrations of one device are two. */
static bool is_of(const fm_roofline *of, const fm_case_row *result)
{
    return strcmp(of->device_name, result->device_name) == 0 &&
           of->bytes_per_s == number(result, FM_METRIC_DEVICE_BYTES_PER_S);
}

static fm_roofline *find(fm_rooflines *made, const fm_case_row *result)
{
    for (size_t i = 0; i < made->count; i++)
        if (is_of(&made->items[i], result))
            return &made->items[i];
    return NULL;
}

static fm_roofline *add_device(fm_rooflines *made, const fm_case_row *result, size_t room)
{
    fm_roofline *grown = reallocarray(made->items, made->count + 1, sizeof *grown);
    if (grown == NULL)
        return NULL;
    made->items = grown;
    grown[made->count] =
        (fm_roofline){ .device_name = result->device_name,
                       .bytes_per_s = number(result, FM_METRIC_DEVICE_BYTES_PER_S),
                       .fragments_per_s = number(result, FM_METRIC_DEVICE_FRAGMENTS_PER_S),
                       .cases = calloc(room, sizeof *grown->cases) };
    return grown[made->count].cases != NULL ? &grown[made->count++] : NULL;
}

/* A method's cases stand together, in the order of their families. */
static int compare_methods(const void *a, const void *b)
{
    const fm_case_row *x = *(const fm_case_row *const *)a, *y = *(const fm_case_row *const *)b;
    if (x->look.family != y->look.family)
        return x->look.family < y->look.family ? -1 : 1;
    const int method = strcmp(x->method, y->method);
    const int options = method != 0 ? method : strcmp(x->options, y->options);
    return options != 0 ? options : strcmp(x->id, y->id);
}

static int compare_bounds(const void *a, const void *b)
{
    const fm_case_row *x = *(const fm_case_row *const *)a, *y = *(const fm_case_row *const *)b;
    const double first = number(x, FM_METRIC_TIMES_BOUND);
    const double second = number(y, FM_METRIC_TIMES_BOUND);
    return first != second ? (first < second ? -1 : 1) : compare_methods(a, b);
}

fm_status rooflines_make(fm_rooflines *made, const fm_result_files *results, fm_error *err)
{
    *made = (fm_rooflines){ 0 };
    for (size_t i = 0; i < results->count; i++) {
        const fm_case_row *result = &results->cases[i];
        if (!has_bound(result))
            continue;
        fm_roofline *of = find(made, result);
        if (of == NULL)
            of = add_device(made, result, results->count);
        if (of == NULL) {
            rooflines_free(made);
            return fm_fail(err, FM_NO_MEMORY, "charts of devices");
        }
        of->cases[of->count++] = result;
    }
    for (size_t i = 0; i < made->count; i++)
        qsort(made->items[i].cases, made->items[i].count, sizeof *made->items[i].cases,
              compare_methods);
    return FM_OK;
}

void rooflines_free(fm_rooflines *made)
{
    for (size_t i = 0; i < made->count; i++)
        free(made->items[i].cases);
    free(made->items);
    *made = (fm_rooflines){ 0 };
}

const fm_case_row **roofline_sorted(const fm_roofline *of)
{
    const fm_case_row **sorted = calloc(of->count + 1, sizeof *sorted);
    if (sorted == NULL)
        return NULL;
    memcpy(sorted, of->cases, of->count * sizeof *sorted);
    qsort(sorted, of->count, sizeof *sorted, compare_bounds);
    return sorted;
}
