#include "camera.h"

#include "base/vec3.h"

/* Lengths in the space, whose box is near 1 for a mesh from a file. Beyond them clip coordinates
 * near those that rasterise.h drops, and floats that hold no depth. */
static const double length_min = 0x1p-36, length_max = 0x1p60;

/* An orthonormal frame: right, up, and back (from the target towards the eye). */
typedef struct view {
    vec3 eye, right, up, back;
} view;

typedef struct lens {
    double scale_x, scale_y; /* cotangents of the half angles */
    double near, far;
} lens;

static vec3 corner(const fm_box *box, unsigned i)
{
    return (vec3){ i & 1 ? box->high[0] : box->low[0], i & 2 ? box->high[1] : box->low[1],
                   i & 4 ? box->high[2] : box->low[2] };
}

static vec3 centre(const fm_box *box)
{
    return plus_scaled((vec3){ 0 },
                       (vec3){ box->low[0] + box->high[0], box->low[1] + box->high[1],
                               box->low[2] + box->high[2] },
                       0.5);
}

static vec3 point_in(const fm_space *space, const double point[3])
{
    double moved[3];
    space_point(moved, space, point);
    return vec3_of(moved);
}

/* The vector's direction, also where its length is beyond a double. Zero stays zero. */
static vec3 direction(vec3 v)
{
    const double size = fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
    return size > 0.0 ? normalized((vec3){ v.x / size, v.y / size, v.z / size }) : v;
}

/* `up` may be zero or along the view: then the axis farthest from the view takes its place. */
static void frame_along(view *v, vec3 back, vec3 up)
{
    const double nearly_parallel = 1e-6;
    v->back = direction(back);
    vec3 right = cross(direction(up), v->back);
    if (dot(right, right) < nearly_parallel * nearly_parallel) {
        const bool is_upright = fabs(v->back.y) > 0.9;
        right = cross(is_upright ? (vec3){ 0, 0, -1 } : (vec3){ 0, 1, 0 }, v->back);
    }
    v->right = normalized(right);
    v->up = cross(v->back, v->right);
}

/* Backs off until every corner is inside the pyramid of view. */
static void fit_eye(view *v, const lens *l, const fm_box *box)
{
    const vec3 middle = centre(box);
    double distance = 0.0;
    for (unsigned i = 0; i < 8; i++) {
        const vec3 c = minus(corner(box, i), middle);
        const double aside =
            fmax(fabs(dot(c, v->right)) * l->scale_x, fabs(dot(c, v->up)) * l->scale_y);
        distance = fmax(distance, aside + dot(c, v->back));
    }
    v->eye = plus_scaled(middle, v->back, distance);
}

/* Half of it, which is within a double. */
static vec3 back_of(const fm_settings *s)
{
    return minus(plus_scaled((vec3){ 0 }, vec3_of(s->eye), 0.5),
                 plus_scaled((vec3){ 0 }, vec3_of(s->target), 0.5));
}

static void view_set(view *v, lens *l, const fm_settings *s, const fm_space *space,
                     const fm_box *box)
{
    const vec3 back = back_of(s);
    const bool is_fitted = !(fabs(back.x) > 0.0 || fabs(back.y) > 0.0 || fabs(back.z) > 0.0);
    const vec3 three_quarter = { 0.6, 0.45, 1.0 };
    const double degree = 3.14159265358979323846 / 180.0;
    l->scale_y = 1.0 / tan(0.5 * s->fov_deg * degree);
    l->scale_x = l->scale_y * s->height_px / s->width_px;
    v->eye = point_in(space, s->eye);
    frame_along(v, is_fitted ? three_quarter : back, vec3_of(s->up));
    if (!is_fitted)
        return;
    fit_eye(v, l, box);
    l->scale_x *= s->zoom;
    l->scale_y *= s->zoom;
}

static fm_status check_eye(const view *v, const fm_box *box, fm_error *err)
{
    double farthest = 0.0;
    for (unsigned i = 0; i < 8; i++) {
        const vec3 to = minus(corner(box, i), v->eye);
        farthest = fmax(farthest, fmax(fabs(to.x), fmax(fabs(to.y), fabs(to.z))));
    }
    if (farthest < length_max)
        return FM_OK;
    return fm_fail(err, FM_INVALID, "eye: %.3g times the mesh's size away; at most %.3g", farthest,
                   length_max);
}

static fm_status check_planes(const lens *l, const fm_settings *s, fm_error *err)
{
    if (!(l->far < length_max))
        return fm_fail(err, FM_INVALID, "far_plane: %.3g times the mesh's size away; at most %.3g",
                       l->far, length_max);
    if (!(l->near > length_min))
        return fm_fail(err, FM_INVALID, "near_plane: %.3g of the mesh's size; at least %.3g",
                       l->near, length_min);
    if (!((float)l->near < (float)l->far))
        return fm_fail(err, FM_INVALID,
                       "near_plane %g is not nearer than far_plane %g by what a float holds",
                       s->near_plane, s->far_plane);
    return FM_OK;
}

static fm_status planes_set(lens *l, const view *v, const fm_settings *s, const fm_space *space,
                            const fm_box *box, fm_error *err)
{
    double least = INFINITY, greatest = -INFINITY;
    const fm_status status = check_eye(v, box, err);
    if (status != FM_OK)
        return status;
    for (unsigned i = 0; i < 8; i++) {
        const double depth = dot(minus(v->eye, corner(box, i)), v->back);
        least = fmin(least, depth);
        greatest = fmax(greatest, depth);
    }
    if (!(greatest > 0.0))
        return fm_fail(err, FM_INVALID, "eye, target: the mesh lies behind the camera");
    l->near = s->near_plane > 0.0 ? space_length(space, s->near_plane)
                                  : fmax(0.4 * least, 1e-3 * greatest);
    l->far = s->far_plane > 0.0 ? space_length(space, s->far_plane) : 1.7 * greatest;
    return check_planes(l, s, err);
}

/* Row r of clip_from_space: along * scale applied to the position relative to the eye, + constant.
 */
static void set_row(double m[16], int r, vec3 along, double scale, vec3 eye, double constant)
{
    m[r] = scale * along.x;
    m[4 + r] = scale * along.y;
    m[8 + r] = scale * along.z;
    m[12 + r] = constant - scale * dot(along, eye);
}

fm_status camera_matrix(double clip_from_space[16], const fm_settings *settings,
                        const fm_space *space, const fm_box *box, fm_error *err)
{
    view v;
    lens l = { 0 };
    view_set(&v, &l, settings, space, box);
    const fm_status status = planes_set(&l, &v, settings, space, box, err);
    if (status != FM_OK)
        return status;
    /* z / w is 0 at the near plane and 1 at the far one; reversed, 1 and 0. */
    const bool is_reversed = settings->depth == FM_DEPTH_REVERSED;
    const double begin = is_reversed ? l.far : l.near, end = is_reversed ? l.near : l.far;
    const double range = end / (begin - end);
    set_row(clip_from_space, 0, v.right, l.scale_x, v.eye, 0.0);
    set_row(clip_from_space, 1, v.up, -l.scale_y, v.eye, 0.0);
    set_row(clip_from_space, 2, v.back, range, v.eye, begin * range);
    set_row(clip_from_space, 3, v.back, -1.0, v.eye, 0.0);
    return FM_OK;
}
