/* SPDX-License-Identifier: MIT
 *
 * distort_kernel.h and the field of a level set (surface/level_set.c) as GLSL, for points within
 * 1e18. Which of these a field is made of is written in glsl/write_distort.c. */
#ifndef SPTI_DISTORT_GLSL_H
#define SPTI_DISTORT_GLSL_H

#include "../base/glsl_piece.h"

static const spti_glsl_piece spti_glsl_distort_pieces[] = {
    {"spt_into_frame",
     "// Coordinates along side, axis and their cross product, from the origin.\n"
     "vec3 spt_into_frame(vec3 p, vec3 origin, vec3 side, vec3 axis, vec3 across) {\n"
     "    $precise vec3 q = p - origin;\n"
     "    return vec3(spt_dot(side, q), spt_dot(axis, q), spt_dot(across, q));\n"
     "}\n"},
    {"spt_out_of_frame",
     "// And back.\n"
     "vec3 spt_out_of_frame(vec3 q, vec3 origin, vec3 side, vec3 axis, vec3 across) {\n"
     "    $precise vec3 p = origin + ((side * q.x + axis * q.y) + across * q.z);\n"
     "    return p;\n"
     "}\n"},
    {"spt_into_cylinder",
     "// The nearest point of a cylinder. q: height and two coordinates across. apart: the\n"
     "// square of the way there.\n"
     "vec3 spt_into_cylinder(vec3 q, float low, float high, float radius, out float apart) {\n"
     "    float level = min(max(q.x, low), high);\n"
     "    float reach = max(spt_length_2(q.y, q.z), radius);\n"
     "    $precise float share = radius / reach; // 1 within\n"
     "    $precise vec2 way = vec2(q.x - level, reach - radius);\n"
     "    $precise float square = way.x * way.x + way.y * way.y;\n"
     "    $precise vec2 across = q.yz * share;\n"
     "    apart = square;\n"
     "    return vec3(level, across);\n"
     "}\n"},
    {"spt_into_cone",
     "// The nearest point of a cone between two heights, whose radii are those there: of the\n"
     "// slant side where a point is beyond it at its own height or, above and below, at that\n"
     "// of the end: every such point has its nearest one there, ends included. slope: of the\n"
     "// radius over the height; inverse: of the square of the length of that side.\n"
     "vec3 spt_into_cone(vec3 q, vec2 heights, vec2 radii, float slope, float inverse,\n"
     "                   out float apart) {\n"
     "    $precise float rise = heights.y - heights.x;\n"
     "    $precise float widening = radii.y - radii.x;\n"
     "    $precise float from_axis = spt_length_2(q.y, q.z) + 1.17549435e-38;\n"
     "    float within = min(max(q.x, heights.x), heights.y);\n"
     "    $precise float own = radii.x + (q.x - heights.x) * slope;\n"
     "    float edge = min(max(own, min(radii.x, radii.y)), max(radii.x, radii.y));\n"
     "    $precise float along = ((from_axis - radii.x) * widening + (q.x - heights.x) * rise)\n"
     "                           * inverse;\n"
     "    float part = min(max(along, 0.0), 1.0);\n"
     "    bool beyond = from_axis > edge;\n"
     "    $precise vec2 slant = vec2(radii.x + part * widening, heights.x + part * rise);\n"
     "    vec2 end = beyond ? slant : vec2(from_axis, within);\n"
     "    $precise vec2 way = vec2(q.x - end.y, from_axis - end.x);\n"
     "    $precise float square = way.x * way.x + way.y * way.y;\n"
     "    $precise vec2 across = q.yz * (end.x / from_axis);\n"
     "    apart = square;\n"
     "    return vec3(end.y, across);\n"
     "}\n"},
    {"spt_into_box", "// The nearest point of a box.\n"
                     "vec3 spt_into_box(vec3 q, vec3 low, vec3 high, out float apart) {\n"
                     "    vec3 within = min(max(q, low), high);\n"
                     "    $precise vec3 way = q - within;\n"
                     "    apart = spt_dot(way, way);\n"
                     "    return within;\n"
                     "}\n"},
    {"spt_untaper", "// Undoes a taper, by which a slice at height h was scaled by 1 + rate h.\n"
                    "vec3 spt_untaper(vec3 q, float rate) {\n"
                    "    $precise float inverse = 1.0 / (1.0 + rate * q.y);\n"
                    "    $precise vec3 p = vec3(q.x * inverse, q.y, q.z * inverse);\n"
                    "    return p;\n"
                    "}\n"},
    {"spt_sway_reach", "// How far a slice at this height sways. A function of its own: of a\n"
                       "// product of four, Mesa makes one of two products where there is no\n"
                       "// `precise`.\n"
                       "float spt_sway_reach(float rate, float height) {\n"
                       "    $precise float reach = rate * height * height;\n"
                       "    return reach;\n"
                       "}\n"},
    {"spt_unsway", "// Undoes a sway, by which a slice at height h moved by rate h^2 sin(phase +\n"
                   "// wave h).\n"
                   "vec3 spt_unsway(vec3 q, float rate, float wave, float phase) {\n"
                   "    float height = max(q.y, 0.0);\n"
                   "    $precise float angle = phase + wave * height;\n"
                   "    $precise float offset = spt_sway_reach(rate, height) * spt_sin(angle);\n"
                   "    $precise vec3 p = vec3(q.x - offset, q.yz);\n"
                   "    return p;\n"
                   "}\n"},
    {"spt_join_way",
     "// What a field with this constant is at most, outside of the region in which the\n"
     "// constant of the map holds: f at the nearest point of the region, joined with the way\n"
     "// there. L-Lipschitz, since the gradients of both are at right angles.\n"
     "float spt_join_way(float f, float apart, float lipschitz, float inverse) {\n"
     "    $precise float beyond = min(f * inverse, 4.61168602e18);\n"
     "    $precise float slant = lipschitz * sqrt(apart + beyond * beyond);\n"
     "    return apart > 0.0 && f > 0.0 ? min(slant, 3.40282347e38) : f;\n"
     "}\n"},
    {"spt_level_set",
     "// f + L a p e, with e the distance from the eye along the path: that undoes the share a\n"
     "// of half a pixel p by which the stop at half a pixel inflates bodies (Keinert et al.\n"
     "// 2014, section 3.2). widening: L a p. The distance in twice the precision, as in C.\n"
     "float spt_level_set(float f, vec3 p, vec3 eye, float path, float widening) {\n"
     "    SptPair way = spt_pair_of_sum(p, -eye);\n"
     "    SptPair e = spt_pair_root(spt_pair_dot(way, way));\n"
     "    e = spt_pair_add(e, SptPair(vec3(path), vec3(0.0)));\n"
     "    $precise float raised = f + widening * e.high.x;\n"
     "    return raised;\n"
     "}\n"},
    {"spt_unless_lost", "// What a caller's map led nowhere has no distance.\n"
                        "float spt_unless_lost(float f, vec3 q) {\n"
                        "    bool lost = !spt_is_number(abs(q.x)) || !spt_is_number(abs(q.y)) ||\n"
                        "                !spt_is_number(abs(q.z));\n"
                        "    return lost ? uintBitsToFloat(0x7fc00000u) : f;\n"
                        "}\n"},
};

#endif
