/* SPDX-License-Identifier: MIT
 *
 * shapes_operators.h as GLSL. Left out: nothing. What C takes a pointer to, here is passed by
 * value: spt_rotate(p, rotation). */
#ifndef SPTI_SHAPES_OPERATORS_GLSL_H
#define SPTI_SHAPES_OPERATORS_GLSL_H

#include "../base/glsl_piece.h"

/* All functions of shapes_operators.h by their names. spt_rotation_of() takes about 3000
 * flop, which compilers spare where its arguments are constants; else build the rotation in C and
 * pass its numbers, SptRotation(vec3(...), ...). They are those of C but for one in some 500 000,
 * which is off in the last bit, and those below 1e-6, where both have an error of 1e-16. */
static const spti_glsl_piece spti_glsl_shapes_operators[] = {
    {"spt_union", "// Both bodies. Exact outside if both are; inside a lower bound.\n"
                  "float spt_union(float a, float b) {\n"
                  "    $precise float both = a < b ? a : b;\n"
                  "    return both;\n"
                  "}\n"},
    {"spt_intersection", "// What the two have in common. A lower bound outside.\n"
                         "float spt_intersection(float a, float b) {\n"
                         "    $precise float shared_part = a > b ? a : b;\n"
                         "    return shared_part;\n"
                         "}\n"},
    {"spt_difference", "// a without b. A lower bound on both sides.\n"
                       "float spt_difference(float a, float b) {\n"
                       "    $precise float rest = a > -b ? a : -b;\n"
                       "    return rest;\n"
                       "}\n"},
    {"spt_smooth_union",
     "// Both bodies, blended where |a - b| < k: the quadratic polynomial minimum.\n"
     "float spt_smooth_union(float a, float b, float k) {\n"
     "    $precise float quarter = 0.25 / (k + 1.17549435e-38); // finite if k = 0\n"
     "    $precise float overlap = k - abs(a - b);\n"
     "    $precise float h = max(overlap, 0.0);\n"
     "    $precise float blended = min(a, b) - h * (h * quarter);\n"
     "    return blended;\n"
     "}\n"},
    {"spt_smooth_intersection", "// What the two have in common, its edges rounded off.\n"
                                "float spt_smooth_intersection(float a, float b, float k) {\n"
                                "    return -spt_smooth_union(-a, -b, k);\n"
                                "}\n"},
    {"spt_smooth_difference", "// a without b, the edges rounded off.\n"
                              "float spt_smooth_difference(float a, float b, float k) {\n"
                              "    return spt_smooth_intersection(a, -b, k);\n"
                              "}\n"},

    /* ---- The same with a material ------------------------------------------------------------ */

    {"SptSurface", "// A distance and the material of what decided it (Keinert et al. 2014, 4).\n"
                   "struct SptSurface {\n"
                   "    float distance;\n"
                   "    int material;\n"
                   "};\n"},
    {"spt_surface_of", "// A distance with a material.\n"
                       "SptSurface spt_surface_of(float value, int material) {\n"
                       "    return SptSurface(value, material);\n"
                       "}\n"},
    {"spt_surface_union",
     "// spt_union() with the material of the smaller distance, b's where they are equal.\n"
     "SptSurface spt_surface_union(SptSurface a, SptSurface b) {\n"
     "    return SptSurface(spt_union(a.distance, b.distance),\n"
     "                      a.distance < b.distance ? a.material : b.material);\n"
     "}\n"},
    {"spt_surface_intersection",
     "// spt_intersection() with the material of the larger distance, b's where they are equal.\n"
     "SptSurface spt_surface_intersection(SptSurface a, SptSurface b) {\n"
     "    return SptSurface(spt_intersection(a.distance, b.distance),\n"
     "                      a.distance > b.distance ? a.material : b.material);\n"
     "}\n"},
    {"spt_surface_difference",
     "// spt_difference(): the walls of the cut have b's material.\n"
     "SptSurface spt_surface_difference(SptSurface a, SptSurface b) {\n"
     "    return SptSurface(spt_difference(a.distance, b.distance),\n"
     "                      a.distance > -b.distance ? a.material : b.material);\n"
     "}\n"},
    {"spt_surface_smooth_union",
     "// spt_smooth_union(); the border of the materials runs through the middle of the blend.\n"
     "SptSurface spt_surface_smooth_union(SptSurface a, SptSurface b, float k) {\n"
     "    return SptSurface(spt_smooth_union(a.distance, b.distance, k),\n"
     "                      a.distance < b.distance ? a.material : b.material);\n"
     "}\n"},
    {"spt_surface_smooth_intersection",
     "// spt_smooth_intersection() likewise.\n"
     "SptSurface spt_surface_smooth_intersection(SptSurface a, SptSurface b, float k) {\n"
     "    return SptSurface(spt_smooth_intersection(a.distance, b.distance, k),\n"
     "                      a.distance > b.distance ? a.material : b.material);\n"
     "}\n"},
    {"spt_surface_smooth_difference",
     "// spt_smooth_difference() likewise.\n"
     "SptSurface spt_surface_smooth_difference(SptSurface a, SptSurface b, float k) {\n"
     "    return SptSurface(spt_smooth_difference(a.distance, b.distance, k),\n"
     "                      a.distance > -b.distance ? a.material : b.material);\n"
     "}\n"},

    /* ---- Operators on points ----------------------------------------------------------------- */

    {"spt_translate", "// Moves the shape by offset.\n"
                      "vec3 spt_translate(vec3 p, vec3 offset) {\n"
                      "    $precise vec3 moved = p - offset;\n"
                      "    return moved;\n"
                      "}\n"},
    {"SptRotation", "// A rotation, made by spt_rotation_of(): the images of the three axes.\n"
                    "struct SptRotation {\n"
                    "    vec3 x;\n"
                    "    vec3 y;\n"
                    "    vec3 z;\n"
                    "};\n"},
    {"spt_rotation_of",
     "// Rotation about an axis of any length, right-handed, by an angle in radians (Rodrigues).\n"
     "// About 3000 flop where the arguments are no constants.\n"
     "SptRotation spt_rotation_of(vec3 axis, float angle) {\n"
     "    // counted in a power of two near the largest coordinate, so that no square overflows\n"
     "    float largest = max(abs(axis.x), max(abs(axis.y), abs(axis.z)));\n"
     "    uint unit = floatBitsToUint(largest) & 0x7f800000u;\n"
     "    vec3 scaled = axis * uintBitsToFloat(0x7f000000u - unit);\n"
     "    const vec3 zero = vec3(0.0);\n"
     "    if (!(spt_dot(axis, axis) > 1e-36)) {\n"
     "        return SptRotation(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));\n"
     "    }\n"
     "    SptPair u = SptPair(scaled, zero);\n"
     "    u = spt_pair_divide(u, spt_pair_root(spt_pair_dot(u, u)));\n"
     "    // sin(angle) and cos(angle) = -sin(angle - pi/2) in the first two components\n"
     "    $precise float turns = angle * 0.318309873;\n"
     "    $precise float quarter_less = turns - 0.5;\n"
     "    int n = spt_nearest(turns);\n"
     "    int m = spt_nearest(quarter_less);\n"
     "    SptPair w = spt_pair_sine(angle, vec3(float(n), float(m) + 0.5, 0.0));\n"
     "    float turned_s = (n & 1) != 0 ? -1.0 : 1.0;\n"
     "    float turned_c = (m & 1) != 0 ? 1.0 : -1.0;\n"
     "    SptPair s = SptPair(w.high.xxx * turned_s, w.low.xxx * turned_s);\n"
     "    SptPair c = SptPair(w.high.yyy * turned_c, w.low.yyy * turned_c);\n"
     "    // (1 - c) u_i u + s (e_i x u) + c e_i with the sign that turns e_i forwards\n"
     "    SptPair t = spt_pair_subtract(SptPair(vec3(1.0), zero), c);\n"
     "    SptPair tu = spt_pair_multiply(t, u);\n"
     "    SptPair su = spt_pair_multiply(s, u);\n"
     "    SptPair x = spt_pair_add(\n"
     "        spt_pair_multiply(SptPair(tu.high.xxx, tu.low.xxx), u),\n"
     "        SptPair(vec3(c.high.x, su.high.z, -su.high.y),\n"
     "                vec3(c.low.x, su.low.z, -su.low.y)));\n"
     "    SptPair y = spt_pair_add(\n"
     "        spt_pair_multiply(SptPair(tu.high.yyy, tu.low.yyy), u),\n"
     "        SptPair(vec3(-su.high.z, c.high.x, su.high.x),\n"
     "                vec3(-su.low.z, c.low.x, su.low.x)));\n"
     "    SptPair z = spt_pair_add(\n"
     "        spt_pair_multiply(SptPair(tu.high.zzz, tu.low.zzz), u),\n"
     "        SptPair(vec3(su.high.y, -su.high.x, c.high.x),\n"
     "                vec3(su.low.y, -su.low.x, c.low.x)));\n"
     "    return SptRotation(x.high, y.high, z.high);\n"
     "}\n"},
    {"spt_rotate", "// Rotates the shape: the point is turned back.\n"
                   "vec3 spt_rotate(vec3 p, SptRotation rotation) {\n"
                   "    return vec3(spt_dot(rotation.x, p), spt_dot(rotation.y, p),\n"
                   "                spt_dot(rotation.z, p));\n"
                   "}\n"},
    {"spt_scale", "// Scales the shape by factor > 0; multiply the distance by factor afterwards.\n"
                  "vec3 spt_scale(vec3 p, float factor) {\n"
                  "    return p / factor;\n"
                  "}\n"},
    {"spt_repeat",
     "// Repeats the shape, which must be its own mirror image within the cell, with the period\n"
     "// along each axis; 0 leaves that axis alone.\n"
     "vec3 spt_repeat(vec3 p, vec3 period) {\n"
     "    // finite if the period is 0, by which the number of the cell is then multiplied\n"
     "    $precise vec3 cells = p * (1.0 / (period + 1.17549435e-38));\n"
     "    vec3 cell = vec3(float(spt_nearest(spt_limit(cells.x, 4194304.0))),\n"
     "                     float(spt_nearest(spt_limit(cells.y, 4194304.0))),\n"
     "                     float(spt_nearest(spt_limit(cells.z, 4194304.0))));\n"
     "    $precise vec3 within = p - period * cell;\n"
     "    return within;\n"
     "}\n"},
    {"spt_twist", "// Twists the shape about the y axis by the angle rate * y.\n"
                  "vec3 spt_twist(vec3 p, float rate) {\n"
                  "    float s = spt_sin(rate * p.y);\n"
                  "    float c = spt_cos(rate * p.y);\n"
                  "    $precise float x = c * p.x - s * p.z;\n"
                  "    $precise float z = s * p.x + c * p.z;\n"
                  "    return vec3(x, p.y, z);\n"
                  "}\n"},
    {"spt_twist_lipschitz",
     "// L of a twisted field over L of the field, within radius of the y axis.\n"
     "float spt_twist_lipschitz(float rate, float radius) {\n"
     "    $precise float a = abs(rate) * radius;\n"
     "    $precise float stretched = (a + sqrt(a * a + 4.0)) * 0.5;\n"
     "    return stretched;\n"
     "}\n"},
    {"spt_bend", "// Bends the shape about the z axis by the angle rate * x.\n"
                 "vec3 spt_bend(vec3 p, float rate) {\n"
                 "    float s = spt_sin(rate * p.x);\n"
                 "    float c = spt_cos(rate * p.x);\n"
                 "    $precise float x = c * p.x + s * p.y;\n"
                 "    $precise float y = c * p.y - s * p.x;\n"
                 "    return vec3(x, y, p.z);\n"
                 "}\n"},
    {"spt_bend_lipschitz",
     "// L of a bent field over L of the field, within radius of the z axis.\n"
     "float spt_bend_lipschitz(float rate, float radius) {\n"
     "    $precise float stretched = 1.0 + abs(rate) * radius;\n"
     "    return stretched;\n"
     "}\n"},
};

#endif
