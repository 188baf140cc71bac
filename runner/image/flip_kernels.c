#include "flip_kernels.h"

#include <math.h>

/* exp(-pi^2 d^2 / width), d in degrees: the transform of a Gaussian over frequencies. */
typedef struct contrast {
    double height, width; /* a and b of the paper's table 1 */
} contrast;

static const contrast sensitivity[FLIP_GAUSSIANS] = {
    [FLIP_ACHROMATIC] = { 1, 0.0047 }, /* its second Gaussian has height 0 */
    [FLIP_RED_GREEN] = { 1, 0.0053 },
    [FLIP_BLUE_YELLOW] = { 34.1, 0.04 },
    [FLIP_BLUE_YELLOW_NARROW] = { 13.5, 0.025 },
};
static const double widest = 0.04;
/* Weights below this share of the middle one are nothing to a float. */
static const double least_weight = 1e-10;
/* The width of a feature in degrees. */
static const double feature_width = 0.082;

static const double pi = 3.14159265358979323846;

static int filter_radius(double pixels_per_degree)
{
    return (int)ceil(3 * sqrt(widest / (2 * pi * pi)) * pixels_per_degree);
}

/* Returns the sum of the weights before they were brought to 1. */
static double make_gaussian(filter_kernel *kernel, const contrast *channel,
                            double pixels_per_degree)
{
    double weights[FILTER_RADIUS_MOST + 1], sum = 0;
    const int most = filter_radius(pixels_per_degree);
    *kernel = (filter_kernel){ .kind = FILTER_SMOOTH };
    for (int i = 0; i <= most; i++) {
        const double degrees = i / pixels_per_degree;
        weights[i] = exp(-pi * pi * degrees * degrees / channel->width);
        sum += i == 0 ? weights[i] : 2 * weights[i];
        if (weights[i] > least_weight)
            kernel->radius = i;
    }
    for (int i = 0; i <= kernel->radius; i++)
        kernel->weights[i] = (float)(weights[i] / sum);
    return sum;
}

static double feature_weight(flip_feature feature, int i, double deviation)
{
    const double gaussian = exp(-i * i / (2 * deviation * deviation));
    switch (feature) {
    case FLIP_EDGE:
        return i * gaussian;
    case FLIP_POINT:
        return (i * i / (deviation * deviation) - 1) * gaussian;
    case FLIP_SMOOTH:
    case FLIP_FEATURES:
        break;
    }
    return gaussian;
}

/* Above 0 the weights of both sides are brought to a sum of 1, below to -1. */
static void make_feature(filter_kernel *kernel, flip_feature feature, double pixels_per_degree)
{
    static const filter_kind kinds[FLIP_FEATURES] = {
        [FLIP_SMOOTH] = FILTER_SMOOTH, [FLIP_EDGE] = FILTER_FIRST, [FLIP_POINT] = FILTER_SECOND
    };
    const double deviation = 0.5 * feature_width * pixels_per_degree;
    double above = 0, below = 0;
    kernel->kind = kinds[feature];
    kernel->radius = (int)ceil(3 * deviation);
    for (int i = -kernel->radius; i <= kernel->radius; i++) {
        const double weight = feature_weight(feature, i, deviation);
        above += fmax(weight, 0);
        below += fmax(-weight, 0);
    }
    for (int i = 0; i <= kernel->radius; i++) {
        const double weight = feature_weight(feature, i, deviation);
        kernel->weights[i] = (float)(weight / (weight < 0 ? below : above));
    }
}

/* The share that a Gaussian would have: its volume. */
static double volume(flip_gaussian which, double sum)
{
    return sensitivity[which].height * sqrt(pi / sensitivity[which].width) * sum * sum;
}

void flip_kernels_make(flip_kernels *kernels, double pixels_per_degree)
{
    double sums[FLIP_GAUSSIANS];
    *kernels = (flip_kernels){ .radius = filter_radius(pixels_per_degree) };
    for (int i = 0; i < FLIP_GAUSSIANS; i++)
        sums[i] = make_gaussian(&kernels->gaussian[i], &sensitivity[i], pixels_per_degree);
    const double narrow = volume(FLIP_BLUE_YELLOW_NARROW, sums[FLIP_BLUE_YELLOW_NARROW]);
    const double wide = volume(FLIP_BLUE_YELLOW, sums[FLIP_BLUE_YELLOW]);
    kernels->narrow_share = (float)(narrow / (wide + narrow));
    for (int i = 0; i < FLIP_FEATURES; i++) {
        make_feature(&kernels->feature[i], (flip_feature)i, pixels_per_degree);
        if (kernels->feature[i].radius > kernels->radius)
            kernels->radius = kernels->feature[i].radius;
    }
}
