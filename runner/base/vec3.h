/* Vectors of three doubles, in single operations that round the same on every machine. */
#ifndef FM_VEC3_H
#define FM_VEC3_H

#include <math.h>

typedef struct vec3 {
    double x, y, z;
} vec3;

static inline vec3 vec3_of(const double v[3])
{
    return (vec3){ v[0], v[1], v[2] };
}

static inline vec3 plus(vec3 a, vec3 b)
{
    return (vec3){ a.x + b.x, a.y + b.y, a.z + b.z };
}

static inline vec3 minus(vec3 a, vec3 b)
{
    return (vec3){ a.x - b.x, a.y - b.y, a.z - b.z };
}

static inline vec3 plus_scaled(vec3 a, vec3 b, double s)
{
    return (vec3){ a.x + s * b.x, a.y + s * b.y, a.z + s * b.z };
}

static inline double dot(vec3 a, vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec3 cross(vec3 a, vec3 b)
{
    return (vec3){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/* Zero stays zero. */
static inline vec3 normalized(vec3 a)
{
    const double length = sqrt(dot(a, a));
    return length > 0.0 ? (vec3){ a.x / length, a.y / length, a.z / length } : (vec3){ 0 };
}

#endif
