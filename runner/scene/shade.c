#include "shade.h"

uint32_t shade(vec3 normal, uint32_t base, double alpha)
{
    static const vec3 light = { 0.35, 0.80, 0.49 };
    const double length = sqrt(dot(normal, normal));
    const double cosine = length > 0.0 ? fmin(1.0, fabs(dot(normal, light)) / length) : 0.0;
    const uint32_t grey = (uint32_t)lround(64.0 + 191.0 * cosine);
    const uint32_t a = (uint32_t)lround(alpha * 255.0);
    uint32_t colour = a << 24;
    for (uint32_t shift = 0; shift < 24; shift += 8)
        colour |= ((base >> shift & 0xFFu) * grey / 255u * a + 127u) / 255u << shift;
    return colour;
}
