// The rasteriser of the feed triangles, for methods to include: runner/scene/rasterise.h states its rules,
// runner/scene/rasterise.c is its twin, bit for bit.
//   uint parts = fm_parts(triangle)      0: dropped; more than 1 only after clipping
//   fm_set_up(t, part)                   false: covers no pixel
//   fm_edges_at(t, corner)               of a block: inside is all three >= 0, + a x + b y from there
//   fm_depth_bits(pixel, ...)            of a plane
//   fm_nearest(least, most), fm_farthest(least, most)   of a part's z_least, z_most
// FM_NEAR_WAYS true, defined before: near triangles have shorter ways to the same numbers. That pays where lanes
// branch and the rest of a shader is long (measured: tile-k/README.md).
#ifndef FM_NEAR_WAYS
#define FM_NEAR_WAYS false
#endif

// A part that is ready; 1/256 px.
struct fm_setup {
    ivec3 x, y;    // corners, positive area
    ivec3 a, b;    // edges, by pixel
    float z, dz_dx, dz_dy; // at corner 0; by 1/256 px
    float z_least, z_most;
    ivec4 box; // pixels x0 y0 x1 y1, the last ones included; within the viewport
    bool is_near; // corners within 64 px of each other: 32 bits hold products of their differences
};

float fm_reciprocal(float v)
{
    precise float r = uintBitsToFloat(0x7EF311C7u - floatBitsToUint(v));
    for (int i = 0; i < 4; ++i) {
        precise float rest = 2.0 - v * r;
        r = r * rest;
    }
    return v == 1.0 ? 1.0 : r;
}

// ---- 64-bit integers as (low, high): every device has these ----

uvec2 fm_wide_product(int a, int b)
{
    int high, low;
    imulExtended(a, b, high, low);
    return uvec2(uint(low), uint(high));
}

uvec2 fm_wide_sum(uvec2 a, uvec2 b)
{
    uint carry;
    uint low = uaddCarry(a.x, b.x, carry);
    return uvec2(low, a.y + b.y + carry);
}

uvec2 fm_wide_negative(uvec2 a)
{
    return fm_wide_sum(~a, uvec2(1u, 0u));
}

// ---- clip ----

#if FM_CLIPS

const uint FM_PLANES = 7u;
const uint FM_CORNERS_MAX = 3u + FM_PLANES;
vec4 fm_fan[FM_CORNERS_MAX];

float fm_plane_distance(vec4 c, uint plane)
{
    precise float bx = FM_GUARD_X * c.w;
    precise float by = FM_GUARD_Y * c.w;
    precise float d = plane == 0u ? c.w - 9.094947017729282e-13 // 2^-40
        : plane == 1u             ? c.z
        : plane == 2u             ? c.w - c.z
        : plane == 3u             ? bx + c.x
        : plane == 4u             ? bx - c.x
        : plane == 5u             ? by + c.y
                                  : by - c.y;
    return d;
}

bool fm_is_finite(vec4 c)
{
    return all(lessThan(floatBitsToUint(c) & 0x7FFFFFFFu, uvec4(0x5F800000u)));
}

vec4 fm_between(vec4 inside, vec4 outside, float d_in, float d_out)
{
    precise float span = d_in - d_out;
    precise float share = d_in * fm_reciprocal(span);
    precise float t = min(share, 1.0);
    precise vec4 cut = inside + (outside - inside) * t;
    return cut;
}

uint fm_clip_by(uint plane, uint count)
{
    vec4 kept[FM_CORNERS_MAX];
    uint n = 0u;
    FM_LOOP for (uint i = 0u; i < count; ++i) {
        vec4 a = fm_fan[i], b = fm_fan[i + 1u < count ? i + 1u : 0u];
        float da = fm_plane_distance(a, plane), db = fm_plane_distance(b, plane);
        if (da >= 0.0 && n < FM_CORNERS_MAX)
            kept[n++] = a;
        // Always from the inside: both triangles at an edge cut it at the same point.
        if ((da >= 0.0) != (db >= 0.0) && n < FM_CORNERS_MAX)
            kept[n++] = da >= 0.0 ? fm_between(a, b, da, db) : fm_between(b, a, db, da);
    }
    FM_LOOP for (uint i = 0u; i < n; ++i)
        fm_fan[i] = kept[i];
    return n;
}

