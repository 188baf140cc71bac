#include "flip_view.h"

#include <math.h>

/* The curve (n2 x^2 + n1 x) / (d2 x^2 + d1 x + d0), Narkowicz's fit of ACES, of 0.6 x. */
static const float n2 = 0.6f * 0.6f * 2.51f, n1 = 0.6f * 0.03f;
static const float d2 = 0.6f * 0.6f * 2.43f, d1 = 0.6f * 0.59f, d0 = 0.14f;

static float clamped(float value)
{
    const float least = value > 0.0f ? value : 0.0f;
    return least < 1.0f ? least : 1.0f;
}

/* Beyond this the curve has reached its end, and squares might overflow. */
static const float most = 1e6f;

static float tone_mapped(float x)
{
    x = x > 0.0f ? x : 0.0f;
    x = x < most ? x : most;
    return (x * (n2 * x + n1)) / (x * (d2 * x + d1) + d0);
}

void flip_view_row(float *const rgb[3], const flip_view *view, size_t row)
{
    const size_t width = view->image->width_px;
    const float *rgba = view->image->rgba + row * width * 4;
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < width; i++) {
            const float shown = rgba[4 * i + c] + (1.0f - rgba[4 * i + 3]);
            rgb[c][i] = clamped(view->is_tone_mapped ? tone_mapped(shown * view->gain) : shown);
        }
}

/* The larger root of a x^2 + b x + c. */
double flip_tone_of_exposures(void)
{
    const double wanted = 0.85;
    const double a = (double)n2 - wanted * (double)d2, b = (double)n1 - wanted * (double)d1;
    const double c = -wanted * (double)d0;
    return (-b + sqrt(b * b - 4 * a * c)) / (2 * a);
}
