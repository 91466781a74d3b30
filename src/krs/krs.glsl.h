/* SPDX-License-Identifier: MIT
 *
 * fold_kernel.h and shape_kernel.h as GLSL, for points within 1e18. What stands at which level is
 * written from the model (glsl/write_krs.c). */
#ifndef SPTI_KRS_GLSL_H
#define SPTI_KRS_GLSL_H

#include "../base/glsl_piece.h"

static const spti_glsl_piece spti_glsl_krs_pieces[] = {
    {"spt_fold", "// Reflects what is beyond the mirror normal . p = offset (Szecsi et al. 2016,\n"
                 "// Algorithm 1, without its branch).\n"
                 "vec3 spt_fold(vec3 p, vec3 normal, float offset) {\n"
                 "    $precise float height = spt_dot(p, normal) - offset;\n"
                 "    float beyond = max(height, 0.0);\n"
                 "    $precise vec3 folded = p - (beyond + beyond) * normal;\n"
                 "    return folded;\n"
                 "}\n"},
    {"spt_kernel_sphere", "float spt_kernel_sphere(vec3 p, vec3 center, float radius) {\n"
                          "    $precise vec3 q = p - center;\n"
                          "    $precise float d = sqrt(spt_dot(q, q)) - radius;\n"
                          "    return d;\n"
                          "}\n"},
    {"spt_kernel_half_space", "float spt_kernel_half_space(vec3 p, vec3 normal, float offset) {\n"
                              "    $precise float d = spt_dot(p, normal) - offset;\n"
                              "    return d;\n"
                              "}\n"},
    {"spt_arc_square",
     "// The square of the distance from an arc, in its plane: x outward from its middle, y >=\n"
     "// 0 along its chord. arc: curvature k, half of the chord, cosine and sagitta of half of\n"
     "// the arc. What is within the circle is at distance 0 of a solid one. sqrt(X^2 + y^2) -\n"
     "// 1 / k with X = 1 / k + x, multiplied out so that 1 / k cancels before it is computed.\n"
     "float spt_arc_square(float x, float y, vec4 arc, bool solid) {\n"
     "    $precise float from_center = 1.0 + arc.x * x;\n"
     "    $precise float turned = arc.x * y;\n"
     "    $precise float above = x * (arc.x * x + 2.0) + y * turned;\n"
     "    $precise float below = sqrt(from_center * from_center + turned * turned) + 1.0;\n"
     "    $precise float over = above / below;\n"
     "    $precise vec2 from_end = vec2(x + arc.w, y - arc.y);\n"
     "    $precise float far_square = from_end.x * from_end.x + from_end.y * from_end.y;\n"
     "    if (solid) over = max(over, 0.0);\n"
     "    $precise float near_square = over * over;\n"
     "    $precise float turns = arc.z * y;\n"
     "    $precise float most_turns = arc.y * from_center;\n"
     "    // Where the circle is infinitely far in units of its radius the ends are as near.\n"
     "    return turns <= most_turns && below <= 3.40282347e38 ? near_square : far_square;\n"
     "}\n"},
    {"spt_kernel_capsule",
     "// A toroidal capsule (Szecsi et al. 2016, 9.2), from the middle of its arc.\n"
     "float spt_kernel_capsule(vec3 p, vec3 middle, vec3 outward, vec3 along, vec3 normal,\n"
     "                         vec4 arc, float radius) {\n"
     "    $precise vec3 q = p - middle;\n"
     "    float x = spt_dot(q, outward);\n"
     "    float y = abs(spt_dot(q, along));\n"
     "    float z = spt_dot(q, normal);\n"
     "    $precise float d = sqrt(spt_arc_square(x, y, arc, false) + z * z) - radius;\n"
     "    return d;\n"
     "}\n"},
    {"spt_kernel_leaf",
     "// A flat leaf between two arcs over one chord (Szecsi et al. 2016, 9.2): the nearer one is\n"
     "// that on the point's side.\n"
     "float spt_kernel_leaf(vec3 p, vec3 middle, vec3 outward, vec3 along, vec3 normal, vec4 arc,\n"
     "                      float radius) {\n"
     "    $precise vec3 q = p - middle;\n"
     "    $precise float x = abs(spt_dot(q, outward)) - arc.w;\n"
     "    float y = abs(spt_dot(q, along));\n"
     "    float z = spt_dot(q, normal);\n"
     "    $precise float d = sqrt(spt_arc_square(x, y, arc, true) + z * z) - radius;\n"
     "    return d;\n"
     "}\n"},
    {"spt_nearer", "// The nearer one of two; what is no number stays.\n"
                   "float spt_nearer(float least, float d) {\n"
                   "    if (!spt_is_number(least)) return least;\n"
                   "    return spt_is_number(d) ? min(d, least) : d;\n"
                   "}\n"},
    {"spt_take_nearer",
     "// Keeps the nearest kernel and its number; of equals the first.\n"
     "void spt_take_nearer(int number, inout float least, inout int kernel, float d) {\n"
     "    if (d < least || kernel < 0) {\n"
     "        least = d;\n"
     "        kernel = number;\n"
     "    }\n"
     "}\n"},
};

#endif
