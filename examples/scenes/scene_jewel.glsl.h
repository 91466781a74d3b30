/* SPDX-License-Identifier: MIT
 *
 * scene_jewel.h as GLSL, with the numbers of jewel_planes.h. */
#ifndef EXAMPLES_SCENE_JEWEL_GLSL_H
#define EXAMPLES_SCENE_JEWEL_GLSL_H

#include "jewel_planes.h"

/* clang-format off */
#define JEWEL_TEXT(number) JEWEL_TEXT_OF(number)
#define JEWEL_TEXT_OF(number) #number

#define JEWEL_GLSL_SUM(name, number_a, a, number_b, b) \
    "    SPT_PRECISE float " name " = " \
    JEWEL_TEXT(number_a) " * " a " + " JEWEL_TEXT(number_b) " * " b
#define JEWEL_GLSL_FACET(name, ring, out) \
    JEWEL_GLSL_SUM(name, JEWEL_##ring##_ACROSS, out, JEWEL_##ring##_UP, "up") \
    " - " JEWEL_TEXT(JEWEL_##ring##_OFFSET) ";\n"

#define GLSL_jewel \
    "    // In the axes of the stone, which lies on one of its mains.\n" \
    JEWEL_GLSL_SUM("up", JEWEL_LEAN_SINE, "p.z", JEWEL_LEAN_COSINE, "p.y") ";\n" \
    JEWEL_GLSL_SUM("first", JEWEL_LEAN_COSINE, "p.z", -JEWEL_LEAN_SINE, "p.y") ";\n" \
    "    // The reach along the facets at whole eighths of a turn, between and at odd 32nds.\n" \
    "    float more = max(abs(first), abs(p.x));\n" \
    "    float less = min(abs(first), abs(p.x));\n" \
    "    SPT_PRECISE float corner = 0.707106781 * (more + less);\n" \
    "    SPT_PRECISE float between = 0.923879533 * more + 0.382683432 * less;\n" \
    "    SPT_PRECISE float odd_1 = 0.980785280 * more + 0.195090322 * less;\n" \
    "    SPT_PRECISE float odd_3 = 0.831469612 * more + 0.555570233 * less;\n" \
    "    float whole = max(corner, more);\n" \
    "    float odd = max(odd_1, odd_3);\n" \
    JEWEL_GLSL_FACET("star", STAR, "between") \
    JEWEL_GLSL_FACET("bezel", BEZEL, "whole") \
    JEWEL_GLSL_FACET("upper", UPPER, "odd") \
    JEWEL_GLSL_FACET("lower", LOWER, "odd") \
    JEWEL_GLSL_FACET("main_facet", MAIN, "whole") \
    "    float crown = max(max(star, bezel), upper);\n" \
    "    float pavilion = max(lower, main_facet);\n" \
    "    float ends = max(up - " JEWEL_TEXT(JEWEL_TABLE) \
    ", odd - " JEWEL_TEXT(JEWEL_GIRDLE) ");\n" \
    "    return max(max(crown, pavilion), ends);\n"
/* clang-format on */

#endif
