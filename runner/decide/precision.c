#include "precision.h"

#include <assert.h>
#include <math.h>

#include "levels.h"

static const double level_of_all = 0.05;

void precision_looks(fm_precision_looks *looks, uint32_t last)
{
    assert(last > 0);
    *looks = (fm_precision_looks){ 0 };
    for (uint32_t at = PRECISION_FIRST; 2 * at <= last && looks->count + 1 < PRECISION_LOOKS_MAX;
         at *= 2)
        looks->launches[looks->count++] = at;
    looks->launches[looks->count++] = last;
    const fm_status status =
        levels_split(looks->levels, looks->launches, looks->count, level_of_all, NULL);
    assert(status == FM_OK);
    (void)status;
}

bool precision_has_look(uint32_t last, uint32_t launches)
{
    fm_precision_looks looks;
    size_t i = 0;
    precision_looks(&looks, last);
    while (i < looks.count && looks.launches[i] != launches)
        i++;
    return i < looks.count;
}

double precision_coverage(uint32_t last, uint32_t launches)
{
    fm_precision_looks looks;
    size_t i = 0;
    precision_looks(&looks, last);
    while (i + 1 < looks.count && looks.launches[i] < launches)
        i++;
    return 1.0 - looks.levels[i];
}

double precision_half_width(const fm_interval *interval)
{
    const double half = 0.5 * (interval->high - interval->low);
    return half == 0.0 ? 0.0 : half / interval->median;
}
