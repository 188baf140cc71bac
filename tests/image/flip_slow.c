#include "flip_slow.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

typedef struct triple {
    double v[3];
} triple;

typedef struct plane {
    int width, height;
    triple *pixels;
} plane;

static const double xyz_of_rgb[3][3] = {
    { 10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794 },
    { 2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897 },
    { 1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382 },
};

static triple times(const double m[3][3], triple a)
{
    triple product = { { 0 } };
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            product.v[i] += m[i][j] * a.v[j];
    return product;
}

/* By Cramer's rule: the RGB whose XYZ this is. */
static triple rgb_of_xyz(triple xyz)
{
    const double(*m)[3] = xyz_of_rgb;
    triple rgb;
    const double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                       m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    for (int c = 0; c < 3; c++) {
        double n[3][3];
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                n[i][j] = j == c ? xyz.v[i] : m[i][j];
        rgb.v[c] = (n[0][0] * (n[1][1] * n[2][2] - n[1][2] * n[2][1]) -
                    n[0][1] * (n[1][0] * n[2][2] - n[1][2] * n[2][0]) +
                    n[0][2] * (n[1][0] * n[2][1] - n[1][1] * n[2][0])) /
                   det;
    }
    return rgb;
}

static triple white(void)
{
    return times(xyz_of_rgb, (triple){ { 1, 1, 1 } });
}

static triple ycxcz_of_rgb(triple rgb)
{
    const triple xyz = times(xyz_of_rgb, rgb), n = white();
    const double x = xyz.v[0] / n.v[0], y = xyz.v[1] / n.v[1], z = xyz.v[2] / n.v[2];
    return (triple){ { 116 * y - 16, 500 * (x - y), 200 * (y - z) } };
}

static triple rgb_of_ycxcz(triple a)
{
    const triple n = white();
    const double y = (a.v[0] + 16) / 116, x = a.v[1] / 500 + y, z = y - a.v[2] / 200;
    return rgb_of_xyz((triple){ { x * n.v[0], y * n.v[1], z * n.v[2] } });
}

static double lab_curve(double t)
{
    const double delta = 6.0 / 29;
    return t > delta * delta * delta ? cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

static triple hunt_lab_of_rgb(triple rgb)
{
    const triple xyz = times(xyz_of_rgb, rgb), n = white();
    double f[3];
    for (int c = 0; c < 3; c++)
        f[c] = lab_curve(xyz.v[c] / n.v[c]);
    const double l = 116 * f[1] - 16;
    return (triple){ { l, 0.01 * l * 500 * (f[0] - f[1]), 0.01 * l * 200 * (f[1] - f[2]) } };
}

static double hyab(triple a, triple b)
{
    return fabs(a.v[0] - b.v[0]) + hypot(a.v[1] - b.v[1], a.v[2] - b.v[2]);
}

static double clamp(double a)
{
    return fmin(fmax(a, 0), 1);
}

/* A square filter of one channel; channels of a pixel have a filter each. */
typedef struct filter {
    int radius;
    double *weights; /* [2 radius + 1][2 radius + 1] */
} filter;

static filter filter_new(int radius)
{
    const size_t side = (size_t)(2 * radius + 1);
    return (filter){ radius, calloc(side * side, sizeof(double)) };
}

static double *weight_at(const filter *f, int x, int y)
{
    return &f->weights[(y + f->radius) * (2 * f->radius + 1) + x + f->radius];
}

static filter contrast_filter(int channel, double ppd)
{
    static const double a1[] = { 1, 1, 34.1 }, b1[] = { 0.0047, 0.0053, 0.04 };
    static const double a2[] = { 0, 0, 13.5 }, b2[] = { 1e-5, 1e-5, 0.025 };
    filter f = filter_new((int)ceil(3 * sqrt(0.04 / (2 * pi * pi)) * ppd));
    double sum = 0;
    for (int y = -f.radius; y <= f.radius; y++)
        for (int x = -f.radius; x <= f.radius; x++) {
            const double z = (x * x + y * y) / (ppd * ppd);
            const double w =
                a1[channel] * sqrt(pi / b1[channel]) * exp(-pi * pi * z / b1[channel]) +
                a2[channel] * sqrt(pi / b2[channel]) * exp(-pi * pi * z / b2[channel]);
            *weight_at(&f, x, y) = w;
            sum += w;
        }
    for (int y = -f.radius; y <= f.radius; y++)
        for (int x = -f.radius; x <= f.radius; x++)
            *weight_at(&f, x, y) /= sum;
    return f;
}

static filter feature_filter(int is_point, int is_vertical, double ppd)
{
    const double sd = 0.5 * 0.082 * ppd;
    filter f = filter_new((int)ceil(3 * sd));
    double above = 0, below = 0;
    for (int y = -f.radius; y <= f.radius; y++)
        for (int x = -f.radius; x <= f.radius; x++) {
            const double along = is_vertical ? y : x;
            const double g = exp(-(x * x + y * y) / (2 * sd * sd));
            const double w = is_point ? (along * along / (sd * sd) - 1) * g : -along * g;
            *weight_at(&f, x, y) = w;
            above += fmax(w, 0);
            below += fmax(-w, 0);
        }
    for (int y = -f.radius; y <= f.radius; y++)
        for (int x = -f.radius; x <= f.radius; x++) {
            double *w = weight_at(&f, x, y);
            *w /= *w < 0 ? below : above;
        }
    return f;
}

static int clamped_index(int i, int count)
{
    return i < 0 ? 0 : i < count ? i : count - 1;
}

static double filtered(const plane *p, const filter *f, int channel, int x, int y)
{
    double sum = 0;
    for (int j = -f->radius; j <= f->radius; j++)
        for (int i = -f->radius; i <= f->radius; i++) {
            const int column = clamped_index(x + i, p->width),
                      row = clamped_index(y + j, p->height);
            sum += *weight_at(f, i, j) * p->pixels[row * p->width + column].v[channel];
        }
    return sum;
}

static double aces(double x)
{
    x = fmax(0.6 * x, 0);
    return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14));
}

