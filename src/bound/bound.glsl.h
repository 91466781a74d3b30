/* SPDX-License-Identifier: MIT
 *
 * Bounding volumes as GLSL: interval_kernel.h and volume_kernel.h for one ray. Left out: the
 * callers' own volumes. */
#ifndef SPTI_BOUND_GLSL_H
#define SPTI_BOUND_GLSL_H

#include "../base/glsl_piece.h"

/* An interval is vec2(t_in, t_out), empty where t_in > t_out. Those that take a `range` cut it.
 * The C code works in a unit of the ray's own, a power of two: that changes no bits while nothing
 * under- or overflows, but for components of a direction below FLT_MIN, which are 0 on many GPUs in
 * any case. Kernels begin with all t and cut with [t_min, t_max] at last, what is written here the
 * other way round: the largest and the least of some numbers do not depend on their order. Signs of
 * zero may. */
static const spti_glsl_piece spti_glsl_bound[] = {
    {"spt_earlier", "// t moved by the part of the rounding floor that grows with it.\n"
                    "float spt_earlier(float t) {\n"
                    "    $precise float moved = t * (t < 0.0 ? 1.00000024 : 0.999999762);\n"
                    "    return moved;\n"
                    "}\n"},
    {"spt_later", "// The same for an end.\n"
                  "float spt_later(float t) {\n"
                  "    $precise float moved = t * (t < 0.0 ? 0.999999762 : 1.00000024);\n"
                  "    return moved;\n"
                  "}\n"},
    {"spt_interval_dot", "// a.b, the products added from left to right.\n"
                         "float spt_interval_dot(vec3 a, vec3 b) {\n"
                         "    $precise float sum = (a.x * b.x + a.y * b.y) + a.z * b.z;\n"
                         "    return sum;\n"
                         "}\n"},

    /* ---- Spheres and boxes -------------------------------------------------------------- */
    {"spt_interval_sphere",
     "// Where a ray is in a sphere. The discriminant from the closest approach does not cancel\n"
     "// for far or small ones (Haines et al. 2019, Ray Tracing Gems, chapter 7); the radius\n"
     "// grows by the rounding of that. `size`: the farthest coordinate.\n"
     "vec2 spt_interval_sphere(vec3 origin, vec3 direction, float span, float reach, vec2 range,\n"
     "                         vec3 center, float radius, float size) {\n"
     "    $precise vec3 offset = origin - center;\n"
     "    float a = spt_interval_dot(direction, direction);\n"
     "    float b = spt_interval_dot(direction, offset);\n"
     "    float c = spt_interval_dot(offset, offset);\n"
     "    $precise float closest = b / a;\n"
     "    $precise vec3 side = offset - closest * direction;\n"
     "    $precise float grown = radius + 2.38418579e-7 * (reach + sqrt(c));\n"
     "    $precise float square = grown * grown;\n"
     "    $precise float room = square - spt_interval_dot(side, side);\n"
     "    if (room < 0.0) return vec2(3.0e38, -3.0e38);\n"
     "    $precise float magnitude = abs(b) + sqrt(a * room);\n"
     "    float k = max(magnitude, 1.17549435e-38);\n"
     "    if (b > 0.0) k = -k;\n"
     "    $precise float first = k / a;\n"
     "    $precise float product = (c - square) / k;\n"
     "    float second = magnitude <= 0.0 ? 0.0 : product;\n"
     "    $precise float margin = 2.38418579e-7 * (reach + size) / span;\n"
     "    $precise float enters = spt_earlier(min(first, second)) - margin;\n"
     "    $precise float leaves = spt_later(max(first, second)) + margin;\n"
     "    return vec2(max(enters, range.x), min(leaves, range.y));\n"
     "}\n"},
    {"spt_interval_axis",
     "// Between two planes at right angles to an axis. By division: multiplied by the inverse of\n"
     "// 0, a ray that lies in a plane would be lost.\n"
     "vec2 spt_interval_axis(float origin, float direction, float from, float to, vec2 range) {\n"
     "    if (abs(direction) < 1.17549435e-38) {\n"
     "        return from <= origin && origin <= to ? range : vec2(3.0e38, -3.0e38);\n"
     "    }\n"
     "    $precise float a = (from - origin) / direction;\n"
     "    $precise float b = (to - origin) / direction;\n"
     "    return vec2(max(spt_earlier(min(a, b)), range.x), min(spt_later(max(a, b)), range.y));\n"
     "}\n"},
    {"spt_interval_box",
     "// In a box, widened a face at a time, so that a ray that touches an edge is not lost.\n"
     "vec2 spt_interval_box(vec3 origin, vec3 direction, float reach, vec2 range, vec3 low,\n"
     "                      vec3 high, float size) {\n"
     "    $precise float margin = 2.38418579e-7 * (reach + size);\n"
     "    $precise vec3 from = low - margin;\n"
     "    $precise vec3 to = high + margin;\n"
     "    range = spt_interval_axis(origin.x, direction.x, from.x, to.x, range);\n"
     "    range = spt_interval_axis(origin.y, direction.y, from.y, to.y, range);\n"
     "    return spt_interval_axis(origin.z, direction.z, from.z, to.z, range);\n"
     "}\n"},

    /* ---- Planes ------------------------------------------------------------------------- */
    {"spt_interval_behind",
     "// Behind the plane normal . p = offset, which moves and turns out by the rounding of these\n"
     "// sums.\n"
     "vec2 spt_interval_behind(vec3 normal, vec3 origin, vec3 direction, float offset,\n"
     "                         vec2 range) {\n"
     "    $precise vec3 place = normal * origin;\n"
     "    $precise vec3 rate = normal * direction;\n"
     "    $precise float blur = (abs(place.x) + abs(place.y)) + abs(place.z);\n"
     "    $precise float tilt = (abs(rate.x) + abs(rate.y)) + abs(rate.z);\n"
     "    $precise float margin = 4.76837158e-7 * (blur + abs(offset));\n"
     "    $precise float room = (offset - ((place.x + place.y) + place.z)) + margin;\n"
     "    $precise float opening = ((rate.x + rate.y) + rate.z) - 4.76837158e-7 * tilt;\n"
     "    if (opening == 0.0) return room < 0.0 ? vec2(3.0e38, -3.0e38) : range;\n"
     "    $precise float t = room / opening;\n"
     "    if (opening < 0.0) return vec2(max(spt_earlier(t), range.x), range.y);\n"
     "    return vec2(range.x, min(spt_later(t), range.y));\n"
     "}\n"},
    {"spt_interval_between",
     "// Between two of them.\n"
     "vec2 spt_interval_between(vec3 normal, vec3 origin, vec3 direction, float from, float to,\n"
     "                          vec2 range) {\n"
     "    range = spt_interval_behind(normal, origin, direction, to, range);\n"
     "    return spt_interval_behind(-normal, origin, direction, -from, range);\n"
     "}\n"},
    {"spt_interval_oriented_box",
     "// In a box along three axes.\n"
     "vec2 spt_interval_oriented_box(vec3 origin, vec3 direction, vec2 range, vec3 center,\n"
     "                               vec3 axis_0, vec3 axis_1, vec3 axis_2, vec3 size) {\n"
     "    $precise vec3 offset = origin - center;\n"
     "    range = spt_interval_between(axis_0, offset, direction, -size.x, size.x, range);\n"
     "    range = spt_interval_between(axis_1, offset, direction, -size.y, size.y, range);\n"
     "    return spt_interval_between(axis_2, offset, direction, -size.z, size.z, range);\n"
     "}\n"},

    /* ---- Round volumes ------------------------------------------------------------------ */
    {"spt_interval_within", "// Where |x + t d| <= radius; all t where d is 0. The ends move by\n"
                            "// what the closest approach is off.\n"
                            "vec2 spt_interval_within(vec3 x, vec3 d, float radius) {\n"
                            "    float a = spt_interval_dot(d, d);\n"
                            "    float c = spt_interval_dot(x, x);\n"
                            "    bool parallel = a < 1.17549435e-38;\n"
                            "    float divisor = parallel ? 1.0 : a;\n"
                            "    $precise float moving = spt_interval_dot(x, d) / divisor;\n"
                            "    float closest = parallel ? 0.0 : moving;\n"
                            "    $precise vec3 side = x - closest * d;\n"
                            "    $precise float square = radius * radius + 2.27373675e-13 * c;\n"
                            "    $precise float room = square - spt_interval_dot(side, side);\n"
                            "    if (room < 0.0) return vec2(3.0e38, -3.0e38);\n"
                            "    if (parallel) return vec2(-3.0e38, 3.0e38);\n"
                            "    $precise float moved = 4.76837158e-7 * sqrt(c / divisor);\n"
                            "    $precise float reach = sqrt(max(0.0, room) / divisor) + moved;\n"
                            "    $precise float enters = -closest - reach;\n"
                            "    $precise float leaves = reach - closest;\n"
                            "    return vec2(spt_earlier(enters), spt_later(leaves));\n"
                            "}\n"},
    {"spt_interval_blur",
     "// How much the radius of a tube must grow, for what rounding does to it.\n"
     "float spt_interval_blur(vec3 offset, float size) {\n"
     "    $precise float apart = sqrt(spt_interval_dot(offset, offset));\n"
     "    $precise float blur = 4.76837158e-7 * apart + 9.53674316e-7 * size;\n"
     "    return blur;\n"
     "}\n"},
    {"spt_interval_ball",
     "// Where a ray is in a ball, all along.\n"
     "vec2 spt_interval_ball(vec3 origin, vec3 direction, vec3 center, float radius) {\n"
     "    $precise vec3 offset = origin - center;\n"
     "    $precise float grown = radius + spt_interval_blur(offset, radius);\n"
     "    return spt_interval_within(offset, direction, grown);\n"
     "}\n"},
    {"spt_interval_tube",
     "// Within a radius of a line and between the planes through the ends of `along`, its unit\n"
     "// vector, times `extent`.\n"
     "vec2 spt_interval_tube(vec3 origin, vec3 direction, vec3 from, vec3 along, float extent,\n"
     "                       float radius) {\n"
     "    $precise vec3 offset = origin - from;\n"
     "    $precise vec3 across = offset.yzx * along.zxy - offset.zxy * along.yzx;\n"
     "    $precise vec3 moving = direction.yzx * along.zxy - direction.zxy * along.yzx;\n"
     "    $precise float size = extent + radius;\n"
     "    $precise float grown = radius + spt_interval_blur(offset, size);\n"
     "    vec2 inside = spt_interval_within(across, moving, grown);\n"
     "    return spt_interval_between(along, offset, direction, 0.0, extent, inside);\n"
     "}\n"},
    {"spt_interval_cylinder",
     "// In a cylinder with flat ends.\n"
     "vec2 spt_interval_cylinder(vec3 origin, vec3 direction, vec2 range, vec3 from, vec3 along,\n"
     "                           float extent, float radius) {\n"
     "    vec2 inside = spt_interval_tube(origin, direction, from, along, extent, radius);\n"
     "    return vec2(max(inside.x, range.x), min(inside.y, range.y));\n"
     "}\n"},
    {"spt_interval_hull", "// The hull of two intervals, each of which may be empty.\n"
                          "vec2 spt_interval_hull(vec2 a, vec2 b) {\n"
                          "    return a.y < a.x ? b : vec2(min(a.x, b.x), max(a.y, b.y));\n"
                          "}\n"},
    {"spt_interval_capsule",
     "// In a capsule: the hull of where the ray is in the tube and in both balls.\n"
     "vec2 spt_interval_capsule(vec3 origin, vec3 direction, vec2 range, vec3 from, vec3 to,\n"
     "                          vec3 along, float extent, float radius) {\n"
     "    vec2 inside = spt_interval_hull(spt_interval_ball(origin, direction, from, radius),\n"
     "                                    spt_interval_ball(origin, direction, to, radius));\n"
     "    inside = spt_interval_hull(\n"
     "        spt_interval_tube(origin, direction, from, along, extent, radius), inside);\n"
     "    return vec2(max(inside.x, range.x), min(inside.y, range.y));\n"
     "}\n"},
    {"spt_interval_ellipsoid",
     "// In an ellipsoid, scaled in its axes so that it becomes a ball of its longest half axis.\n"
     "// `shares`: of the half axes in that; `stretch`: how much longer a vector can become.\n"
     "vec2 spt_interval_ellipsoid(vec3 origin, vec3 direction, vec2 range, vec3 center,\n"
     "                            vec3 axis_0, vec3 axis_1, vec3 axis_2, vec3 shares,\n"
     "                            float radius, float stretch) {\n"
     "    $precise vec3 offset = origin - center;\n"
     "    vec3 turned = vec3(spt_interval_dot(axis_0, offset), spt_interval_dot(axis_1, offset),\n"
     "                       spt_interval_dot(axis_2, offset));\n"
     "    vec3 heading = vec3(spt_interval_dot(axis_0, direction),\n"
     "                        spt_interval_dot(axis_1, direction),\n"
     "                        spt_interval_dot(axis_2, direction));\n"
     "    $precise vec3 x = turned / shares;\n"
     "    $precise vec3 d = heading / shares;\n"
     "    $precise float size = sqrt(spt_interval_dot(offset, offset)) + radius;\n"
     "    $precise float blur = (9.53674316e-7 * size) * stretch;\n"
     "    $precise float grown = radius + blur;\n"
     "    vec2 inside = spt_interval_within(x, d, grown);\n"
     "    return vec2(max(inside.x, range.x), min(inside.y, range.y));\n"
     "}\n"},

    /* ---- For cones ---------------------------------------------------------------------- */
    {"spt_hull_sphere",
     "// The point itself, or if it is outside the sphere the nearest one there.\n"
     "vec3 spt_hull_sphere(vec3 p, vec3 center, float radius) {\n"
     "    $precise vec3 arm = p - center;\n"
     "    $precise float apart = sqrt(spt_interval_dot(arm, arm));\n"
     "    $precise vec3 pulled = center + (radius / max(apart, radius)) * arm;\n"
     "    return apart > radius ? pulled : p;\n"
     "}\n"},
};

#endif