uint fm_outcode(vec4 c)
{
    uint code = 0u;
    for (uint plane = 0u; plane < FM_PLANES; ++plane)
        code |= fm_plane_distance(c, plane) >= 0.0 ? 0u : 1u << plane;
    return code;
}

uint fm_parts(uint number)
{
    vec4 corners[3];
    fm_triangle(number, corners);
    uvec3 codes = uvec3(fm_outcode(corners[0]), fm_outcode(corners[1]), fm_outcode(corners[2]));
    bool is_gone = (codes.x & codes.y & codes.z) != 0u || !fm_is_finite(corners[0])
        || !fm_is_finite(corners[1]) || !fm_is_finite(corners[2]);
    uint any = is_gone ? 0u : codes.x | codes.y | codes.z;
    uint count = is_gone ? 0u : 3u;
    for (int i = 0; i < 3; ++i)
        fm_fan[i] = corners[i];
    FM_LOOP while (any != 0u) {
        uint plane = uint(findLSB(any));
        count = fm_clip_by(plane, count);
        any &= any - 1u;
    }
    return count < 3u ? 0u : count - 2u;
}

#else

vec4 fm_fan[3];

uint fm_parts(uint number)
{
    fm_triangle(number, fm_fan);
    return 1u;
}

#endif

// ---- set up ----

ivec2 fm_snap(vec4 c, float r)
{
    precise float x = c.x * r * (float(FM_WIDTH) * 128.0) + float(FM_WIDTH) * 128.0;
    precise float y = c.y * r * (float(FM_HEIGHT) * 128.0) + float(FM_HEIGHT) * 128.0;
    return ivec2(floor(vec2(x, y) + 0.5));
}

// Snaps the corners: t.x, t.y, t.box, and z / w of each, clamped. False: the box has no pixel.
bool fm_snap_part(out fm_setup t, out vec3 z, uint part)
{
    vec4 c[3];
    c[0] = fm_fan[0];
#if FM_CLIPS
    c[1] = fm_fan[part + 1u];
    c[2] = fm_fan[part + 2u];
#else
    c[1] = fm_fan[1];
    c[2] = fm_fan[2];
#endif
    for (int i = 0; i < 3; ++i) {
        float r = fm_reciprocal(c[i].w);
        ivec2 p = fm_snap(c[i], r);
        precise float depth = c[i].z * r;
        t.x[i] = p.x;
        t.y[i] = p.y;
        z[i] = clamp(depth, 0.0, 1.0);
    }
    ivec2 low = ivec2(min(min(t.x[0], t.x[1]), t.x[2]), min(min(t.y[0], t.y[1]), t.y[2]));
    ivec2 high = ivec2(max(max(t.x[0], t.x[1]), t.x[2]), max(max(t.y[0], t.y[1]), t.y[2]));
    t.box.xy = max((low + 127) >> 8, ivec2(0)); // the first centre at or right of the corner
    t.box.zw = min((high - 128) >> 8, ivec2(FM_WIDTH, FM_HEIGHT) - 1);
    t.is_near = FM_NEAR_WAYS && all(lessThan(high - low, ivec2(64 * 256)));
    return all(lessThanEqual(t.box.xy, t.box.zw));
}

// Twice the area, as 64 bits.
uvec2 fm_area(fm_setup t)
{
    if (t.is_near) {
        int near = (t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) - (t.x[2] - t.x[0]) * (t.y[1] - t.y[0]);
        return uvec2(uint(near), uint(near >> 31));
    }
    return fm_wide_sum(fm_wide_product(t.x[1] - t.x[0], t.y[2] - t.y[0]),
                       fm_wide_negative(fm_wide_product(t.x[2] - t.x[0], t.y[1] - t.y[0])));
}