/* In front of white, in YCxCz. gain 0: not tone mapped. */
static plane plane_of(const fm_image *image, double gain)
{
    plane p = { (int)image->width_px, (int)image->height_px, NULL };
    p.pixels = calloc((size_t)p.width * (size_t)p.height, sizeof *p.pixels);
    for (int i = 0; i < p.width * p.height; i++) {
        triple rgb;
        for (int c = 0; c < 3; c++) {
            const double shown =
                (double)image->rgba[4 * i + c] + 1 - (double)image->rgba[4 * i + 3];
            rgb.v[c] = gain > 0 ? aces(gain * shown) : clamp(shown);
        }
        p.pixels[i] = ycxcz_of_rgb(rgb);
    }
    return p;
}

static double color_difference(const plane p[2], const filter eye[3], int x, int y)
{
    const triple green = { { 0, 1, 0 } }, blue = { { 0, 0, 1 } };
    const double most = pow(hyab(hunt_lab_of_rgb(green), hunt_lab_of_rgb(blue)), 0.7);
    triple lab[2];
    for (int s = 0; s < 2; s++) {
        triple seen;
        for (int c = 0; c < 3; c++)
            seen.v[c] = filtered(&p[s], &eye[c], c, x, y);
        triple rgb = rgb_of_ycxcz(seen);
        for (int c = 0; c < 3; c++)
            rgb.v[c] = clamp(rgb.v[c]);
        lab[s] = hunt_lab_of_rgb(rgb);
    }
    const double apart = pow(hyab(lab[0], lab[1]), 0.7);
    return apart < 0.4 * most ? 0.95 / (0.4 * most) * apart
                              : 0.95 + (apart - 0.4 * most) / (most - 0.4 * most) * 0.05;
}

/* features: edge across, edge down, point across, point down. */
static double feature_difference(const plane p[2], const filter features[4], int x, int y)
{
    double length[2][2];
    for (int s = 0; s < 2; s++)
        for (int kind = 0; kind < 2; kind++)
            length[s][kind] = hypot(filtered(&p[s], &features[2 * kind], 0, x, y) / 116,
                                    filtered(&p[s], &features[2 * kind + 1], 0, x, y) / 116);
    return sqrt(fmax(fabs(length[0][0] - length[1][0]), fabs(length[0][1] - length[1][1])) /
                sqrt(2.0));
}

static void compare(double *map, const fm_image *image, const fm_image *reference, double ppd,
                    double gain)
{
    plane p[2] = { plane_of(image, gain), plane_of(reference, gain) };
    filter eye[3], features[4];
    for (int c = 0; c < 3; c++)
        eye[c] = contrast_filter(c, ppd);
    for (int i = 0; i < 4; i++)
        features[i] = feature_filter(i / 2, i % 2, ppd);
    for (int y = 0; y < p[0].height; y++)
        for (int x = 0; x < p[0].width; x++)
            map[y * p[0].width + x] = pow(color_difference(p, eye, x, y),
                                          1 - clamp(feature_difference(p, features, x, y)));
    for (int i = 0; i < 4; i++)
        free(features[i].weights);
    for (int c = 0; c < 3; c++)
        free(eye[c].weights);
    free(p[0].pixels);
    free(p[1].pixels);
}

void flip_slow(double *map, const fm_image *image, const fm_image *reference, double ppd)
{
    compare(map, image, reference, ppd, 0);
}

void flip_slow_hdr(double *map, const fm_image *image, const fm_image *reference, double ppd,
                   const double *stops, int count)
{
    const size_t pixels = (size_t)image->width_px * image->height_px;
    double *one = calloc(pixels, sizeof *one);
    for (size_t p = 0; p < pixels; p++)
        map[p] = 0;
    for (int i = 0; i < count; i++) {
        compare(one, image, reference, ppd, exp2(stops[i]));
        for (size_t p = 0; p < pixels; p++)
            map[p] = fmax(map[p], one[p]);
    }
    free(one);
}
