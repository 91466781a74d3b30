/* SPDX-License-Identifier: MIT
 *
 * shapes_polytopes.h as GLSL. Left out: spt_generalised_lipschitz(), see below. */
#ifndef SPTI_SHAPES_POLYTOPES_GLSL_H
#define SPTI_SHAPES_POLYTOPES_GLSL_H

#include "../base/glsl_piece.h"

/* All functions of shapes_polytopes.h by their names, but for spt_generalised_lipschitz(): it says
 * what to put into spt_field.lipschitz, before any shader is there, and it takes double and libm.
 *
 * GLSL has no pointers: planes come in an array of SPT_PLANES, of which `count` have been set:
 *     SptHalfSpace slabs[SPT_PLANES]; slabs[0] = SptHalfSpace(vec3(1.0, 0.0, 0.0), 0.5); ...
 *     return spt_generalised_slabs_by_squaring(p, 3, slabs, 4);
 * The loops begin at 0 and not at $zero: they are short, their number is that of the caller's text,
 * and only unrolled they leave the planes in registers. */
static const spti_glsl_piece spti_glsl_shapes_polytopes[] = {
    {"SPT_PLANES", "[library]#ifndef SPT_PLANES\n"
                   "#define SPT_PLANES 16 // most planes of a body\n"
                   "[library]#endif\n"},
    {"SptHalfSpace",
     "// normal.p <= offset, or |normal.p| <= offset of a slab; normal a unit vector.\n"
     "struct SptHalfSpace {\n"
     "    vec3 normal;\n"
     "    float offset;\n"
     "};\n"},
    {"spt_polytope",
     "// The intersection of count half-spaces. A lower bound, L = 1, convex.\n"
     "float spt_polytope(vec3 p, int count, SptHalfSpace half_spaces[SPT_PLANES]) {\n"
     "    float farthest = spt_dot(half_spaces[0].normal, p) - half_spaces[0].offset;\n"
     "    for (int i = 1; i < count; ++i) {\n"
     "        float height = spt_dot(half_spaces[i].normal, p) - half_spaces[i].offset;\n"
     "        farthest = max(height, farthest);\n"
     "    }\n"
     "    return farthest;\n"
     "}\n"},
    {"spt_slabs",
     "// The intersection of count slabs |normal.p| <= offset. A lower bound, L = 1, convex.\n"
     "float spt_slabs(vec3 p, int count, SptHalfSpace slabs[SPT_PLANES]) {\n"
     "    float farthest = abs(spt_dot(slabs[0].normal, p)) - slabs[0].offset;\n"
     "    for (int i = 1; i < count; ++i) {\n"
     "        float height = abs(spt_dot(slabs[i].normal, p)) - slabs[i].offset;\n"
     "        farthest = max(height, farthest);\n"
     "    }\n"
     "    return farthest;\n"
     "}\n"},

    /* ---- Generalised distances --------------------------------------------------------------- */

    {"spt_shape_term",
     "// How far the point is above the height width below the plane (Akleman and Chen 1999).\n"
     "float spt_shape_term(vec3 p, SptHalfSpace plane, float width, bool slab) {\n"
     "    float height = spt_dot(plane.normal, p);\n"
     "    $precise float term = (slab ? abs(height) : height) - (plane.offset - width);\n"
     "    return term;\n"
     "}\n"},
    {"spt_shape_width",
     "// The least of the offsets.\n"
     "float spt_shape_width(int count, SptHalfSpace planes[SPT_PLANES]) {\n"
     "    float width = planes[0].offset;\n"
     "    for (int i = 1; i < count; ++i) width = min(planes[i].offset, width);\n"
     "    return width;\n"
     "}\n"},
    {"spt_shape_largest",
     "// The largest term, at least 0.\n"
     "float spt_shape_largest(vec3 p, int count, SptHalfSpace planes[SPT_PLANES], float width,\n"
     "                        bool slab) {\n"
     "    float largest = spt_shape_term(p, planes[0], width, slab);\n"
     "    for (int i = 1; i < count; ++i) {\n"
     "        largest = max(spt_shape_term(p, planes[i], width, slab), largest);\n"
     "    }\n"
     "    return max(largest, 0.0);\n"
     "}\n"},
    {"spt_shape_powers",
     "// (sum of t^exponent)^(1/exponent) - w (Akleman and Chen 1999), the terms t divided\n"
     "// by the largest, so that no power overflows.\n"
     "float spt_shape_powers(vec3 p, int count, SptHalfSpace planes[SPT_PLANES], float exponent,\n"
     "                       bool slab) {\n"
     "    float width = spt_shape_width(count, planes);\n"
     "    float largest = spt_shape_largest(p, count, planes, width, slab);\n"
     "    $precise float scale = 1.0 / (largest + 1.17549435e-38);\n"
     "    $precise float sum = 0.0;\n"
     "    for (int i = 0; i < count; ++i) {\n"
     "        // the logarithm asks for a positive number; e^-32 and less change nothing beside 1\n"
     "        $precise float scaled = spt_shape_term(p, planes[i], width, slab) * scale;\n"
     "        $precise float power = exponent * spt_shape_log(max(scaled, 1e-12), 0.0);\n"
     "        sum += spt_shape_exp(max(power, -32.0));\n"
     "    }\n"
     "    $precise float logarithm = spt_shape_log(sum, 0.0) / exponent;\n"
     "    $precise float rounded = largest * spt_shape_exp(logarithm) - width;\n"
     "    return rounded;\n"
     "}\n"},
    {"spt_shape_squares",
     "// The same for exponent = 2^squarings, by repeated squaring and as many roots.\n"
     "float spt_shape_squares(vec3 p, int count, SptHalfSpace planes[SPT_PLANES], int squarings,\n"
     "                        bool slab) {\n"
     "    float width = spt_shape_width(count, planes);\n"
     "    float largest = spt_shape_largest(p, count, planes, width, slab);\n"
     "    // scaled by a power of two, exactly, so that the largest term is in [1, 2)\n"
     "    uint unit = floatBitsToUint(largest) & 0x7f800000u;\n"
     "    float scale = uintBitsToFloat(0x7f000000u - unit);\n"
     "    // 2^-(64 / exponent): its power changes nothing beside 1, while that of a smaller one\n"
     "    // would be denormal\n"
     "    float least = uintBitsToFloat(uint(127 - (64 >> squarings)) << 23);\n"
     "    $precise float sum = 0.0;\n"
     "    for (int i = 0; i < count; ++i) {\n"
     "        float scaled = spt_shape_term(p, planes[i], width, slab) * scale;\n"
     "        $precise float term = max(scaled, least);\n"
     "        for (int k = 0; k < squarings; ++k) term = term * term;\n"
     "        sum += term;\n"
     "    }\n"
     "    for (int k = 0; k < squarings; ++k) sum = sqrt(sum);\n"
     "    $precise float rounded = uintBitsToFloat(unit) * sum - width;\n"
     "    return rounded;\n"
     "}\n"},
    {"spt_generalised_distance",
     "// The generalised distance of count half-spaces, exponent from 2 to 512. Convex.\n"
     "float spt_generalised_distance(vec3 p, int count, SptHalfSpace half_spaces[SPT_PLANES],\n"
     "                               float exponent) {\n"
     "    return spt_shape_powers(p, count, half_spaces, exponent, false);\n"
     "}\n"},
    {"spt_generalised_slabs",
     "// The same for count slabs.\n"
     "float spt_generalised_slabs(vec3 p, int count, SptHalfSpace slabs[SPT_PLANES],\n"
     "                            float exponent) {\n"
     "    return spt_shape_powers(p, count, slabs, exponent, true);\n"
     "}\n"},
    {"spt_generalised_distance_by_squaring",
     "// The cheap way to exponents 2, 4, 8 ... 64 = 2^squarings.\n"
     "float spt_generalised_distance_by_squaring(vec3 p, int count,\n"
     "                                           SptHalfSpace half_spaces[SPT_PLANES],\n"
     "                                           int squarings) {\n"
     "    return spt_shape_squares(p, count, half_spaces, squarings, false);\n"
     "}\n"},
    {"spt_generalised_slabs_by_squaring",
     "// The same for count slabs.\n"
     "float spt_generalised_slabs_by_squaring(vec3 p, int count, SptHalfSpace slabs[SPT_PLANES],\n"
     "                                        int squarings) {\n"
     "    return spt_shape_squares(p, count, slabs, squarings, true);\n"
     "}\n"},
};

#endif