// The rest, after fm_snap_part. False: no area.
bool fm_set_up_snapped(inout fm_setup t, vec3 z)
{
    uvec2 area = fm_area(t);
    bool is_turned = int(area.y) < 0;
    area = is_turned ? fm_wide_negative(area) : area;
    t.x = is_turned ? t.x.xzy : t.x;
    t.y = is_turned ? t.y.xzy : t.y;
    z = is_turned ? z.xzy : z;
    t.a = t.y - t.y.yzx;
    t.b = t.x.yzx - t.x;
    precise float area_float = float(int(area.y)) * 4294967296.0 + float(area.x);
    float r = fm_reciprocal(area_float);
    precise float d1 = z[1] - z[0];
    precise float d2 = z[2] - z[0];
    precise float dx = (d1 * float(t.y[2] - t.y[0]) - d2 * float(t.y[1] - t.y[0])) * r;
    precise float dy = (d2 * float(t.x[1] - t.x[0]) - d1 * float(t.x[2] - t.x[0])) * r;
    t.z = z[0];
    t.dz_dx = dx;
    t.dz_dy = dy;
    t.z_least = min(min(z[0], z[1]), z[2]);
    t.z_most = max(max(z[0], z[1]), z[2]);
    return area != uvec2(0u);
}

bool fm_set_up(out fm_setup t, uint part)
{
    vec3 z;
    bool has_pixels = fm_snap_part(t, z, part);
    return fm_set_up_snapped(t, z) && has_pixels;
}

// ---- pixels ----

// floor(-(a x + b y) / 256) by the top-left rule, held within 2^30. a and b are below 2^24 (the guard band is
// 65 536 px wide), so for x and y of together 64 px an edge moves by less than 2^30: the sign is right.
int fm_edge_at(int a, int b, int x, int y)
{
    uvec2 s = fm_wide_sum(fm_wide_product(a, x), fm_wide_product(b, y));
    bool is_top_left = a > 0 || (a == 0 && b > 0);
    s = fm_wide_sum(~s, uvec2(is_top_left ? 1u : 0u, 0u));
    int low = int(s.x >> 8 | s.y << 24), high = int(s.y) >> 8;
    int clamped = clamp(low, -0x40000000, 0x40000000);
    return high == low >> 31 ? clamped : (high < 0 ? -0x40000000 : 0x40000000);
}

// The three edges at the centre of the pixel `corner`, which lies within 64 px of the box.
ivec3 fm_edges_at(fm_setup t, ivec2 corner)
{
    ivec3 x = t.x - (corner.x * 256 + 128), y = t.y - (corner.y * 256 + 128);
    if (t.is_near) {
        ivec3 is_top_left = ivec3(greaterThan(t.a, ivec3(0)))
            | ivec3(equal(t.a, ivec3(0))) & ivec3(greaterThan(t.b, ivec3(0)));
        return (~(t.a * x + t.b * y) + is_top_left) >> 8;
    }
    return ivec3(fm_edge_at(t.a[0], t.b[0], x[0], y[0]), fm_edge_at(t.a[1], t.b[1], x[1], y[1]),
                 fm_edge_at(t.a[2], t.b[2], x[2], y[2]));
}

// Whether no edge has all of a block of size px, from where `edges` holds, outside.
bool fm_may_cover(fm_setup t, ivec3 edges, ivec2 size)
{
    ivec3 most = edges + max(t.a, ivec3(0)) * (size.x - 1) + max(t.b, ivec3(0)) * (size.y - 1);
    return (most.x | most.y | most.z) >= 0;
}

// Bits of the depth at a pixel's centre, as methods see it; rasterised below 2^-126: 0. xy: corner 0.
uint fm_depth_bits(ivec2 pixel, vec2 xy, float z, float dz_dx, float dz_dy, float least, float most)
{
    vec2 d = vec2(pixel * 256 + 128) - xy;
    precise float plane = z + (dz_dx * d.x + dz_dy * d.y);
    uint bits = floatBitsToUint(min(max(plane, least), most)) & 0x7FFFFFFFu;
    return fm_hand_on_bits(bits < 0x00800000u ? 0u : bits);
}

// Between which depths, as methods see them, a part's fragments lie: of its z_least and z_most.
float fm_nearest(float least, float most)
{
    return FM_DEPTH_REVERSED != 0 ? fm_hand_on(most) : least;
}
float fm_farthest(float least, float most)
{
    return FM_DEPTH_REVERSED != 0 ? fm_hand_on(least) : most;
}
