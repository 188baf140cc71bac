#include "rounding.h"

#include <math.h>

/* What fragments can do, whichever come in whichever order. */
typedef struct worst {
    double through;        /* g: 1 - the smallest alpha */
    double colour;         /* c: the largest channel */
    bool is_premultiplied; /* no colour exceeds its alpha: C stays below 1 */
} worst;

static worst find_worst(const fm_fragment *fragments, uint32_t count)
{
    worst found = { 0, 0, true };
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t colour = fragments[i].colour;
        const double alpha = (colour >> 24) / 255.0;
        found.through = fmax(found.through, 1 - alpha);
        for (int channel = 0; channel < 3; channel++) {
            const double c = (colour >> (8 * channel) & 0xFFu) / 255.0;
            found.colour = fmax(found.colour, c);
            found.is_premultiplied = found.is_premultiplied && c <= alpha;
        }
    }
    return found;
}

double rounding_ulp(fm_accumulate format, double value)
{
    const int digits = format == FM_ACCUMULATE_FLOAT16 ? 11 : 24;
    const int least = format == FM_ACCUMULATE_FLOAT16 ? -24 : -149;
    int exponent;
    if (format == FM_ACCUMULATE_UNORM8)
        return 1 / 255.0;
    (void)frexp(value, &exponent); /* value < 2^exponent */
    return ldexp(1, value > 0 && exponent - digits > least ? exponent - digits : least);
}

/* Half a step at the largest value that this may be, and what float32 rounds below it. */
static double half_step(fm_accumulate format, double most)
{
    return (0.5 + 0x1p-9) * rounding_ulp(format, most);
}

/* What reading a value up to 1 moves it: those of 8 bits have no step of their own format to go. */
static double read_step(fm_accumulate format)
{
    return format == FM_ACCUMULATE_FLOAT16 ? 0x1p-12 : 0;
}

typedef struct moved {
    double shows, sum;         /* t, s */
    double kept;               /* h */
    double by_shows, by_front; /* e, E */
} moved;

static void add_front(moved *at, fm_accumulate format, const worst *of)
{
    const double read = read_step(format), shown = fmin(at->kept, at->shows + at->by_shows);
    const double added = (1 + 0x1p-8) * (of->colour + read) * shown; /* as half_step's part */
    at->sum += of->colour * at->shows;
    at->sum = of->is_premultiplied ? fmin(1, at->sum) : at->sum;
    at->by_front += of->colour * at->by_shows + read * shown;
    at->by_front += fmin(half_step(format, at->sum + at->by_front), added);
}

static void add_back(moved *at, fm_accumulate format, const worst *of)
{
    const double read = read_step(format), before = at->sum + at->by_front;
    at->sum = of->colour + of->through * at->sum;
    at->sum = of->is_premultiplied ? fmin(1, at->sum) : at->sum;
    at->by_front = of->through * at->by_front + read * (1 + before);
    at->by_front += half_step(format, at->sum + at->by_front);
}

/* Rounding keeps the order of values: what T is at most is rounded as T is. */
static double most_kept(fm_accumulate format, const worst *of, double kept)
{
    if (format == FM_ACCUMULATE_UNORM8) /* no product lies within 1/510 of half way */
        return floor(255 * of->through * kept + 0.5 + 1e-6) / 255;
    return fmin(1, (of->through + read_step(format)) * kept + half_step(format, kept));
}

static void let_through(moved *at, fm_accumulate format, const worst *of)
{
    const double most = at->kept;
    at->by_shows = of->through * at->by_shows + read_step(format) * most;
    at->by_shows += half_step(format, most);
    at->shows *= of->through;
    at->kept = most_kept(format, of, most);
    at->by_shows = fmin(at->by_shows, fmax(at->shows, at->kept));
}

double rounding_bound(fm_rounding rounding, const fm_fragment *fragments, uint32_t count,
                      uint32_t most)
{
    const fm_accumulate format = rounding.accumulate;
    moved at = { .shows = 1, .kept = 1 };
    if (format == FM_ACCUMULATE_FLOAT32)
        return 0;
    const worst of = find_worst(fragments, count);
    for (uint32_t i = 0; i < count && i < most; i++) {
        if (rounding.composite == FM_COMPOSITE_BACK_TO_FRONT)
            add_back(&at, format, &of);
        else
            add_front(&at, format, &of);
        let_through(&at, format, &of);
    }
    if (format == FM_ACCUMULATE_UNORM8 && of.is_premultiplied)
        at.by_front = fmin(1, at.by_front); /* both are in [0, 1] */
    if (format == FM_ACCUMULATE_UNORM8)     /* what lies above 1 is cut off */
        at.by_front += fmax(0, at.sum - 1);
    return fmax(at.by_front, at.by_shows);
}

double rounding_ulps_apart(fm_accumulate format, const double low[4], const double high[4],
                           const float rgba[4])
{
    double largest = 0;
    for (int channel = 0; channel < 4; channel++) {
        const double value = (double)rgba[channel];
        if (!isfinite(value))
            return INFINITY;
        const double nearest = fmin(fmax(value, low[channel]), high[channel]);
        const double at = channel == 3 ? fmax(nearest, 1 - nearest) : nearest;
        largest = fmax(largest, fabs(value - nearest) / rounding_ulp(format, at));
    }
    return largest;
}
